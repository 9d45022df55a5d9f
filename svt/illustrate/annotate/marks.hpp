#pragma once
/// \file
/// Marks in a picture: its title, its scale, and the direction of north.

#include <svt/image/image.hpp>
#include <svt/render/frame_spec.hpp>

#include <string>

namespace svt::illustrate {

/// Draws `title` along the upper left edge, shortened to three quarters of the picture's width.
/// \param color, halo  colours of texts and lines, and of the outline around them; sRGB; the same in all functions here
void drawTitle(const std::string& title, Vec3f color, Vec3f halo, image::Image<image::Rgba8>& image);

/// Draws a bar of 1, 2 or 5 times a power of ten metres into the lower left corner, as long as fits into a quarter of
/// the picture's width, with its length below it.
/// \param camera  a parallel camera; other pictures have no single scale
void drawScaleBar(const render::Camera& camera, Vec3f color, Vec3f halo, image::Image<image::Rgba8>& image);

/// Draws an arrow into the lower right corner that points to north in the picture. If north is nearly parallel to the
/// view direction, draws a ring with a dot.
/// \param north  unit length, world space: drawing::North::direction()
void drawNorthArrow(const render::Camera& camera, Vec3d north, Vec3f color, Vec3f halo,
                    image::Image<image::Rgba8>& image);

}  // namespace svt::illustrate
