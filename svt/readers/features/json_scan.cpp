#include <svt/readers/features/json_scan.hpp>

#include <svt/core/text.hpp>

#include <cstring>

namespace svt::readers::features {
namespace {

// Position after the string that begins at `at`.
std::size_t skipString(std::string_view text, std::size_t at) noexcept {
    for (std::size_t i = at + 1; i < text.size(); ++i) {
        if (text[i] == '\\')
            ++i;
        else if (text[i] == '"')
            return i + 1;
    }
    return kNoJson;
}

}  // namespace

std::size_t skipJsonBlanks(std::string_view text, std::size_t at) noexcept {
    while (at < text.size() && isBlank(text[at])) ++at;
    return at;
}

std::size_t skipJson(std::string_view text, std::size_t at) noexcept {
    at = skipJsonBlanks(text, at);
    if (at >= text.size()) return kNoJson;
    if (text[at] == '"') return skipString(text, at);
    if (text[at] != '{' && text[at] != '[') {
        const std::size_t end = text.find_first_of(",]} \t\r\n", at);
        return end == at ? kNoJson : end == std::string_view::npos ? text.size() : end;
    }
    std::size_t depth = 0;
    while (at < text.size()) {
        const char c = text[at];
        if (c == '"') {
            at = skipString(text, at);
            if (at == kNoJson) return kNoJson;
            continue;
        }
        ++at;
        if (c == '{' || c == '[') ++depth;
        if ((c == '}' || c == ']') && --depth == 0) return at;
    }
    return kNoJson;
}

std::size_t forEachMember(std::string_view text, std::size_t at,
                          const std::function<void(std::string_view, std::size_t, std::size_t)>& visit) {
    at = skipJsonBlanks(text, at);
    if (at >= text.size() || text[at] != '{') return kNoJson;
    at = skipJsonBlanks(text, at + 1);
    if (at < text.size() && text[at] == '}') return at + 1;
    while (at < text.size() && text[at] == '"') {
        const std::size_t keyEnd = skipString(text, at);
        if (keyEnd == kNoJson) return kNoJson;
        const std::string_view key = text.substr(at, keyEnd - at);
        const std::size_t colon = skipJsonBlanks(text, keyEnd);
        if (colon >= text.size() || text[colon] != ':') return kNoJson;
        const std::size_t begin = skipJsonBlanks(text, colon + 1), end = skipJson(text, begin);
        if (end == kNoJson) return kNoJson;
        visit(key, begin, end);
        at = skipJsonBlanks(text, end);
        if (at >= text.size()) return kNoJson;
        if (text[at] == '}') return at + 1;
        if (text[at] != ',') return kNoJson;
        at = skipJsonBlanks(text, at + 1);
    }
    return kNoJson;
}

std::size_t forEachElement(std::string_view text, std::size_t at,
                           const std::function<void(std::size_t, std::size_t)>& visit) {
    at = skipJsonBlanks(text, at);
    if (at >= text.size() || text[at] != '[') return kNoJson;
    at = skipJsonBlanks(text, at + 1);
    if (at < text.size() && text[at] == ']') return at + 1;
    while (at < text.size()) {
        const std::size_t end = skipJson(text, at);
        if (end == kNoJson) return kNoJson;
        visit(at, end);
        at = skipJsonBlanks(text, end);
        if (at >= text.size()) return kNoJson;
        if (text[at] == ']') return at + 1;
        if (text[at] != ',') return kNoJson;
        at = skipJsonBlanks(text, at + 1);
    }
    return kNoJson;
}

}  // namespace svt::readers::features
