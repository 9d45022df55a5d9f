#pragma once
/// \file
/// Text in images: single lines in DejaVu Sans, which is embedded in the program; lines and dots.

#include <svt/core/vec.hpp>
#include <svt/image/image.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace svt::image {

/// How a text looks.
struct TextStyle {
    double height = 14;    ///< line height, pixels; 4 to 512
    Vec3f color{0, 0, 0};  ///< sRGB, 0..1
    Vec3f halo{1, 1, 1};   ///< sRGB, 0..1; an outline of the letters, for legibility on any background
    double haloWidth = 2;  ///< pixels; 0: none
};

/// DejaVu Sans, as a TrueType file.
[[nodiscard]] std::span<const std::byte> embeddedFont() noexcept;

/// Width of `text` (UTF-8), pixels. Characters that are missing in the font have the width of a box.
[[nodiscard]] double textWidth(std::string_view text, double height);

/// The characters of `text` (UTF-8) that the font does not have, each once, in order. Control characters do not count.
/// Cost: O(length).
[[nodiscard]] std::string missingLetters(std::string_view text);

/// Draws `text` with its left end at `x`, vertically centred at `y`; clipped to the image. Cost: O(pixels covered).
void drawText(Image<Rgba8>& image, double x, double y, std::string_view text, const TextStyle& style);

/// Style of a line.
struct Stroke {
    double width = 1;  ///< pixels
    Vec3f color{0, 0, 0};
};

/// Draws an antialiased line segment.
void drawLine(Image<Rgba8>& image, double x0, double y0, double x1, double y1, const Stroke& look);
/// Draws a filled disc.
void drawDot(Image<Rgba8>& image, double x, double y, double radius, Vec3f color);

}  // namespace svt::image
