#pragma once
/// \file
/// The rim of an open shell, chained into loops, and a lid over each loop: a fan of triangles about an apex.
///
///        r3 ------- r2        A lid is oriented so that shell and lids together are a closed mesh.
///        |  \     /  |        Loops of three or four edges have their first point as apex.
///        |    apex   |
///        |  /     \  |
///        r0 ------- r1

#include <svt/mesh/mesh_set.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::voxelize {

/// One loop of the rim, in the direction of its lid.
struct RimLoop {
    std::uint32_t firstPoint = 0, pointCount = 0;  ///< range of CoveredShell::ring
    std::uint32_t apex = 0;                        ///< vertex
    bool hasOwnApex = false;                       ///< else the apex is the first point of the ring
    /// Triangles of the lid: (apex, ring[n], ring[n + 1]), the last one closes the ring.
    [[nodiscard]] std::uint32_t firstFan() const noexcept { return hasOwnApex ? 0 : 1; }
    [[nodiscard]] std::uint32_t fanEnd() const noexcept { return hasOwnApex ? pointCount : pointCount - 1; }
};

/// An open shell with its lids.
struct CoveredShell {
    mesh::ObjectMesh mesh;            ///< vertices and triangles of the shell, then those of the lids; closed
    std::size_t shellTriangles = 0;   ///< count of triangles before the lids
    std::vector<std::uint32_t> ring;  ///< vertices of all loops
    std::vector<RimLoop> loops;

    [[nodiscard]] std::span<const std::uint32_t> ringOf(const RimLoop& loop) const noexcept {
        return std::span(ring).subspan(loop.firstPoint, loop.pointCount);
    }
};

/// Closes `shell` by lids. The rim is found from the triangles: every edge that they use more often in one direction
/// than in the other, as often as the difference. It is a sum of closed paths for any mesh, also where it branches; a
/// path is cut into loops where it meets itself.
/// Cost: O(n log n) in the triangles. Memory: a copy of the mesh.
[[nodiscard]] CoveredShell coverShell(const mesh::ObjectMesh& shell);

}  // namespace svt::voxelize
