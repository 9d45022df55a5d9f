#pragma once
/// \file
/// Voxels of what has no inside: sheets, and parts of solids that are thinner than a voxel.

#include <svt/voxelize/tiles/tile_plan.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <vector>

namespace svt::voxelize {

/// 6-separating sheet: wherever the surface passes between two samples that are neighbours along x, y or z, the one
/// behind the face gets a voxel. A path of 6-neighbours cannot cross it, and of two sheets on the two sides of one face
/// each gets its own voxels. Clipped to `dimension`.
void addThinSheet(const IndexMesh& mesh, Vec3i dimension, std::uint32_t claim, std::vector<ClaimedBox>& boxes);

/// Every voxel whose box the surface touches: separating axis test of triangle and box (Akenine-Moeller 2001).
void addConservativeSheet(const IndexMesh& mesh, Vec3i dimension, std::uint32_t claim, std::vector<ClaimedBox>& boxes);

/// Parts of a solid thinner than a voxel: where a sample line along the dominant axis of a face meets less than a voxel
/// of material and no sample in it, the nearest sample gets a voxel; rods thinner than a voxel in two directions
/// get the voxels along their edges.
/// \return count of voxels added, before priority
std::uint64_t addThinParts(const IndexMesh& mesh, const IndexFromLocal& indexFromLocal, Vec3i dimension,
                           std::uint32_t claim, std::vector<ClaimedBox>& boxes);

}  // namespace svt::voxelize
