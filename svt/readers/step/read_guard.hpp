#pragma once
/// \file
/// Limits on the work and memory that an IFC file may cause. A small record may be referenced any number of times, even
/// by itself, so a small file could describe an infinite model. One guard limits all reading of a file:
///
///     Scope     the nested records that are being read. A record that occurs again closes a circle.
///     steps     bytes of records that are cut into values, pairs of edges that are compared, ...
///     elements  points of curves, profiles and faces, and attributes; a measure of memory.
///
/// Steps and elements have a limit for the file and one for each product. Both grow with the size of the file.

#include <svt/readers/step/step_file.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_set>
#include <vector>

namespace svt::readers::step {

class ReadGuard {
public:
    explicit ReadGuard(const StepFile& file);

    /// One call that follows references. Lives as long as the call; scopes nest like calls.
    class Scope {
    public:
        explicit Scope(ReadGuard& guard) noexcept : guard_(guard), first_(guard.path_.size()) { ++guard_.depth_; }
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

        /// Marks a record as being read until the scope ends or leave() is called; kNoRecord is ignored.
        /// \return false if the record must not be read: it is being read already, is nested too deeply, or the budget
        ///         is spent. Then why() gives the reason, and a circle is stored for circles()
        [[nodiscard]] bool enter(RecordIndex record);
        /// The same, with the reason in `why`.
        [[nodiscard]] bool enter(RecordIndex record, std::string& why);
        /// Ends the reading of the record entered last.
        void leave() noexcept;
        [[nodiscard]] const std::string& why() const noexcept { return guard_.why_; }

    private:
        ReadGuard& guard_;
        std::size_t first_;
    };

    /// Records that refer to each other in a circle.
    struct Circle {
        RecordIndex first = kNoRecord;  ///< the one that stands first in the file
        std::string text;               ///< "#7 IFCTRIMMEDCURVE -> #9 IFCSURFACECURVE -> #7"
    };
    /// The circles found so far, each once; at most 1000.
    [[nodiscard]] const std::vector<Circle>& circles() const noexcept { return circles_; }
    /// Text of a circle. \param records  at least one; each refers to the next
    [[nodiscard]] std::string nameCircle(std::vector<RecordIndex> records) const;

    /// Takes from the budgets of the product and of the file. \return whether both suffice
    bool takeSteps(std::uint64_t count) noexcept { return steps_.take(count, isInProduct_) && !isSpent(); }
    bool takeElements(std::uint64_t count) noexcept { return elements_.take(count, isInProduct_) && !isSpent(); }
    /// Whether this number of elements is left. If not, the budget counts as spent, because the caller cannot make its
    /// result.
    [[nodiscard]] bool affords(std::uint64_t elements) noexcept;
    /// Steps that are left.
    [[nodiscard]] std::uint64_t stepsLeft() const noexcept { return steps_.left(isInProduct_); }

    /// Begins the reading of one product with a separate budget; until endProduct().
    void beginProduct() noexcept;
    void endProduct() noexcept { isInProduct_ = false; }

    /// Whether a budget of the product or of the file is spent. Then no record has values, so that all reading ends.
    [[nodiscard]] bool isSpent() const noexcept {
        return steps_.isSpent(isInProduct_) || elements_.isSpent(isInProduct_);
    }
    [[nodiscard]] bool isFileSpent() const noexcept { return steps_.isSpent(false) || elements_.isSpent(false); }
    /// "more than 600000 points and values, the limit for one product of this file"
    [[nodiscard]] std::string whatIsSpent() const;

private:
    struct Budget {
        std::uint64_t ofFile = 0, ofProduct = 0;  // limits
        std::uint64_t takenOfFile = 0, takenOfProduct = 0;

        bool take(std::uint64_t count, bool isInProduct) noexcept;
        [[nodiscard]] bool isSpent(bool isInProduct) const noexcept {
            return takenOfFile > ofFile || (isInProduct && takenOfProduct > ofProduct);
        }
        [[nodiscard]] std::uint64_t left(bool isInProduct) const noexcept;
    };

    [[nodiscard]] bool push(RecordIndex record);
    void pop() noexcept;
    std::string addCircle(std::vector<RecordIndex> records);
    [[nodiscard]] std::string nameOf(RecordIndex record) const;

    const StepFile& file_;
    Budget steps_, elements_;
    bool isInProduct_ = false;
    std::vector<RecordIndex> path_;
    std::vector<bool> isOnPath_;  // by record
    std::size_t depth_ = 0;
    std::string why_;
    std::vector<Circle> circles_;
    std::unordered_set<std::string> known_;  // texts of circles_
};

}  // namespace svt::readers::step
