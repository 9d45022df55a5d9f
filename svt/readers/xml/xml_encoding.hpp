#pragma once
/// \file
/// Converts XML to UTF-8.

#include <svt/core/result.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace svt::readers::xml {

/// Text in UTF-8 without byte order mark: a view of the input if possible, else of `owned`.
struct Utf8Text {
    std::string_view text;
    std::string owned;
    [[nodiscard]] std::string_view view() const noexcept { return owned.empty() ? text : std::string_view(owned); }
};

/// Converts UTF-16, ISO-8859-1, ISO-8859-15 and Windows-1252; iconv converts other encodings that extend ASCII, if the
/// system has it (not in WebAssembly). UTF-8 is not checked here (see firstBadUtf8).
/// \return the text, or BadEncoding for any other declared encoding and for bytes that are not valid in it
Result<Utf8Text> toUtf8(std::span<const std::byte> bytes, std::string_view fileName);

/// Offset of the first byte of invalid UTF-8 (including overlong forms and surrogates) or of a character that XML
/// forbids (NUL), or npos. Cost: several GB/s.
[[nodiscard]] std::size_t firstBadUtf8(std::string_view text) noexcept;

}  // namespace svt::readers::xml
