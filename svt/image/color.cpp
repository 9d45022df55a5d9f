#include <svt/image/color.hpp>

#include <cmath>

namespace svt::image {
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

SrgbBytes::SrgbBytes() {
    for (std::size_t n = 0; n <= kLast; ++n)
        bytes_[n] = static_cast<std::uint8_t>(
            std::lround(srgbFromLinear(static_cast<float>(n) / static_cast<float>(kLast)) * 255));
}

const SrgbBytes& SrgbBytes::table() {
    static const SrgbBytes table;
    return table;
}

}  // namespace svt::image
