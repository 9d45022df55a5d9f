#include <svt/render/color.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace svt::render {
namespace {

// Fine enough for the steep foot of the curve: 12.92 * 255 / 16384 = 0.2 of a byte's step.
constexpr std::size_t kTableSize = 16384;

std::array<std::uint8_t, kTableSize + 1> makeTable() {
    std::array<std::uint8_t, kTableSize + 1> table{};
    for (std::size_t n = 0; n <= kTableSize; ++n)
        table[n] = static_cast<std::uint8_t>(
            std::lround(srgbFromLinear(static_cast<float>(n) / static_cast<float>(kTableSize)) * 255));
    return table;
}

}  // namespace

float linearFromSrgb(float channel) noexcept {
    return channel <= 0.04045f ? channel / 12.92f : std::pow((channel + 0.055f) / 1.055f, 2.4f);
}

float srgbFromLinear(float channel) noexcept {
    const float c = std::clamp(channel, 0.0f, 1.0f);
    return c <= 0.0031308f ? c * 12.92f : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
}

Vec3f linearFromSrgb(Vec3f color) noexcept {
    return {linearFromSrgb(color.x), linearFromSrgb(color.y), linearFromSrgb(color.z)};
}

Vec3f srgbFromLinear(Vec3f color) noexcept {
    return {srgbFromLinear(color.x), srgbFromLinear(color.y), srgbFromLinear(color.z)};
}

std::uint8_t srgbByteFromLinear(float channel) noexcept {
    static const std::array<std::uint8_t, kTableSize + 1> table = makeTable();
    const float c = std::clamp(channel, 0.0f, 1.0f);
    return table[static_cast<std::size_t>(c * static_cast<float>(kTableSize) + 0.5f)];
}

}  // namespace svt::render
