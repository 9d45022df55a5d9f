#pragma once
/// \file
/// Fills open shells with solid meaning by the generalized winding number.
///
///        open edges           w(p) = signed crossings of the upward ray from p with the shell
///      .--o     o--.                 - winding number of the curtains at p
///      |  :     :  |
///      |  :     :  |  shell   A curtain is the vertical strip that hangs from an open edge down to infinity. Seen
///      |  :  p  :  |          from p it is a spherical triangle: the directions to both ends of the edge, and
///      `--:-----:--'          straight down. Shell and curtains together are closed, so their common winding number
///         :     :             is an integer: the signed crossings of any ray. An upward ray meets no curtain.
///         v     v  curtains

#include <svt/voxelize/tiles/tile_plan.hpp>

#include <vector>

namespace svt::voxelize {

/// Claims the samples whose generalized winding number (Jacobson, Kavan & Sorkine 2013) is at least 1/2.
///
/// Evaluated as signed crossings of the upward ray minus the solid angles of the curtains, divided by 4 pi (after the
/// one-shot method of Martens & Bessmeltsev 2025), so that only the open edges cost. Along a column samples are skipped
/// as far as the gradient bound |grad w| <= L / (pi d^2) allows, which holds within d / 2 of a sample (L: total length
/// of the open edges, d: distance from the sample to the nearest of them). Samples outside the bounding box of the
/// shell are left out.
/// \param mesh     the open object, with its open edges
/// \param boxes    receives the claimed samples, as boxes one column wide
/// \param threads  0: all cores; the result does not depend on it
/// \return count of samples with a winding number between 1/4 and 3/4; skipped samples count like the one before them
/// Cost: O(samples evaluated * open edges + rows * triangles).
std::uint64_t addWindingFill(const IndexMesh& mesh, const mesh::MeshSet& meshes, const volume::Grid& grid,
                             std::uint32_t claim, int threads, std::vector<ClaimedBox>& boxes);

/// Generalized winding number of `mesh` at `point` (local space): the solid angles of all triangles (Van Oosterom &
/// Strackee 1983), divided by 4 pi. Reference implementation for tests. Cost: O(triangles).
[[nodiscard]] double windingNumber(const mesh::ObjectMesh& mesh, Vec3d point) noexcept;

}  // namespace svt::voxelize
