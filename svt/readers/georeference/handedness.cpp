#include <svt/readers/georeference/handedness.hpp>

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

}  // namespace

int handedness(const BuildingModel& model) {
    double sum = 0;
    double total = 0;
    for (const Feature& feature : model.features) {
        const double up = feature.className == "RoofSurface" ? 1 : feature.className == "GroundSurface" ? -1 : 0;
        for (const model::Geometry& geometry : feature.geometries) {
            for (const model::Solid& solid : geometry.solids) {
                const Vec3d apex = model.polygons[solid.exterior.front().polygon].points.front();
                double volume = 0;
                for (const model::SurfaceUse use : solid.exterior)
                    volume += (use.isReversed ? -1 : 1) * coneVolume(model.polygons[use.polygon], apex);
                sum += volume;
                total += std::abs(volume);
            }
            if (up == 0) continue;
            for (const model::SurfaceUse use : geometry.surfaces) {
                const model::Polygon& polygon = model.polygons[use.polygon];
                // A cone of height 1 from below: its volume has the sign of the z component of the normal.
                const double area =
                    coneVolume(polygon, polygon.points.front() - Vec3d{0, 0, 1}) * (use.isReversed ? -up : up);
                sum += area;
                total += std::abs(area);
            }
        }
    }
    return std::abs(sum) < 0.9 * total || total == 0 ? 0 : sum > 0 ? 1 : -1;
}

}  // namespace svt::readers::georeference
