#include <svt/core/diagnostics.hpp>

#include <fmt/format.h>

namespace svt {

std::string_view severityName(Severity severity) noexcept {
    switch (severity) {
        case Severity::Note: return "note";
        case Severity::Warning: return "warning";
        case Severity::Error: return "error";
    }
    return "note";
}

std::string Diagnostic::toString() const {
    return fmt::format("{} {}", severityName(severity), Error(code, message, where).toString());
}

void Diagnostics::add(Severity severity, Code code, std::string message, Place where) {
    ++perSeverity_[static_cast<std::size_t>(severity)];
    if (++perCode_[code] > kKeptPerCode) return;
    items_.push_back({severity, code, std::move(message), std::move(where)});
}

void Diagnostics::append(const Diagnostics& other) {
    for (const Diagnostic& item : other.items_) {
        const std::size_t seen = count(item.code);
        if (seen < kKeptPerCode) items_.push_back(item);
        ++perCode_[item.code];
        ++perSeverity_[static_cast<std::size_t>(item.severity)];
    }
    for (const auto& [code, total] : other.perCode_)
        if (total > kKeptPerCode) perCode_[code] += total - kKeptPerCode;
}

std::size_t Diagnostics::count(Code code) const noexcept {
    const auto found = perCode_.find(code);
    return found == perCode_.end() ? 0 : found->second;
}

std::size_t Diagnostics::count(Severity severity) const noexcept {
    return perSeverity_[static_cast<std::size_t>(severity)];
}

}  // namespace svt
