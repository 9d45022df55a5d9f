#pragma once
/// \file
/// View-dependent bodies: all that is seen in a circle of the picture, and all that hides a target.

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/volume/grid.hpp>

#include <cstddef>
#include <vector>

namespace svt::illustrate {

/// Slope of the cutaway cone relative to the lines of sight: tan 25 degrees.
inline constexpr double kCutawaySlope = 0.4663;

/// The body of all that is seen in a circle of the picture: a cone from the eye, or a cylinder if the view is parallel.
/// \param aspect  width / height of the picture
/// \param x, y    centre of the circle from the upper left corner, as shares of the picture's width and height
/// \param radius  as a share of the picture's height, > 0
[[nodiscard]] render::RoundBody viewBody(const render::Camera& camera, double aspect, double x, double y,
                                         double radius);

/// The body to cut away so that a target is visible: a cone around it, with its apex behind the target, that opens
/// towards the viewer by `slope` more than the lines of sight, so that its caps are visible.
/// \param target  samples to enclose
/// \param margin  metres left free around the target
[[nodiscard]] render::RoundBody cutawayBody(const render::Camera& camera, const volume::Grid& grid,
                                            const analyze::SampleBox& target, double margin,
                                            double slope = kCutawaySlope);

/// The regions to cut away so that several targets are visible: one for each, and one for targets that stand in each other's.
/// One target has that of cutawayBody(). Several open as wide as keeps them apart within the volume, so that what stays
/// between them hangs together up to the viewer; narrow ones end behind their targets. Where even narrow ones meet, the
/// targets become a group: their common box and what is before it are cut away, and nothing beside or behind it. No two
/// regions share a point of the volume.
/// \param targets  samples to enclose, of each target; at least one
/// \param most     regions, >= 1: the targets that are nearest to each other are joined until there are no more
/// Cost: O(targets^2) for up to 64 of them; more are a group.
[[nodiscard]] std::vector<render::ConvexPart> cutawayParts(const render::Camera& camera, const volume::Grid& grid,
                                                           std::vector<analyze::SampleBox> targets, double margin,
                                                           std::size_t most);

}  // namespace svt::illustrate
