#pragma once
/// \file
/// Voxelizes surfaces: sheets, which have no inside, and parts of solids that are thinner than a voxel.

#include <svt/voxelize/surfaces/thin_plates.hpp>
#include <svt/voxelize/tiles/tile_plan.hpp>

#include <vector>

namespace svt::voxelize {

/// Thin, 6-separating sheet (Cohen-Or & Kaufman 1995): wherever the surface passes between two samples that are
/// neighbours along x, y or z, the sample behind the face gets a voxel. No path of 6-neighbours crosses the sheet. Two
/// sheets at the same place that face opposite ways get different voxels. Clipped to `dimension`.
/// \param boundsBody  see ObjectClaim: only neighbours along the longest component of a triangle's normal count. Within
///                    a face these give all of its voxels; at its edges a path of 6-neighbours may pass
void addThinSheet(const IndexMesh& mesh, Vec3i dimension, std::uint32_t claim, bool boundsBody,
                  std::vector<ClaimedBox>& boxes);

/// Conservative sheet: every voxel whose box touches the surface, by the separating axis test of triangle and box
/// (Akenine-Moeller 2001).
void addConservativeSheet(const IndexMesh& mesh, Vec3i dimension, std::uint32_t claim, std::vector<ClaimedBox>& boxes);

/// Parts of a solid thinner than a voxel: plates, see thin_plates.hpp, and rods. A rod is thinner than a voxel in two
/// directions, so that sample lines may miss it; it gets the voxels along its long edges.
/// \return count of voxels added, before priority is applied
std::uint64_t addThinParts(const IndexMesh& mesh, const IndexFromLocal& indexFromLocal, Vec3i dimension,
                           const ThinClaims& claims, std::vector<ClaimedBox>& boxes);

}  // namespace svt::voxelize
