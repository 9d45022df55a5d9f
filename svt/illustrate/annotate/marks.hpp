#pragma once
/// \file
/// What a picture says of itself: its title, its scale, and where north is.

#include <svt/image/image.hpp>
#include <svt/render/frame_spec.hpp>

#include <string>

namespace svt::illustrate {

/// Draws `title` along the upper left edge, shortened to three quarters of the picture's width.
/// \param color, halo  of texts and lines, and of the outline around them; sRGB; of all functions of this file
void drawTitle(const std::string& title, Vec3f color, Vec3f halo, image::Image<image::Rgba8>& image);

/// Draws a bar of 1, 2 or 5 times a power of ten metres into the lower left corner, as long as fits into a quarter of the
/// picture's width, with its length below it.
/// \param camera  parallel: elsewhere a picture has no scale
void drawScaleBar(const render::Camera& camera, Vec3f color, Vec3f halo, image::Image<image::Rgba8>& image);

/// Draws an arrow into the lower right corner that points to where +y of the world, which is grid north, goes in the
/// picture; a ring with a dot where it goes nearly along the view.
void drawNorthArrow(const render::Camera& camera, Vec3f color, Vec3f halo, image::Image<image::Rgba8>& image);

}  // namespace svt::illustrate
