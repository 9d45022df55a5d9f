#pragma once
/// \file
/// Findings that do not stop processing: a dangling link, an open shell, an omitted face.

#include <svt/core/error.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace svt {

enum class Severity { Note, Warning, Error };

/// "note", "warning" or "error"
[[nodiscard]] std::string_view severityName(Severity severity) noexcept;

struct Diagnostic {
    Severity severity = Severity::Warning;
    Code code = Code::Internal;
    std::string message;
    Place where;

    /// "warning E110 DanglingReference: house.gml:12: ..."
    [[nodiscard]] std::string toString() const;
};

/// Collects diagnostics in the order in which they are found. Keeps at most `kKeptPerCode` of each code, but counts all
/// of them. This limits the memory for a file full of errors.
/// Threads: not synchronized; parallel stages collect per task and append in order.
class Diagnostics {
public:
    static constexpr std::size_t kKeptPerCode = 1000;

    void add(Severity severity, Code code, std::string message, Place where = {});
    void append(const Diagnostics& other);

    [[nodiscard]] const std::vector<Diagnostic>& items() const noexcept { return items_; }
    /// Number of diagnostics with `code`, kept or not.
    [[nodiscard]] std::size_t count(Code code) const noexcept;
    [[nodiscard]] std::size_t count(Severity severity) const noexcept;

private:
    std::vector<Diagnostic> items_;
    std::map<Code, std::size_t> perCode_;
    std::size_t perSeverity_[3] = {0, 0, 0};
};

}  // namespace svt
