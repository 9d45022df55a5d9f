#pragma once
/// \file
/// View-dependent bodies: the space visible in a circle of the picture, and the space that hides a target.

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/volume/grid.hpp>

#include <cstddef>
#include <vector>

namespace svt::illustrate {

/// Slope of the cutaway cone relative to the lines of sight: tan 25 degrees.
inline constexpr double kCutawaySlope = 0.4663;

/// The space visible in a circle of the picture: a cone from the eye, or a cylinder if the view is parallel.
/// \param aspect  width / height of the picture
/// \param x, y    centre of the circle from the upper left corner, as shares of the picture's width and height
/// \param radius  as a share of the picture's height, > 0
[[nodiscard]] render::RoundBody viewBody(const render::Camera& camera, double aspect, double x, double y,
                                         double radius);

/// The body to cut away so that a target is visible: a cone around the target, with its apex behind it. The cone opens
/// towards the viewer by `slope` more than the lines of sight, so that its cut faces are visible.
/// \param target  samples to enclose
/// \param margin  metres left free around the target
[[nodiscard]] render::RoundBody cutawayBody(const render::Camera& camera, const volume::Grid& grid,
                                            const analyze::SampleBox& target, double margin,
                                            double slope = kCutawaySlope);

/// The regions to cut away so that several targets are visible: one per target, or one for targets whose regions
/// contain each other. A single target gets the region of cutawayBody(). Several regions open as wide as possible
/// without meeting in the volume, so that the parts between them stay connected up to the viewer. Narrow regions end
/// behind their targets. If even narrow regions meet, their targets become a group. The common box of a group and the
/// space in front of it are cut away, but nothing beside or behind it. No two regions share a point of the volume.
/// \param targets  samples to enclose, of each target; at least one
/// \param most     maximum number of regions, >= 1: the nearest targets are joined until it is reached
/// Cost: O(targets^2) for up to 64 targets; more form a group.
[[nodiscard]] std::vector<render::ConvexPart> cutawayParts(const render::Camera& camera, const volume::Grid& grid,
                                                           std::vector<analyze::SampleBox> targets, double margin,
                                                           std::size_t most);

}  // namespace svt::illustrate
