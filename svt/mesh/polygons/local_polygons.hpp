#pragma once
/// \file
/// The model's polygons in local space, triangulated once, their coordinates made canonical:
/// what is meant to be one height, one corner or one plane is one, bit for bit, in all objects.

#include <svt/mesh/mesh_scene.hpp>

#include <span>
#include <vector>

namespace svt::mesh {

/// Flat arrays over the polygons that some chosen geometry uses; others have no points.
struct LocalPolygons {
    Vec3d origin{};                         ///< world space, whole metres
    std::vector<Vec3d> points;              ///< canonical local coordinates, then extra points of crossings
    std::vector<std::uint32_t> pointIds;    ///< per point: number of the welded point, equal for equal coordinates
    std::vector<std::uint32_t> firstPoint;  ///< polygon p: points [firstPoint[p], firstPoint[p] + pointCount[p])
    std::vector<std::uint32_t> pointCount;  ///< without extra points
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< corners into `points`
    std::vector<std::uint32_t> firstTriangle;  ///< polygon p: triangles [firstTriangle[p], firstTriangle[p + 1])
    std::uint32_t weldedCount = 0;

    [[nodiscard]] std::span<const std::array<std::uint32_t, 3>> trianglesOf(model::PolygonIndex p) const {
        return std::span(triangles).subspan(firstTriangle[p], firstTriangle[p + 1] - firstTriangle[p]);
    }
};

/// Prepares the polygons with `isUsed[p] != 0`. Points with a coordinate that is not finite or over 1e9 m are reported
/// (BadCoordinate) and their polygon left out; so are polygons that cannot be triangulated.
/// \param log  per polygon findings: ZeroArea, SelfTouchingRing, NonPlanar (over 1 cm), TriangulationFailed
/// Cost: O(n log n). The result does not depend on `options.threads`.
[[nodiscard]] LocalPolygons prepareLocalPolygons(const model::BuildingModel& model,
                                                 const std::vector<std::uint8_t>& isUsed, const MeshOptions& options,
                                                 Diagnostics* log);

/// Brings values that lie within `distance` of each other to one value: sorted upwards, each cluster starts at its
/// first value and reaches no further than `distance` from it. In place; stable against order.
void clusterValues(std::span<double> values, double distance);

}  // namespace svt::mesh
