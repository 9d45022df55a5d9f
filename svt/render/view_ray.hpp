#pragma once
/// \file
/// The ray behind a place of a picture: what a click points at.

#include <svt/render/frame_spec.hpp>
#include <svt/volume/grid.hpp>

namespace svt::render {

/// World space. `origin + direction * depth` is what is seen in that depth.
struct ViewRay {
    Vec3d origin{};     ///< in the eye plane
    Vec3d direction{};  ///< its share along the view direction has length 1
};

/// \param spec  one that passed checkFrameSpec()
/// \param x, y  share of the picture's width and height, 0..1 from its upper left corner
[[nodiscard]] ViewRay viewRay(const FrameSpec& spec, const volume::Grid& grid, double x, double y);

}  // namespace svt::render
