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

std::string_view shortened(std::string_view text, std::size_t most) noexcept {
    if (text.size() <= most) return text;
    while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0u) == 0x80u) --most;
    return text.substr(0, most);
}

char32_t lowerCase(char32_t code) noexcept {
    const auto isIn = [code](char32_t first, char32_t last) { return first <= code && code <= last; };
    if (isIn('A', 'Z') || (isIn(0xC0, 0xDE) && code != 0xD7) || (isIn(0x391, 0x3A9) && code != 0x3A2)) return code + 32;
    if (isIn(0x410, 0x42F)) return code + 32;
    if (isIn(0x400, 0x40F)) return code + 80;
    if (code == 0x178) return 0xFF;   // Y with diaeresis
    if (code == 0x1E9E) return 0xDF;  // capital sharp s
    if (code == 0x130) return U'i';   // I with dot
    if (code == 0x386) return 0x3AC;  // Greek vowels with accent
    if (isIn(0x388, 0x38A)) return code + 37;
    if (code == 0x38C) return 0x3CC;
    if (isIn(0x38E, 0x38F)) return code + 63;
    // Pairs of a capital and its small letter: first the blocks whose capitals are odd.
    if (isIn(0x139, 0x148) || isIn(0x179, 0x17E)) return code % 2 == 1 ? code + 1 : code;
    const bool isOfEvenPair = isIn(0x100, 0x137) || isIn(0x14A, 0x177) || isIn(0x218, 0x21F) || isIn(0x460, 0x481) ||
                              isIn(0x48A, 0x4BF) || isIn(0x1E00, 0x1E95) || isIn(0x1EA0, 0x1EFF);
    return isOfEvenPair && code % 2 == 0 ? code + 1 : code;
}

std::string lowerCase(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        const auto [code, size] = firstCharacter(text);
        appendUtf8(size == 0 ? U'\uFFFD' : lowerCase(code), result);
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
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
