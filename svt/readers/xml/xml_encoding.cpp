#include <svt/core/text.hpp>
#include <svt/readers/xml/xml_encoding.hpp>

#include <svt/readers/xml/xml_scanner.hpp>

#include <fmt/format.h>
#include <simdjson.h>

#ifndef __EMSCRIPTEN__
#include <iconv.h>
#endif

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

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

enum class OneByte { Latin1, Latin9, Windows1252 };

// Where ISO-8859-15 (Latin-9) is not ISO-8859-1.
constexpr std::pair<unsigned char, std::uint16_t> kLatin9[] = {{0xA4, 0x20AC}, {0xA6, 0x0160}, {0xA8, 0x0161},
                                                               {0xB4, 0x017D}, {0xB8, 0x017E}, {0xBC, 0x0152},
                                                               {0xBD, 0x0153}, {0xBE, 0x0178}};

Utf8Text fromOneByte(string_view bytes, OneByte kind) {
    std::uint32_t codes[256];
    for (std::uint32_t code = 0; code < 256; ++code) {
        codes[code] = code;
        if (kind == OneByte::Windows1252 && code >= 0x80 && code < 0xA0 && kWindows1252[code - 0x80] != 0)
            codes[code] = kWindows1252[code - 0x80];
    }
    if (kind == OneByte::Latin9)
        for (const auto& [byte, code] : kLatin9) codes[byte] = code;
    Utf8Text text;
    text.owned.reserve(bytes.size() + bytes.size() / 16);
    for (const char c : bytes) appendUtf8(codes[static_cast<unsigned char>(c)], text.owned);
    return text;
}

Error badEncoding(string_view fileName, std::string message) {
    return {Code::BadEncoding, std::move(message), {std::string(fileName), 1, 1, {}}};
}

#ifdef __EMSCRIPTEN__
Result<Utf8Text> fromOther(string_view, const std::string& encoding, string_view fileName) {
    return badEncoding(fileName, fmt::format("the file declares the encoding '{}'; UTF-8, UTF-16, ISO-8859-1, "
                                             "ISO-8859-15 and Windows-1252 can be read. Convert it, for instance with "
                                             "iconv",
                                             encoding.substr(0, 40)));
}
#else
// Encodings for iconv: text encodings that extend ASCII, without stateful ones.
bool isForIconv(string_view encoding) noexcept {
    constexpr string_view kFamilies[] = {"iso-8859-", "iso8859-",  "windows-", "cp",       "koi8-",
                                         "shift_jis", "shift-jis", "sjis",     "euc-",     "gbk",
                                         "gb2312",    "gb18030",   "big5",     "macintosh"};
    const bool isPlain = std::all_of(encoding.begin(), encoding.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || isDigit(c) || c == '-' || c == '_';
    });
    return isPlain && encoding.size() < 32 &&
           std::any_of(std::begin(kFamilies), std::end(kFamilies),
                       [&](string_view family) { return encoding.starts_with(family); });
}

Result<Utf8Text> fromOther(string_view bytes, const std::string& encoding, string_view fileName) {
    const auto kFailed = reinterpret_cast<iconv_t>(-1);
    const iconv_t converter = isForIconv(encoding) ? iconv_open("UTF-8", encoding.c_str()) : kFailed;
    if (converter == kFailed)
        return badEncoding(fileName,
                           fmt::format("the file declares the encoding '{}', which is not known; convert it to "
                                       "UTF-8, for instance with iconv",
                                       encoding.substr(0, 40)));
    Utf8Text text;
    char* from = const_cast<char*>(bytes.data());
    std::size_t left = bytes.size();
    std::vector<char> block(std::size_t{1} << 16);
    bool isGood = true;
    while (left > 0 && isGood) {
        char* to = block.data();
        std::size_t room = block.size();
        const std::size_t before = left;
        const bool isDone = iconv(converter, &from, &left, &to, &room) != static_cast<std::size_t>(-1);
        text.owned.append(block.data(), block.size() - room);
        // A full block is not a failure; a call without progress is.
        isGood = isDone || (left < before && room < 16);
    }
    iconv_close(converter);
    if (isGood) return text;
    return badEncoding(fileName, fmt::format("byte {} is not valid in the encoding '{}' that the file declares",
                                             bytes.size() - left, encoding));
}
#endif

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
    if (encoding == "iso-8859-1" || encoding == "latin1" || encoding == "iso8859-1")
        return fromOneByte(text, OneByte::Latin1);
    if (encoding == "iso-8859-15" || encoding == "latin-9" || encoding == "iso8859-15")
        return fromOneByte(text, OneByte::Latin9);
    if (encoding == "windows-1252" || encoding == "cp1252") return fromOneByte(text, OneByte::Windows1252);
    return fromOther(text, encoding, fileName);
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
