#pragma once
/// \file
/// Voxelizes surfaces: sheets, which have no inside, and parts of solids that are thinner than a voxel.

#include <svt/voxelize/tiles/tile_plan.hpp>

#include <vector>

namespace svt::voxelize {

/// Thin, 6-separating sheet (Cohen-Or & Kaufman 1995): wherever the surface passes between two samples that are
/// neighbours along x, y or z, the sample behind the face gets a voxel. No path of 6-neighbours crosses the sheet. Two
/// sheets at the same place that face opposite ways get different voxels. Clipped to `dimension`.
/// \param boundsBody  see ObjectClaim: neighbours along the longest component of a triangle's normal alone count. Within a
///                    face these are all of its voxels; at its edges a path of 6-neighbours may pass
void addThinSheet(const IndexMesh& mesh, Vec3i dimension, std::uint32_t claim, bool boundsBody,
                  std::vector<ClaimedBox>& boxes);

/// Conservative sheet: every voxel whose box touches the surface, by the separating axis test of triangle and box
/// (Akenine-Moeller 2001).
void addConservativeSheet(const IndexMesh& mesh, Vec3i dimension, std::uint32_t claim, std::vector<ClaimedBox>& boxes);

/// Parts of a solid thinner than a voxel: where a sample line along the dominant axis of a face passes through less
/// than a voxel of material without a sample in it, the nearest sample gets a voxel. Rods thinner than a voxel in two
/// directions get the voxels along their long edges.
/// \return count of voxels added, before priority is applied
std::uint64_t addThinParts(const IndexMesh& mesh, const IndexFromLocal& indexFromLocal, Vec3i dimension,
                           std::uint32_t claim, std::vector<ClaimedBox>& boxes);

}  // namespace svt::voxelize
