#pragma once
/// \file
/// The tests of one polygon: its rings, their positions relative to each other, and its flatness. The result includes
/// the triangles, because the last test and all tests of shells need them.

#include <svt/model/building_model.hpp>
#include <svt/plane/triangulate_rings.hpp>
#include <svt/validate/exact/lattice.hpp>
#include <svt/validate/polygons/defect.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace svt::validate {

using plane::Corners;

struct PolygonTolerances {
    double snap = 0.001;  ///< metres
    double planarity = 0.01;
    double normalsDegrees = 20;
};

struct CheckedPolygon {
    std::vector<Defect> defects;  ///< empty: valid
    /// Corners are indices in Polygon::points; turning as the exterior ring does. Empty if not valid.
    std::vector<Corners> triangles;
};

/// Tests a polygon. The tests end with the first that fails, because all later tests depend on it.
/// Cost: O(n log n) in its points for rings that cross nowhere, O(n^2) for the triangles of very irregular ones.
[[nodiscard]] CheckedPolygon checkPolygon(const model::Polygon& polygon, const Lattice& lattice,
                                          const PolygonTolerances& tolerances);

}  // namespace svt::validate
