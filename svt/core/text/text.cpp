#include <svt/core/text.hpp>

#include <algorithm>
#include <cmath>

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

std::string_view withoutBlanks(std::string_view text) noexcept {
    while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
    while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
    return text;
}

std::optional<double> takeNumber(std::string_view& text) noexcept {
    std::string_view number = text;
    const bool isPositive = number.starts_with('+');
    if (isPositive) number.remove_prefix(1);
    const std::size_t first = !isPositive && number.starts_with('-') ? 1 : 0;
    // from_chars also accepts names such as "inf".
    if (number.size() <= first || !(isDigit(number[first]) || number[first] == '.')) return std::nullopt;
    double value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

std::optional<double> parseNumber(std::string_view text) noexcept {
    const auto value = takeNumber(text);
    return text.empty() ? value : std::nullopt;
}

std::optional<std::vector<double>> parseNumbers(std::string_view text, std::size_t most) {
    std::vector<double> numbers;
    while (true) {
        const std::size_t end = std::min(text.find(','), text.size());
        const auto number = parseNumber(withoutBlanks(text.substr(0, end)));
        if (!number || numbers.size() == most) return std::nullopt;
        numbers.push_back(*number);
        if (end == text.size()) return numbers;
        text.remove_prefix(end + 1);
    }
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

std::vector<std::string_view> splitChoices(std::string_view choices) {
    std::vector<std::string_view> parts;
    while (!choices.empty()) {
        const std::size_t end = std::min(choices.find('|'), choices.size());
        parts.push_back(choices.substr(0, end));
        choices.remove_prefix(std::min(end + 1, choices.size()));
    }
    return parts;
}

}  // namespace svt
