#pragma once
/// \file
/// The union of triangles and polygons in the plane, as polygons with holes.

#include <svt/drawing/footprints.hpp>
#include <svt/plane/point.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::drawing {

/// Collects borders, and makes their union. Coordinates are whole multiples of a unit, relative to any origin.
class OutlineUnion {
public:
    /// Adds a triangle of any orientation. Triangles without area add nothing.
    void addTriangle(const std::array<plane::Point, 3>& corners);
    /// Adds an edge of a region that lies to its left. The edges of a region close.
    void addEdge(plane::Point from, plane::Point to);

    /// \param unit    metres per unit
    /// \param origin  world position of (0, 0)
    /// \param leastArea  m2
    /// \return the polygons, largest first; parts and holes below that area are left out. None if the borders do not
    ///         settle (see plane::arrangeSegments())
    /// Cost: O(n log n).
    [[nodiscard]] std::vector<PlanPolygon> polygons(double unit, std::array<double, 2> origin,
                                                    double leastArea = kLeastArea) const;

    /// m2, smaller than anything on a plan: slivers between faces that do not quite meet.
    static constexpr double kLeastArea = 1e-4;

private:
    struct Border {
        plane::Point from, to;  ///< from < to
        std::int32_t winding = 1;
    };
    [[nodiscard]] std::vector<Border> cancelled() const;

    std::vector<Border> borders_;
};

}  // namespace svt::drawing
