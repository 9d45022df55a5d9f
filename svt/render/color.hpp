#pragma once
/// \file
/// Between sRGB, in which colours are given and stored, and linear light, in which they are lit and blended.

#include <svt/core/vec.hpp>

#include <cstdint>

namespace svt::render {

/// Linear light, 0..1, of an sRGB channel, 0..1 (IEC 61966-2-1).
[[nodiscard]] float linearFromSrgb(float channel) noexcept;
[[nodiscard]] Vec3f linearFromSrgb(Vec3f color) noexcept;

/// sRGB channel, 0..1, of linear light; clamped to 0..1 first.
[[nodiscard]] float srgbFromLinear(float channel) noexcept;
[[nodiscard]] Vec3f srgbFromLinear(Vec3f color) noexcept;

/// srgbFromLinear() * 255, rounded, from a table. Within one step of the exact value.
[[nodiscard]] std::uint8_t srgbByteFromLinear(float channel) noexcept;

}  // namespace svt::render
