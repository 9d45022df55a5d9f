#pragma once
/// \file
/// Conversion between sRGB, in which colours are given and stored, and linear light, in which they are lit and blended.

#include <svt/core/vec.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace svt::image {

/// Linear light, 0..1, of an sRGB channel, 0..1 (IEC 61966-2-1).
[[nodiscard]] float linearFromSrgb(float channel) noexcept;
[[nodiscard]] Vec3f linearFromSrgb(Vec3f color) noexcept;

/// sRGB channel, 0..1, of linear light; clamped to 0..1 first.
[[nodiscard]] float srgbFromLinear(float channel) noexcept;
[[nodiscard]] Vec3f srgbFromLinear(Vec3f color) noexcept;

/// srgbFromLinear() * 255, rounded, from a table. Within one step of the exact value.
class SrgbBytes {
public:
    /// The shared table.
    [[nodiscard]] static const SrgbBytes& table();

    [[nodiscard]] std::uint8_t fromLinear(float channel) const noexcept { return (*this)[place(channel)]; }
    /// The same in two steps, for vectorized loops: the index into the table, and the look-up by operator[].
    [[nodiscard]] static std::int32_t place(float channel) noexcept {
        const float c = std::min(std::max(channel, 0.0f), 1.0f);
        return static_cast<std::int32_t>(c * static_cast<float>(kLast) + 0.5f);
    }
    [[nodiscard]] std::uint8_t operator[](std::int32_t place) const noexcept {
        return bytes_[static_cast<std::size_t>(place)];
    }

private:
    SrgbBytes();

    // Fine enough for the steep start of the curve: 12.92 * 255 / 16384 = 0.2 steps of a byte.
    static constexpr std::size_t kLast = 16384;
    std::array<std::uint8_t, kLast + 1> bytes_{};
};

}  // namespace svt::image
