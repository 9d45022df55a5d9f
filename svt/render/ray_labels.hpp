#pragma once
/// \file
/// The labels along a ray, from its origin on.

#include <svt/core/result.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/grid.hpp>
#include <svt/volume/label_table.hpp>

#include <cstdint>
#include <vector>

namespace svt::render {

/// An interval of a ray inside one label.
struct LabelInterval {
    std::uint32_t label = 0;
    double enter = 0, leave = 0;  ///< metres from the ray's origin
    friend bool operator==(const LabelInterval&, const LabelInterval&) = default;
};

/// The labels that a ray goes through, in order, without background. A label that the ray enters again is listed again.
///
/// \param origin     world space, metres; may lie inside or outside the volume
/// \param direction  world space, any length but zero
/// \return the intervals, or BadArgument if a number is not finite or the direction is zero
/// Faces between labels are those of the bricks: within half a voxel of the model's.
/// Cost: O(boxes of one label along the ray).
[[nodiscard]] Result<std::vector<LabelInterval>> labelsAlong(const volume::BrickVolume& bricks,
                                                             const volume::Grid& grid, const volume::LabelTable& labels,
                                                             Vec3d origin, Vec3d direction);

}  // namespace svt::render
