#include <svt/core/text.hpp>

#include <algorithm>

namespace svt {

void appendUtf8(char32_t code, std::string& to) {
    const auto append = [&](char32_t byte) { to += static_cast<char>(byte); };
    const auto continuation = [&](int shift) { append(0x80u | (code >> shift & 0x3Fu)); };
    if (code < 0x80) {
        append(code);
    } else if (code < 0x800) {
        append(0xC0u | code >> 6);
        continuation(0);
    } else if (code < 0x10000) {
        append(0xE0u | code >> 12);
        continuation(6);
        continuation(0);
    } else {
        append(0xF0u | code >> 18);
        continuation(12);
        continuation(6);
        continuation(0);
    }
}

std::size_t findInvalidUtf8(std::string_view text) noexcept {
    for (std::size_t at = 0; at < text.size();) {
        const Utf8Character character = firstCharacter(text.substr(at));
        if (character.size == 0) return at;
        at += character.size;
    }
    return std::string_view::npos;
}

std::size_t characterCount(std::string_view text) noexcept {
    return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string lowerAscii(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = lowerAscii(c);
    return result;
}

bool equalsIgnoringCase(std::string_view a, std::string_view b) noexcept {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lowerAscii(x) == lowerAscii(y); });
}

namespace {

std::string xmlText(std::string_view text, bool isAttribute) {
    std::string safe;
    safe.reserve(text.size() + text.size() / 16);
    for (std::size_t at = 0; at < text.size();) {
        const auto [c, size] = firstCharacter(text.substr(at));
        if (size == 0 || c == 0xFFFE || c == 0xFFFF) {
            safe += "\xEF\xBF\xBD";
        } else if ((c < 0x20 && c != '\t' && c != '\n') || c == 0x7F) {
            safe += ' ';
        } else if (c == '&') {
            safe += "&amp;";
        } else if (c == '<') {
            safe += "&lt;";
        } else if (c == '>') {
            safe += "&gt;";
        } else if (isAttribute && c == '"') {
            safe += "&quot;";
        } else if (isAttribute && (c == '\'' || c == '\t' || c == '\n')) {
            safe += c == '\'' ? "&#39;" : c == '\t' ? "&#9;" : "&#10;";
        } else {
            safe.append(text, at, size);
        }
        at += std::max<std::size_t>(size, 1);
    }
    return safe;
}

}  // namespace

std::string xmlContent(std::string_view text) { return xmlText(text, false); }
std::string xmlAttribute(std::string_view text) { return xmlText(text, true); }

}  // namespace svt
