#pragma once
/// \file
/// The legend of a picture: what its colours mean.

#include <svt/illustrate/color_by.hpp>
#include <svt/image/image.hpp>

#include <cstdint>

namespace svt::illustrate {

/// What a view leaves free at each side for a legend, as a share of the picture's width, 0 to 0.3.
[[nodiscard]] double legendMargin(std::int32_t width, std::int32_t height) noexcept;

/// Draws the legend of `scale` into the upper right corner of a picture: a title, and a bar with round values, or the
/// entries with their colours. Entries for which there is no room are counted in the last line. Texts are as high as
/// names, see nameHeight(), and shortened to the room of legendMargin().
/// \param color, halo  of texts and of the outline around them; sRGB
void drawLegend(const ColorScale& scale, Vec3f color, Vec3f halo, image::Image<image::Rgba8>& image);

}  // namespace svt::illustrate
