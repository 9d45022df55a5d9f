#pragma once
/// \file
/// Filling open shells that have solid meaning by the generalized winding number.

#include <svt/voxelize/tiles/tile_plan.hpp>

#include <vector>

namespace svt::voxelize {

/// Claims the samples whose generalized winding number (Jacobson, Kavan & Sorkine 2013) is at least 1/2.
///
/// Evaluated as signed crossings of the upward ray minus the solid angles of the curtains that hang from the open edges
/// (after the one-shot method of Martens & Bessmeltsev 2025), so only the open edges cost. Along a column samples
/// are skipped as far as the gradient bound |grad w| <= L / (pi d^2) allows (L: length of the open edges, d: distance
/// to them). \param sampleFromIndex  local-space position of an index-space point, by the grid \return count of samples
/// between 1/4 and 3/4
std::uint64_t addWindingFill(const IndexMesh& mesh, const mesh::MeshScene& scene, const volume::Grid& grid,
                             std::uint32_t claim, int threads, std::vector<ClaimedBox>& boxes);

/// Generalized winding number of `mesh` at `point` (local space) by summing the solid angles of all triangles
/// (Van Oosterom & Strackee 1983). The plain form, for tests. Cost: O(triangles).
[[nodiscard]] double windingNumber(const mesh::ObjectMesh& mesh, Vec3d point) noexcept;

}  // namespace svt::voxelize
