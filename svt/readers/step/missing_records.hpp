#pragma once
/// \file
/// References to records that a STEP file lacks. They are noted where references are followed, so that no caller has to
/// look: whoever reads a product takes what was missing for it, and the file's reader reports them all.
///
///     #201=IFCAXIS2PLACEMENT3D(#9999,#11,$);
///      |                        `--- leads nowhere: attribute 1 of #201
///      record

#include <svt/readers/step/step_file.hpp>
#include <svt/readers/step/step_value.hpp>

#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace svt::readers::step {

/// Threads: to be used by one at a time.
class MissingRecords {
public:
    /// Of these, each counts once. A file with more has some counted again, each time that they are followed.
    static constexpr std::size_t kMaxKnown = 100'000;
    /// What take() returns at most.
    static constexpr std::size_t kMaxTaken = 20;

    explicit MissingRecords(const StepFile& file) : file_(file) {}

    /// \param reference  a value of a record of the file, as Fields or a cursor gave it
    void note(Value reference);

    /// Whether something was noted since the last take() or drop().
    [[nodiscard]] bool isAny() const noexcept { return !recent_.empty(); }
    /// What was noted since the last call, in words, each once: "#9999, to which attribute 1 of #201 IFCWALL refers".
    [[nodiscard]] std::vector<std::string> take();
    /// Drops the notes since the last take(); report() still has them.
    void drop() noexcept { recent_.clear(); }

    /// One finding (DanglingReference) for each reference that was noted, in the order of the file.
    /// \param name  of the file
    void report(std::string_view name, Diagnostics& diagnostics) const;

private:
    const StepFile& file_;
    std::vector<Value> recent_;  // since take() or drop(), at most kMaxTaken
    std::vector<Value> known_;   // each once up to kMaxKnown
    std::unordered_set<const char*> isKnown_;
    std::size_t more_ = 0;  // beyond
};

}  // namespace svt::readers::step
