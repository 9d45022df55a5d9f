#pragma once
/// \file
/// Voxels on the outside of a body that none of its surfaces took. Some lie at edges, where a step of voxels is beyond
/// the last sample line through a face. Others lie where a filling ends beside its faces.

#include <svt/voxelize/rewrite/rewrite.hpp>
#include <svt/voxelize/surfaces/body_faces.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <span>
#include <vector>

namespace svt::voxelize {

/// Largest distance of such a voxel's centre from a face on the body, in voxels (of the largest spacing). The face
/// passes between the voxel and its neighbour outside, one voxel away; the rest is for shells that are not exact.
inline constexpr double kBareReach = 1.5;

/// Gives each voxel of a body that has background beside, above or below it to the surface whose face is nearest to its
/// centre, within kBareReach. Equal distances go to the surface that is first in the tree. So the result depends neither
/// on the order of voxels nor on the axes.
/// \param faces  see makeBodyFaces()
/// Cost: O(runs of distinct columns + pairs of neighbouring columns), and O(faces close by) for each such voxel.
[[nodiscard]] std::vector<VoxelEdit> findBareVoxels(const volume::ColumnVolume& columns, const volume::Grid& grid,
                                                    Vec3d origin, std::span<const BoundedBody> bodies,
                                                    std::span<const mesh::ObjectMesh> faces,
                                                    std::span<const ObjectClaim> claims, int threads);

}  // namespace svt::voxelize
