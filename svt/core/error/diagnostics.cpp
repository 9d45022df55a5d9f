#include <svt/core/diagnostics.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

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
    std::map<Code, std::size_t> kept;
    for (const Diagnostic& item : other.items_) {
        const auto place = kept.try_emplace(item.code, std::min(count(item.code), kKeptPerCode)).first;
        if (place->second++ < kKeptPerCode) items_.push_back(item);
    }
    for (const auto& [code, total] : other.perCode_) perCode_[code] += total;
    for (std::size_t s = 0; s < std::size(perSeverity_); ++s) perSeverity_[s] += other.perSeverity_[s];
}

std::size_t Diagnostics::count(Code code) const noexcept {
    const auto found = perCode_.find(code);
    return found == perCode_.end() ? 0 : found->second;
}

std::size_t Diagnostics::count(Severity severity) const noexcept {
    return perSeverity_[static_cast<std::size_t>(severity)];
}

}  // namespace svt
