#pragma once
/// \file
/// The scalars at many points of world space at once, for a simulation, a scan or a walk through the building.

#include <svt/core/vec.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/volume/grid.hpp>

#include <span>

namespace svt::volume {

/// Finds the scalar of the voxel that contains each point, which is that of the nearest sample. A point on the face
/// between two voxels belongs to the upper one. Points outside of all voxels and points with a NaN are background.
/// \param columns  of the dimension of `grid`
/// \param points   world space, metres
/// \param out      one entry per point
/// \param threads  at most this many; 0: all cores. The result does not depend on it
/// Cost: O(log runs) per point; about 0.1 us per point and core, less for points in order.
void samplePoints(const ColumnVolume& columns, const Grid& grid, std::span<const Vec3d> points, std::span<Scalar> out,
                  int threads = 0);

}  // namespace svt::volume
