#pragma once
/// \file
/// Constants that C++ and the shaders share. They are defined only in C++; the shaders get them as lines of GLSL.

#include <svt/render/frame_spec.hpp>
#include <svt/render/pass_table.hpp>

#include <cstdint>
#include <string_view>

namespace svt::render_gl {

/// Stands for infinity in shaders, which not all drivers support.
inline constexpr float kFar = 3.0e38f;
/// No plane, no object, no palette brick.
inline constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// Texels of one element of a table: a style, a code of bricks; a line, the style of lines, a triangle.
inline constexpr std::uint32_t kStyleTexels = 2, kCodeTexels = 3, kLineTexels = 3, kLineStyleTexels = 3,
                               kTriangleTexels = 6;
/// Side of the squares of the picture that lines and triangles are sorted into, pixels.
inline constexpr std::int32_t kSquarePixels = 4;

/// Samples along a pixel at most, see FrameSpec::samplesPerPixel.
inline constexpr std::int32_t kMaxSide = 4;
/// Samples that border lines reach at most: twice half of the widest line.
inline constexpr std::int32_t kMaxReach = static_cast<std::int32_t>(render::BorderLines::kMaxWidth) * kMaxSide;

/// How the first pass is joined; the others have the numbers of render::Pass::Join.
inline constexpr std::uint32_t kFirstPass = 3;

/// Flags of a style: its kind, whether it is a body, its hatch.
inline constexpr std::uint32_t kKindBits = 3, kBodyBit = 4, kHatchShift = 8;
[[nodiscard]] inline std::uint32_t flagsOf(const render::LinearStyle& style, render::Hatch hatch) noexcept {
    return static_cast<std::uint32_t>(style.kind) | (style.isBody ? kBodyBit : 0) |
           static_cast<std::uint32_t>(hatch) << kHatchShift;
}

/// All of them, and those of svt/render that the shaders use, as declarations such as "const float kFar = 3e+38;", one
/// per line.
[[nodiscard]] std::string_view sharedConstants();

}  // namespace svt::render_gl
