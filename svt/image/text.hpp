#pragma once
/// \file
/// Text in pictures: one line of one size, in DejaVu Sans, which is part of the program.

#include <svt/core/vec.hpp>
#include <svt/image/image.hpp>

#include <string_view>

namespace svt::image {

/// How a text looks.
struct TextLook {
    double height = 14;    ///< pixels, of a line; 4 to 512
    Vec3f color{0, 0, 0};  ///< sRGB, 0..1
    Vec3f halo{1, 1, 1};   ///< drawn around the letters, so that they are read on any ground
    double haloWidth = 2;  ///< pixels; 0: none
};

/// Pixels that `text` (UTF-8) takes along its line. What is no letter of the font counts as a box.
[[nodiscard]] double textWidth(std::string_view text, double height);

/// Draws `text` with its left end at `x` and its middle line at `y`; what reaches over the picture is left out. Cost:
/// O(pixels covered).
void drawText(Image<Rgba8>& image, double x, double y, std::string_view text, const TextLook& look);

/// How a line is drawn.
struct Stroke {
    double width = 1;  ///< pixels
    Vec3f color{0, 0, 0};
};

/// A straight line between two points of the picture, with soft edges.
void drawLine(Image<Rgba8>& image, double x0, double y0, double x1, double y1, const Stroke& look);
/// A full disc.
void drawDot(Image<Rgba8>& image, double x, double y, double radius, Vec3f color);

}  // namespace svt::image
