#pragma once
/// \file
/// The labels along a ray, from its origin on.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/grid.hpp>
#include <svt/volume/label_table.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
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

/// The intervals of many rays, ray after ray: ray r has the intervals from intervals[start[r]] to before
/// intervals[start[r + 1]].
struct RayIntervals {
    std::vector<std::uint64_t> start;  ///< rays + 1 entries
    std::vector<LabelInterval> intervals;
};

/// The same for many rays at once.
/// \param origins     world space, metres
/// \param directions  world space, any length but zero; as many as origins, or one that all rays share
/// \param threads     0: all cores; the result does not depend on it
/// \param progress    stage "rays"; may be null
/// \return the intervals, or BadArgument if a number is not finite, a direction is zero (the message names the ray) or
///         the counts do not match; Cancelled
/// Cost: that of the rays, and O(scalars) once. Memory: the result, twice while it is joined.
[[nodiscard]] Result<RayIntervals> labelsAlongRays(const volume::BrickVolume& bricks, const volume::Grid& grid,
                                                   const volume::LabelTable& labels, std::span<const Vec3d> origins,
                                                   std::span<const Vec3d> directions, int threads = 0,
                                                   const Progress* progress = nullptr);

}  // namespace svt::render
