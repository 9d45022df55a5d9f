#include <svt/readers/georeference/handedness.hpp>

#include <fmt/format.h>

#include <cmath>

namespace svt::readers::georeference {
namespace {

using model::BuildingModel;
using model::Feature;

// Six times the signed volume of the cone from `apex` over a polygon; the sum over a closed shell is six times its
// volume. Interior rings run the other way and therefore subtract.
double coneVolume(const model::Polygon& polygon, Vec3d apex) {
    double volume = 0;
    std::size_t begin = 0;
    for (const std::uint32_t end : polygon.ringEnds) {
        for (std::size_t i = begin + 1; i + 1 < end; ++i)
            volume += dot(polygon.points[begin] - apex, cross(polygon.points[i] - apex, polygon.points[i + 1] - apex));
        begin = end;
    }
    return volume;
}

constexpr std::size_t kFewestFaces = 4;

// Counts bodies and surfaces by the side that they face.
struct Sides {
    std::size_t right = 0, wrong = 0;
    void add(double volume) {
        if (volume != 0) ++(volume > 0 ? right : wrong);
    }
};

void countSides(const BuildingModel& model, const Feature& feature, Sides& sides) {
    const double up = feature.className == "RoofSurface" ? 1 : feature.className == "GroundSurface" ? -1 : 0;
    for (const model::Geometry& geometry : feature.geometries) {
        for (const model::Solid& solid : geometry.solids) {
            if (solid.exterior.size() < kFewestFaces) continue;  // not a shell
            const Vec3d apex = model.polygons[solid.exterior.front().polygon].points.front();
            double volume = 0;
            for (const model::SurfaceUse use : solid.exterior)
                volume += (use.isReversed ? -1 : 1) * coneVolume(model.polygons[use.polygon], apex);
            sides.add(volume);
        }
        if (up == 0) continue;
        double area = 0;
        for (const model::SurfaceUse use : geometry.surfaces) {
            const model::Polygon& polygon = model.polygons[use.polygon];
            // A cone of height 1 from below: its volume has the sign of the z component of the normal.
            area += coneVolume(polygon, polygon.points.front() - Vec3d{0, 0, 1}) * (use.isReversed ? -up : up);
        }
        sides.add(area);
    }
}

}  // namespace

void warnOfMirror(const BuildingModel& model, bool isNorthFirst, const Place& place, Diagnostics& diagnostics) {
    constexpr std::size_t kFewest = 3;
    Sides sides;
    for (const Feature& feature : model.features) countSides(model, feature, sides);
    const std::size_t all = sides.right + sides.wrong;
    if (sides.wrong < kFewest || sides.wrong * 10 < all * 9) return;
    diagnostics.add(
        Severity::Warning, Code::AxisOrder,
        fmt::format("{} of {} shells, roofs and grounds face the wrong way with the axes taken as {}. The model is "
                    "mirrored, or its shells are inside out; compare it with a map, and try --axis-order {}",
                    sides.wrong, all, isNorthFirst ? "north, east" : "east, north",
                    isNorthFirst ? "east-north" : "north-east"),
        place);
}

}  // namespace svt::readers::georeference
