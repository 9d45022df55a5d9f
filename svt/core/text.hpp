#pragma once
/// \file
/// Text that comes from files and arguments: UTF-8 with every byte checked; digits, numbers, blanks and letter case of
/// ASCII, whatever the locale of the process. scripts/check_banned_calls.py bans the calls that depend on the locale.

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
    std::uint8_t size = 0;  ///< bytes; 0: the text begins with no valid character
};

/// The character that `text` begins with. Overlong forms, surrogates and codes above U+10FFFF are not valid.
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

/// Appends a character as UTF-8.
/// \param code  at most U+10FFFF
void appendUtf8(char32_t code, std::string& to);

/// Offset of the first byte that begins no valid character, or npos.
[[nodiscard]] std::size_t findInvalidUtf8(std::string_view text) noexcept;

/// Count of characters of valid UTF-8; in other text, of bytes that continue none.
[[nodiscard]] std::size_t characterCount(std::string_view text) noexcept;

/// `text` as content of an element of XML 1.0: markup is escaped; what XML forbids is replaced, control characters by
/// blanks, other characters and invalid UTF-8 by U+FFFD. Cost: O(length), as of xmlAttribute().
[[nodiscard]] std::string xmlContent(std::string_view text);
/// The same for the value of an attribute in quotes of either kind, and for HTML: quotes, tabs and ends of lines are
/// references, too, so that a parser gives them back.
[[nodiscard]] std::string xmlAttribute(std::string_view text);

/// 0 to 9.
[[nodiscard]] constexpr bool isDigit(char c) noexcept { return c >= '0' && c <= '9'; }
/// Space, tab or the end of a line: what separates words in XML, JSON and queries.
[[nodiscard]] constexpr bool isBlank(char c) noexcept { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

[[nodiscard]] constexpr bool isLetter(char c) noexcept { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

/// `text` without the blanks at its ends.
[[nodiscard]] std::string_view withoutBlanks(std::string_view text) noexcept;

/// The finite number that the whole of `text` spells: [+-] digits [. digits] [e [+-] digits]. The digits on one side of
/// the point may be missing. Nothing for any other text: blanks, a comma, hexadecimal digits, "inf" and "nan", and
/// numbers beyond the range of a double (1e999, 1e-400).
[[nodiscard]] std::optional<double> parseNumber(std::string_view text) noexcept;
/// Removes the longest such number from the beginning of `text` and returns it; otherwise `text` stays as it is.
[[nodiscard]] std::optional<double> takeNumber(std::string_view& text) noexcept;
/// Numbers separated by commas, with blanks around each; nothing if one of them is not a number.
/// \param most  more numbers than this are refused as well
[[nodiscard]] std::optional<std::vector<double>> parseNumbers(std::string_view text, std::size_t most);

/// The integer that the whole of `text` spells, with a '-' in front only for signed types; nothing for other text and for
/// numbers beyond the range of `Integer`.
template <class Integer>
[[nodiscard]] std::optional<Integer> parseInteger(std::string_view text, int base = 10) noexcept {
    Integer value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// A to Z become a to z; other bytes stay.
[[nodiscard]] constexpr char lowerAscii(char c) noexcept {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
[[nodiscard]] std::string lowerAscii(std::string_view text);
[[nodiscard]] bool equalsIgnoringCase(std::string_view a, std::string_view b) noexcept;

/// The parts of "a|b|c"; none of an empty text.
[[nodiscard]] std::vector<std::string_view> splitChoices(std::string_view choices);

}  // namespace svt
