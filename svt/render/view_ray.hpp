#pragma once
/// \file
/// The ray through a point of a picture, as for picking.

#include <svt/render/frame_spec.hpp>
#include <svt/volume/grid.hpp>

namespace svt::render {

/// World space. `origin + direction * depth` is the point seen at that depth.
struct ViewRay {
    Vec3d origin{};     ///< in the eye plane
    Vec3d direction{};  ///< its component along the view direction has length 1
};

/// The ray through (x, y).
/// \param spec  must have passed checkFrameSpec()
/// \param x, y  shares of the picture's width and height, 0..1 from its upper left corner
[[nodiscard]] ViewRay viewRay(const FrameSpec& spec, const volume::Grid& grid, double x, double y);

}  // namespace svt::render
