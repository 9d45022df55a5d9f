#include <svt/writers/ladm/step_records.hpp>

#include <svt/core/text.hpp>

#include <array>

namespace svt::writers {
namespace {

constexpr std::string_view kGlobalIdDigits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";

bool isGlobalId(std::string_view text) {
    return text.size() == 22 && text[0] >= '0' && text[0] <= '3' &&
           text.find_first_not_of(kGlobalIdDigits) == std::string_view::npos;
}

// FNV-1a, then the final steps of MurmurHash3.
std::uint64_t stableHash(std::string_view text, std::uint64_t seed) {
    std::uint64_t hash = 0xcbf29ce484222325ull ^ seed;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
    hash = (hash ^ hash >> 33) * 0xff51afd7ed558ccdull;
    hash = (hash ^ hash >> 33) * 0xc4ceb9fe1a85ec53ull;
    return hash ^ hash >> 33;
}

}  // namespace

std::string stepString(std::string_view text) {
    std::string quoted = "'";
    while (!text.empty()) {
        auto [code, size] = firstCharacter(text);
        if (size == 0) {
            code = 0xFFFD;
            size = 1;
        }
        text.remove_prefix(size);
        if (code == '\'')
            quoted += "''";
        else if (code == '\\')
            quoted += "\\\\";
        else if (code >= 0x20 && code < 0x7F)
            quoted += static_cast<char>(code);
        else if (code < 0x10000)
            quoted += fmt::format("\\X2\\{:04X}\\X0\\", static_cast<std::uint32_t>(code));
        else
            quoted += fmt::format("\\X4\\{:08X}\\X0\\", static_cast<std::uint32_t>(code));
    }
    return quoted + "'";
}

std::string stepOptional(std::string_view text) { return text.empty() ? "$" : stepString(text); }

std::string stepReal(double value) {
    std::string text = fmt::format("{:.9f}", value);
    while (text.back() == '0') text.pop_back();
    return text == "-0." ? "0." : text;
}

std::string stepList(const std::vector<int>& records) {
    std::string text;
    for (const int record : records) text += (text.empty() ? "#" : ",#") + std::to_string(record);
    return "(" + text + ")";
}

std::string ifcGlobalId(std::string_view key) {
    if (isGlobalId(key)) return std::string(key);
    const std::array<std::uint64_t, 2> bits{stableHash(key, 0), stableHash(key, 0x9E3779B97F4A7C15ull)};
    std::string id;
    // 128 bits: two in the first digit, six in each of the others.
    for (int digit = 0; digit < 22; ++digit) {
        const int low = 126 - 6 * digit;
        std::size_t value = 0;
        for (int bit = 5; bit >= 0; --bit) {
            const int at = low + bit;
            value = value << 1 | (at < 128 ? bits[std::size_t(at / 64)] >> (at % 64) & 1 : 0);
        }
        id += kGlobalIdDigits[value];
    }
    return id;
}

}  // namespace svt::writers
