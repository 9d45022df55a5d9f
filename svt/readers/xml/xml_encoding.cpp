#include <svt/core/text.hpp>
#include <svt/readers/xml/xml_encoding.hpp>

#include <svt/readers/xml/xml_scanner.hpp>

#include <fmt/format.h>
#include <simdjson.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace svt::readers::xml {
namespace {

using std::string_view;

Result<Utf8Text> fromUtf16(string_view bytes, bool isBigEndian, string_view fileName) {
    const auto unitAt = [&](std::size_t i) {
        const auto first = static_cast<unsigned char>(bytes[i]);
        const auto second = static_cast<unsigned char>(bytes[i + 1]);
        return static_cast<std::uint32_t>(isBigEndian ? first << 8 | second : second << 8 | first);
    };
    const auto bad = [&](std::size_t at) {
        return Error(Code::BadEncoding, fmt::format("broken UTF-16 at byte {}", at), {std::string(fileName), 0, 0, {}});
    };
    if (bytes.size() % 2 != 0) return bad(bytes.size() - 1);
    Utf8Text text;
    text.owned.reserve(bytes.size() / 2);
    for (std::size_t i = 0; i < bytes.size(); i += 2) {
        std::uint32_t code = unitAt(i);
        if (code >= 0xDC00 && code <= 0xDFFF) return bad(i);
        if (code >= 0xD800 && code <= 0xDBFF) {
            if (i + 3 >= bytes.size()) return bad(i);
            const std::uint32_t low = unitAt(i + 2);
            if (low < 0xDC00 || low > 0xDFFF) return bad(i);
            code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
            i += 2;
        }
        appendUtf8(code, text.owned);
    }
    return text;
}

// 0x80 to 0x9F of Windows-1252; 0: unassigned.
constexpr std::uint16_t kWindows1252[32] = {0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                            0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0,      0x017D, 0,
                                            0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                            0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0,      0x017E, 0x0178};

Utf8Text fromOneByte(string_view bytes, bool isWindows) {
    Utf8Text text;
    text.owned.reserve(bytes.size() + bytes.size() / 16);
    for (const char c : bytes) {
        std::uint32_t code = static_cast<unsigned char>(c);
        if (isWindows && code >= 0x80 && code < 0xA0 && kWindows1252[code - 0x80] != 0)
            code = kWindows1252[code - 0x80];
        appendUtf8(code, text.owned);
    }
    return text;
}

}  // namespace

Result<Utf8Text> toUtf8(std::span<const std::byte> bytes, string_view fileName) {
    string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\xFF\xFE")) return fromUtf16(text.substr(2), false, fileName);
    if (text.starts_with("\xFE\xFF")) return fromUtf16(text.substr(2), true, fileName);
    if (text.starts_with(string_view("<\0?\0", 4))) return fromUtf16(text, false, fileName);
    if (text.starts_with(string_view("\0<\0?", 4))) return fromUtf16(text, true, fileName);
    if (text.starts_with("\xEF\xBB\xBF")) return Utf8Text{text.substr(3), {}};

    const std::string encoding = lowerAscii(readProlog(text.substr(0, 4096)).encoding);
    if (encoding.empty() || encoding == "utf-8" || encoding == "utf8" || encoding == "us-ascii" || encoding == "ascii")
        return Utf8Text{text, {}};
    if (encoding == "iso-8859-1" || encoding == "latin1" || encoding == "iso8859-1") return fromOneByte(text, false);
    if (encoding == "windows-1252" || encoding == "cp1252") return fromOneByte(text, true);
    return Error(
        Code::BadEncoding,
        fmt::format("the file declares the encoding '{}'; UTF-8, UTF-16, ISO-8859-1 and Windows-1252 can be read. "
                    "Convert it, for instance with iconv",
                    encoding.substr(0, 40)),
        {std::string(fileName), 1, 1, {}});
}

std::size_t firstBadUtf8(string_view text) noexcept {
    const void* const nul = std::memchr(text.data(), 0, text.size());
    if (nul == nullptr && simdjson::validate_utf8(text.data(), text.size())) return string_view::npos;
    // Rare: locate the error, one character at a time.
    std::size_t i = 0;
    while (i < text.size()) {
        const Utf8Character character = firstCharacter(text.substr(i));
        if (character.size == 0 || character.code == 0) return i;
        i += character.size;
    }
    return string_view::npos;
}

}  // namespace svt::readers::xml
