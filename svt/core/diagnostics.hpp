#pragma once
/// \file
/// Findings that did not stop the work: a dangling link, an open shell, a face left out.

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

/// Collects diagnostics in the order they are found. Keeps at most `kKeptPerCode`
/// of each code, counts all, so a hopeless file cannot fill the memory.
/// Threads: not synchronized; parallel stages collect per task and append in order.
class Diagnostics {
public:
    static constexpr std::size_t kKeptPerCode = 1000;

    void add(Severity severity, Code code, std::string message, Place where = {});
    void append(const Diagnostics& other);

    [[nodiscard]] const std::vector<Diagnostic>& items() const noexcept { return items_; }
    /// How often `code` was found, kept or not.
    [[nodiscard]] std::size_t count(Code code) const noexcept;
    [[nodiscard]] std::size_t count(Severity severity) const noexcept;

private:
    std::vector<Diagnostic> items_;
    std::map<Code, std::size_t> perCode_;
    std::size_t perSeverity_[3] = {0, 0, 0};
};

}  // namespace svt
