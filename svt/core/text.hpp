#pragma once
/// \file
/// Text from files and arguments: UTF-8 with every byte checked, and ASCII digits, numbers, blanks and letter case,
/// independent of the locale of the process. scripts/check_banned_calls.py bans the calls that depend on the locale.

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt {

/// A character of UTF-8 text.
struct Utf8Character {
    char32_t code = 0;
    std::uint8_t size = 0;  ///< bytes; 0: the text does not begin with a valid character
};

/// The first character of `text`. Overlong forms, surrogates and codes above U+10FFFF are not valid.
/// \param text  not empty
[[nodiscard]] constexpr Utf8Character firstCharacter(std::string_view text) noexcept {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    if (lead < 0x80) return {lead, 1};
    const std::size_t size = lead < 0xC2 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 0;
    if (size == 0 || size > text.size()) return {};
    char32_t code = lead & (0x7Fu >> size);
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xC0u) != 0x80u) return {};
        code = code << 6 | (byte(i) & 0x3Fu);
    }
    const bool isOverlong = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
    const bool isSurrogate = code >= 0xD800 && code < 0xE000;
    if (isOverlong || isSurrogate || code > 0x10FFFF) return {};
    return {code, static_cast<std::uint8_t>(size)};
}

/// The number of bytes at the beginning of `text` that are printable ASCII, and neither `quote` nor a backslash: text that
/// quoted strings of JSON and STEP hold as it is.
[[nodiscard]] constexpr std::size_t plainLength(std::string_view text, char quote) noexcept {
    std::size_t length = 0;
    while (length < text.size() && text[length] >= ' ' && text[length] <= '~' && text[length] != quote &&
           text[length] != '\\')
        ++length;
    return length;
}

/// Appends a character as UTF-8.
/// \param code  at most U+10FFFF
void appendUtf8(char32_t code, std::string& to);

/// Offset of the first byte that does not begin a valid character, or npos.
[[nodiscard]] std::size_t findInvalidUtf8(std::string_view text) noexcept;

/// Number of characters of valid UTF-8. In other text, the number of bytes that are not continuation bytes.
[[nodiscard]] std::size_t characterCount(std::string_view text) noexcept;

/// The beginning of `text`, at most `most` bytes: cut before a character, not within one.
[[nodiscard]] std::string_view shortened(std::string_view text, std::size_t most) noexcept;

/// `text` as content of an element of XML 1.0, with escaped markup. Control characters that XML forbids become blanks;
/// other forbidden characters and invalid UTF-8 become U+FFFD. Cost: O(length), also of xmlAttribute().
[[nodiscard]] std::string xmlContent(std::string_view text);
/// The same for the value of an attribute in single or double quotes, and for HTML. Quotes, tabs and line breaks become
/// character references, too, so that a parser restores them.
[[nodiscard]] std::string xmlAttribute(std::string_view text);

/// 0 to 9.
[[nodiscard]] constexpr bool isDigit(char c) noexcept { return c >= '0' && c <= '9'; }
/// Space, tab or line break: the separators of words in XML, JSON and queries.
[[nodiscard]] constexpr bool isBlank(char c) noexcept { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

[[nodiscard]] constexpr bool isLetter(char c) noexcept { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

/// `text` without leading and trailing blanks.
[[nodiscard]] std::string_view withoutBlanks(std::string_view text) noexcept;

/// Parses all of `text` as a finite number: [+-] digits [. digits] [e [+-] digits]. The digits on one side of the point
/// may be missing. Returns nothing for any other text: blanks, a comma, hexadecimal digits, "inf" and "nan", and
/// numbers beyond the range of a double (1e999, 1e-400).
[[nodiscard]] std::optional<double> parseNumber(std::string_view text) noexcept;
/// Removes the longest such number from the beginning of `text` and returns it; otherwise leaves `text` unchanged.
[[nodiscard]] std::optional<double> takeNumber(std::string_view& text) noexcept;
/// Numbers separated by commas, with blanks around each; nothing if one of them is not a number.
/// \param most  maximum number of values; nothing if there are more
[[nodiscard]] std::optional<std::vector<double>> parseNumbers(std::string_view text, std::size_t most);

/// Parses all of `text` as an integer. Only signed types allow a leading '-'. Returns nothing for other text, and for
/// numbers beyond the range of `Integer`.
template <class Integer>
[[nodiscard]] std::optional<Integer> parseInteger(std::string_view text, int base = 10) noexcept {
    Integer value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// Converts A to Z to lower case; other bytes stay unchanged.
[[nodiscard]] constexpr char lowerAscii(char c) noexcept {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
[[nodiscard]] std::string lowerAscii(std::string_view text);
/// Converts Latin, Greek and Cyrillic capitals of UTF-8 text to lower case; other characters stay unchanged. Invalid
/// bytes become U+FFFD. For searches in the words of users, not for keywords. Cost: O(length).
[[nodiscard]] std::string lowerCase(std::string_view text);
/// The same for one character.
[[nodiscard]] char32_t lowerCase(char32_t code) noexcept;
[[nodiscard]] bool equalsIgnoringCase(std::string_view a, std::string_view b) noexcept;

/// The parts of "a|b|c"; no parts for an empty text.
[[nodiscard]] std::vector<std::string_view> splitChoices(std::string_view choices);

}  // namespace svt
