#pragma once
/// \file
/// Bodies that depend on where the viewer stands: what is seen in a circle, and what hides a target.

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/volume/grid.hpp>

namespace svt::illustrate {

/// All that is seen in a circle of the picture: a cone from the eye, or a cylinder along a parallel view.
/// \param x, y    its middle from the upper left corner, as shares of the picture's width and height
/// \param radius  as a share of its height, > 0
[[nodiscard]] render::RoundBody viewBody(const render::Camera& camera, double aspect, double x, double y,
                                         double radius);

/// What must go so that a target is seen: a cone around it that opens towards the viewer by kCutawaySlope more than the
/// view itself, so that its cut faces are seen, and that ends in a tip behind the target.
/// \param target  samples around which it goes
/// \param margin  metres left free around the target
[[nodiscard]] render::RoundBody cutawayBody(const render::Camera& camera, const volume::Grid& grid,
                                            const analyze::SampleBox& target, double margin);

/// Slope of the cutaway's cone against the lines of sight: tan 25 degrees.
inline constexpr double kCutawaySlope = 0.4663;

}  // namespace svt::illustrate
