#include <svt/writers/marks/ground_line.hpp>

#include <svt/model/classes.hpp>

#include <cmath>

namespace svt::writers {
namespace {

using drawing::PlanePoint;

bool isTerrain(const volume::Label& label) {
    return model::classRank(label.className) == model::ClassRank::Other && label.className != "Annotation" &&
           label.className != "Grid" && label.className != "CityObjectGroup";
}

}  // namespace

MarkShapes drawGround(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                      double millimetres) {
    constexpr double kPitch = 6, kStrokes = 3, kApart = 1, kLong = 1.6;  // millimetres; strokes in a group
    MarkShapes shapes;
    shapes.layer = "Ground";
    for (const drawing::SectionLine& line : drawing.lines) {
        if (!isTerrain(volume.labels.labels[line.label])) continue;
        MarkPath path;
        for (const PlanePoint p : line.points) path.push_back({p.u * millimetres, p.v * millimetres});
        double left = 0.5 * kPitch;  // to the next group
        for (std::size_t n = 0; n + 1 < path.size(); ++n) {
            const PlanePoint a = path[n], b = path[n + 1];
            const double size = std::hypot(b.u - a.u, b.v - a.v);
            for (; left < size; left += kPitch)
                for (int stroke = 0; stroke < kStrokes; ++stroke) {
                    const double t = left / size, shift = stroke * kApart;
                    const PlanePoint at{a.u + (b.u - a.u) * t + shift, a.v + (b.v - a.v) * t};
                    shapes.thin.push_back({at, {at.u - kLong, at.v - kLong}});
                }
            left -= size;
        }
        shapes.bold.push_back(std::move(path));
    }
    return shapes;
}

}  // namespace svt::writers
