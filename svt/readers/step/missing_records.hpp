#pragma once
/// \file
/// References to records that a STEP file lacks. The functions that follow references note them, so callers need not
/// check. The reader of a product takes the notes for that product, and the reader of the file reports all of them.
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

/// Threads: not thread-safe.
class MissingRecords {
public:
    /// Maximum number of references that are remembered, so that each counts once. Further ones count each time that
    /// they are followed.
    static constexpr std::size_t kMaxKnown = 100'000;
    /// Maximum number of texts that take() returns.
    static constexpr std::size_t kMaxTaken = 20;

    explicit MissingRecords(const StepFile& file) : file_(file) {}

    /// \param reference  a value of a record of the file, from Fields or a cursor
    void note(Value reference);

    /// Whether something was noted since the last take() or drop().
    [[nodiscard]] bool isAny() const noexcept { return !recent_.empty(); }
    /// The references noted since the last call, as text, each once: "#9999, to which attribute 1 of #201 IFCWALL
    /// refers".
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
