#include <svt/image/color_text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

namespace svt::image {
namespace {

constexpr std::array<std::pair<std::string_view, std::uint32_t>, 36> kColorNames{{
    {"black", 0x000000},     {"white", 0xFFFFFF},     {"gray", 0x808080},      {"grey", 0x808080},
    {"silver", 0xC0C0C0},    {"red", 0xFF0000},       {"maroon", 0x800000},    {"orange", 0xFFA500},
    {"gold", 0xFFD700},      {"yellow", 0xFFFF00},    {"olive", 0x808000},     {"lime", 0x00FF00},
    {"green", 0x008000},     {"teal", 0x008080},      {"cyan", 0x00FFFF},      {"aqua", 0x00FFFF},
    {"blue", 0x0000FF},      {"navy", 0x000080},      {"purple", 0x800080},    {"magenta", 0xFF00FF},
    {"fuchsia", 0xFF00FF},   {"pink", 0xFFC0CB},      {"brown", 0xA52A2A},     {"beige", 0xF5F5DC},
    {"ivory", 0xFFFFF0},     {"tan", 0xD2B48C},       {"salmon", 0xFA8072},    {"tomato", 0xFF6347},
    {"coral", 0xFF7F50},     {"crimson", 0xDC143C},   {"turquoise", 0x40E0D0}, {"skyblue", 0x87CEEB},
    {"steelblue", 0x4682B4}, {"slategray", 0x708090}, {"indigo", 0x4B0082},    {"violet", 0xEE82EE},
}};

Vec3f fromBytes(std::uint32_t rgb) {
    return {float((rgb >> 16) & 255) / 255.0f, float((rgb >> 8) & 255) / 255.0f, float(rgb & 255) / 255.0f};
}

}  // namespace

Result<Vec3f> parseColor(std::string_view text) {
    for (const auto& [name, rgb] : kColorNames)
        if (name == text) return fromBytes(rgb);
    const bool isHex = text.size() > 1 && text[0] == '#' &&
                       text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string_view::npos;
    if (isHex && (text.size() == 7 || text.size() == 4)) {
        std::uint32_t rgb = 0;
        for (const char c : text.substr(1)) {
            const auto digit = static_cast<std::uint32_t>(c <= '9' ? c - '0' : (c | 32) - 'a' + 10);
            rgb = text.size() == 7 ? rgb << 4 | digit : rgb << 8 | digit * 17;
        }
        return fromBytes(rgb);
    }
    std::string names;
    for (const auto& entry : kColorNames) names += fmt::format("{}{}", names.empty() ? "" : ", ", entry.first);
    return Error(Code::BadStyle, fmt::format("unknown colour '{}'; write #rrggbb, #rgb or one of {}", text, names));
}

std::string colorText(Vec3f color) {
    const auto byte = [](float c) { return static_cast<int>(std::lround(std::clamp(c, 0.0f, 1.0f) * 255)); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(color.x), byte(color.y), byte(color.z));
}

}  // namespace svt::image
