#pragma once
/// \file
/// The legend of a picture: the meaning of its colours.

#include <svt/illustrate/color_by.hpp>
#include <svt/image/image.hpp>

#include <cstdint>

namespace svt::illustrate {

/// The margin at each side of a view for a legend, as a share of the picture's width, 0 to 0.3.
[[nodiscard]] double legendMargin(std::int32_t width, std::int32_t height) noexcept;

/// Draws the legend of `scale` into the upper right corner of a picture: a title, and a bar with round values, or the
/// entries with their colours. The last line states the number of entries that do not fit. Texts are as high as names,
/// see nameHeight(), and shortened to fit legendMargin().
/// \param color, halo  colours of texts and of the outline around them; sRGB
void drawLegend(const ColorScale& scale, Vec3f color, Vec3f halo, image::Image<image::Rgba8>& image);

}  // namespace svt::illustrate
