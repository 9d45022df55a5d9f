#pragma once
/// \file
/// What lies along a ray, from the eye on.

#include <svt/core/result.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/grid.hpp>
#include <svt/volume/label_table.hpp>

#include <cstdint>
#include <vector>

namespace svt::render {

/// A stretch of a ray inside one label.
struct RayStretch {
    std::uint32_t label = 0;
    double enter = 0, leave = 0;  ///< metres from the ray's origin
    friend bool operator==(const RayStretch&, const RayStretch&) = default;
};

/// The labels that a ray goes through, in order; background is left out. A label that the ray meets again comes again.
///
/// \param origin     world space, metres; may lie inside or outside the volume
/// \param direction  world space, any length but zero
/// \return the stretches, or BadArgument where a number is not finite or the direction is zero
/// Faces between labels lie where the bricks have them: within half a voxel of the model's.
/// Cost: O(boxes of one label along the ray).
[[nodiscard]] Result<std::vector<RayStretch>> labelsAlong(const volume::BrickVolume& bricks, const volume::Grid& grid,
                                                          const volume::LabelTable& labels, Vec3d origin,
                                                          Vec3d direction);

}  // namespace svt::render
