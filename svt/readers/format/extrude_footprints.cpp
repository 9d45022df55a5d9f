#include <svt/readers/format/extrude_footprints.hpp>

#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace svt::readers {
namespace {

using model::Feature;
using model::FeatureIndex;
using model::Polygon;
using model::SurfaceUse;

// Points of one footprint agree in height to this, metres.
constexpr double kFlat = 0.01;

std::optional<double> heightOf(const Feature& feature) {
    for (const char* name : {"measuredHeight", "height"})
        for (const Attribute& attribute : feature.attributes) {
            if (attribute.name != name) continue;
            double height = 0;
            if (const auto* real = std::get_if<double>(&attribute.value)) height = *real;
            if (const auto* whole = std::get_if<std::int64_t>(&attribute.value)) height = static_cast<double>(*whole);
            const std::string unit = lowerAscii(attribute.unit);
            if (unit.find("ft") != std::string::npos || unit.find("foot") != std::string::npos) height *= 0.3048;
            if (height > 0 && std::isfinite(height)) return height;
        }
    return std::nullopt;
}

std::optional<double> heightOf(const model::BuildingModel& model, FeatureIndex index) {
    for (; index != model::kNoFeature; index = model.features[index].parent)
        if (const auto height = heightOf(model.features[index])) return height;
    return std::nullopt;
}

std::pair<double, double> heightRange(const Polygon& polygon) {
    std::pair<double, double> range{kInfinity, -kInfinity};
    for (const Vec3d& point : polygon.points) {
        range.first = std::min(range.first, point.z);
        range.second = std::max(range.second, point.z);
    }
    return range;
}

// The polygons of the lowest of a feature's geometries; empty if any geometry is a solid or not flat.
std::vector<model::PolygonIndex> footprintOf(const model::BuildingModel& model, const Feature& feature) {
    std::vector<model::PolygonIndex> lowest;
    double height = kInfinity;
    for (const model::Geometry& geometry : feature.geometries) {
        if (geometry.kind == model::GeometryKind::Solid) return {};
        std::vector<model::PolygonIndex> polygons;
        double low = kInfinity;
        for (const SurfaceUse& use : geometry.surfaces) {
            const auto [bottom, top] = heightRange(model.polygons[use.polygon]);
            if (top - bottom > kFlat) return {};
            low = std::min(low, bottom);
            polygons.push_back(use.polygon);
        }
        if (low >= height) continue;
        height = low;
        lowest = std::move(polygons);
    }
    return lowest;
}

// Twice the area of a ring as seen from above, positive if it runs counter-clockwise.
double turnOf(const Polygon& polygon, std::size_t begin, std::size_t end) {
    double sum = 0;
    const Vec3d base = polygon.points[begin];
    for (std::size_t i = begin; i < end; ++i) {
        const Vec3d a = polygon.points[i] - base, b = polygon.points[i + 1 == end ? begin : i + 1] - base;
        sum += a.x * b.y - a.y * b.x;
    }
    return sum;
}

// The exterior ring counter-clockwise seen from above, holes clockwise.
Polygon facingUp(const Polygon& source) {
    Polygon polygon{source.points, source.ringEnds, {}, source.material};
    std::size_t begin = 0;
    for (const std::uint32_t end : polygon.ringEnds) {
        const bool isExterior = begin == 0;
        if ((turnOf(polygon, begin, end) > 0) != isExterior)
            std::reverse(polygon.points.begin() + static_cast<std::ptrdiff_t>(begin), polygon.points.begin() + end);
        begin = end;
    }
    return polygon;
}

model::Solid prismOver(model::BuildingModel& model, const Polygon& source, double height) {
    model::Solid solid;
    const Polygon bottom = facingUp(source);
    Polygon top = bottom;
    for (Vec3d& point : top.points) point.z += height;
    std::size_t begin = 0;
    for (const std::uint32_t end : bottom.ringEnds) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t next = i + 1 == end ? begin : i + 1;
            const Polygon wall{{bottom.points[i], bottom.points[next], top.points[next], top.points[i]}, {4}, {}, -1};
            solid.exterior.push_back({model.addPolygon(wall), false});
        }
        begin = end;
    }
    solid.exterior.push_back({model.addPolygon(bottom), true});
    solid.exterior.push_back({model.addPolygon(std::move(top)), false});
    return solid;
}

}  // namespace

std::size_t extrudeFootprints(model::BuildingModel& model, Diagnostics* diagnostics) {
    // Walls, roofs or parts below a building describe it better than its footprint. Parents come before their children.
    std::vector<bool> hasGeometryBelow(model.features.size());
    for (std::size_t f = model.features.size(); f-- > 0;) {
        const Feature& feature = model.features[f];
        if (feature.parent != model::kNoFeature && (!feature.geometries.empty() || hasGeometryBelow[f]))
            hasGeometryBelow[feature.parent] = true;
    }
    std::size_t extruded = 0, unknown = 0;
    FeatureIndex firstUnknown = 0;
    for (FeatureIndex f = 0; f < model.features.size(); ++f) {
        if (hasGeometryBelow[f] || model::insideOf(model.features[f].className) == model::Inside::Never) continue;
        const std::vector<model::PolygonIndex> footprint = footprintOf(model, model.features[f]);
        if (footprint.empty()) continue;
        const auto height = heightOf(model, f);
        if (!height) {
            if (unknown++ == 0) firstUnknown = f;
            continue;
        }
        model::Geometry geometry;
        geometry.kind = model::GeometryKind::Solid;
        geometry.lod = 1;
        for (const model::PolygonIndex polygon : footprint)
            // A copy: polygons move while faces are added.
            geometry.solids.push_back(prismOver(model, Polygon(model.polygons[polygon]), *height));
        model.features[f].geometries.push_back(std::move(geometry));
        ++extruded;
    }
    if (diagnostics != nullptr && extruded > 0)
        diagnostics->add(Severity::Note, Code::NoHeights,
                         fmt::format("{} footprints were extruded by their height to solids", extruded),
                         {model.source, 0, 0, {}});
    if (diagnostics != nullptr && unknown > 0)
        diagnostics->add(Severity::Warning, Code::NoHeights,
                         fmt::format("{} footprints have neither measuredHeight nor height and stay flat, this is the "
                                     "first",
                                     unknown),
                         model.placeOf(static_cast<model::FeatureIndex>(firstUnknown)));
    return extruded;
}

}  // namespace svt::readers
