#pragma once
/// \file
/// The points that a camera must show: the outermost points of the parts that the passes of a frame draw.

#include <svt/render/frame_spec.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <span>
#include <vector>

namespace svt::illustrate {

/// Points of world space whose convex hull contains everything that a pass draws. Hidden, fully transparent or clipped
/// parts do not count. Meshes of a pass count with their corners; its lines do not count. A hull that a pass draws in
/// place of the volume lies within these points, too.
/// \return empty if nothing is drawn
/// Cost: O(runs of distinct columns), and for each pass O(runs) of 256 x 256 columns, twice with clips. Points are up
/// to half a step between such columns too far outside.
[[nodiscard]] std::vector<Vec3d> visiblePoints(std::span<const render::Pass> passes,
                                               const volume::SemanticVolume& volume);

}  // namespace svt::illustrate
