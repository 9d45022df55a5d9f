#pragma once
/// \file
/// The polygons of the model in local space, triangulated once, with canonical coordinates: heights, corners and planes
/// that are meant to be equal are equal, bit for bit, in all objects.

#include <svt/mesh/mesh_set.hpp>

#include <span>
#include <vector>

namespace svt::mesh {

/// Flat arrays of the polygons used by the chosen geometries; all other polygons have no points.
struct LocalPolygons {
    Vec3d origin{};                         ///< world space, whole metres
    std::vector<Vec3d> points;              ///< canonical local coordinates, followed by extra points where rings cross
    std::vector<std::uint32_t> pointIds;    ///< per point: index of the welded point, equal for equal coordinates
    std::vector<std::uint32_t> firstPoint;  ///< polygon p: points [firstPoint[p], firstPoint[p] + pointCount[p])
    std::vector<std::uint32_t> pointCount;  ///< without extra points
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< corners as indices in `points`
    std::vector<std::uint32_t> firstTriangle;  ///< polygon p: triangles [firstTriangle[p], firstTriangle[p + 1])
    std::uint32_t weldedCount = 0;

    [[nodiscard]] std::span<const std::array<std::uint32_t, 3>> trianglesOf(model::PolygonIndex p) const {
        return std::span(triangles).subspan(firstTriangle[p], firstTriangle[p + 1] - firstTriangle[p]);
    }
};

/// Prepares the polygons with `isUsed[p] != 0`. Polygons with a coordinate that is not finite or not below 1e9 m are
/// reported (BadCoordinate) and left out, and so are polygons that cannot be triangulated.
/// \param log  receives findings per polygon: ZeroArea, SelfTouchingRing, NonPlanar (over 1 cm), TriangulationFailed;
///             may be null
/// When `options.progress` cancels, the remaining polygons have no triangles, and the result must not be used.
/// Cost: O(n log n). The result does not depend on `options.threads`.
[[nodiscard]] LocalPolygons prepareLocalPolygons(const model::BuildingModel& model,
                                                 const std::vector<std::uint8_t>& isUsed, const MeshOptions& options,
                                                 Diagnostics* log);

/// Merges values within `distance` of each other, in place: in ascending order, each cluster starts at the first value
/// not yet in a cluster, contains all values within `distance` above it, and takes its value. The result does not
/// depend on the order of the input.
void clusterValues(std::span<double> values, double distance);

}  // namespace svt::mesh
