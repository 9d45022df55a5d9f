#pragma once
/// \file
/// Polygons in plan as well-known binary.

#include <svt/drawing/footprints.hpp>
#include <svt/writers/geopackage/geometry_blob.hpp>

#include <span>

namespace svt::writers {

using PlanPolygons = std::span<const drawing::PlanPolygon>;

[[nodiscard]] inline MapBounds boundsOf(PlanPolygons polygons) noexcept {
    MapBounds bounds;
    for (const drawing::PlanPolygon& polygon : polygons) bounds.add(polygon.rings.front());
    return bounds;
}

/// Appends a MultiPolygon, also for one polygon, so that all rows of a table have one type.
inline void addMultiPolygon(GeometryBlob& blob, PlanPolygons polygons) {
    blob.begin(WkbType::MultiPolygon, polygons.size());
    for (const drawing::PlanPolygon& polygon : polygons) {
        blob.begin(WkbType::Polygon, polygon.rings.size());
        for (const auto& ring : polygon.rings) blob.addRing(ring);
    }
}

}  // namespace svt::writers
