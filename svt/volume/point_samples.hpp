#pragma once
/// \file
/// The scalars at points of world space, many at a time: what a simulation, a scan or a walk through the building asks.

#include <svt/core/vec.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/volume/grid.hpp>

#include <span>

namespace svt::volume {

/// The scalar of the voxel that each point lies in: that of the nearest sample; a point on the face between two voxels
/// belongs to the upper one. Points outside of all voxels, and such with a NaN, are background.
/// \param columns  of the dimension of `grid`
/// \param points   world space, metres
/// \param out      one entry per point
/// \param threads  at most this many; 0: all cores. The result does not depend on it
/// Cost: O(log runs) per point; about 0.1 us per point and core, fewer for points in order.
void samplePoints(const ColumnVolume& columns, const Grid& grid, std::span<const Vec3d> points, std::span<Scalar> out,
                  int threads = 0);

}  // namespace svt::volume
