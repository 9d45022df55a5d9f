#include <svt/drawing/room_floor_areas.hpp>

#include <svt/core/text.hpp>
#include <svt/drawing/footprint/outline_union.hpp>
#include <svt/drawing/levels/level_parts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>

namespace svt::drawing {
namespace {

constexpr double kLeastHeight = 1.5;  // metres: lower spaces are voids
constexpr double kLevel = 1e-3;       // metres: faces within it lie at one height, so none covers another
constexpr double kGridUnit = 1.0 / (1 << 20);

// The faces of a room that look down, seen from above. Faces above each other, such as the floor and the top of a beam, count
// once.
class FloorPlan {
public:
    explicit FloorPlan(const std::array<Vec3d, 3>& axes) : axes_(axes) {}

    void add(const std::array<Vec3d, 3>& corners) {
        const double area = -0.5 * dot(cross(corners[1] - corners[0], corners[2] - corners[0]), axes_[2]);
        if (!(area > 0)) return;
        sum_ += area;
        std::array<plane::Point, 3> flat;
        for (std::size_t c = 0; c < 3; ++c) {
            const double height = dot(corners[c], axes_[2]);
            lowest_ = std::min(lowest_, height);
            highest_ = std::max(highest_, height);
            if (triangles_.empty() && c == 0) first_ = corners[0];
            const Vec3d local = corners[c] - first_;
            flat[c] = {std::llround(dot(local, axes_[0]) / kGridUnit), std::llround(dot(local, axes_[1]) / kGridUnit)};
        }
        triangles_.push_back(flat);
    }

    // m2
    [[nodiscard]] double area() const {
        if (highest_ - lowest_ <= kLevel) return sum_;
        OutlineUnion outline;
        for (const auto& triangle : triangles_) outline.addTriangle(triangle);
        double area = 0;
        for (const PlanPolygon& polygon : outline.polygons(kGridUnit, {0, 0})) area += areaOf(polygon);
        return area > 0 ? std::min(area, sum_) : sum_;
    }

private:
    const std::array<Vec3d, 3>& axes_;
    double sum_ = 0, lowest_ = kInfinity, highest_ = -kInfinity;
    Vec3d first_{};
    std::vector<std::array<plane::Point, 3>> triangles_;
};

}  // namespace

std::vector<std::optional<double>> roomFloorAreas(const volume::SemanticVolume& volume) {
    const std::vector<volume::Label>& labels = volume.labels.labels;
    const std::array<Vec3d, 3> axes = volume.grid.axes();
    const Vec3d up = axes[2];
    std::vector<std::optional<double>> areas(labels.size());
    const auto& triangles = volume.vectors.triangles;
    for (std::size_t n = 0; n < triangles.size();) {
        const std::uint32_t label = triangles[n].label;
        const bool isRoom = isRoomSpace(labels[label]) && volume::hasClosedMesh(labels[label].filling);
        FloorPlan plan(axes);
        double lowest = kInfinity, highest = -kInfinity;
        for (; n < triangles.size() && triangles[n].label == label; ++n) {
            if (!isRoom) continue;
            std::array<Vec3d, 3> corners;
            for (std::size_t c = 0; c < 3; ++c) {
                corners[c] = volume.vectors.position(triangles[n].corners[c], {});
                lowest = std::min(lowest, dot(corners[c], up));
                highest = std::max(highest, dot(corners[c], up));
            }
            plan.add(corners);
        }
        if (isRoom && highest - lowest >= kLeastHeight) areas[label] = plan.area();
    }
    return areas;
}

std::optional<double> statedFloorArea(const volume::Label& label) {
    for (const std::string_view wanted : {"NetFloorArea", "FloorArea", "Area", "GrossFloorArea"})
        for (const Attribute& attribute : label.attributes) {
            const std::string_view name = attribute.name;
            const std::size_t point = name.rfind('.');
            if (!equalsIgnoringCase(name.substr(point == std::string_view::npos ? 0 : point + 1), wanted)) continue;
            if (!attribute.unit.empty() && attribute.unit != "m2") continue;
            const double* real = std::get_if<double>(&attribute.value);
            const auto* whole = std::get_if<std::int64_t>(&attribute.value);
            const double area = real != nullptr ? *real : whole != nullptr ? static_cast<double>(*whole) : 0;
            if (area > 0 && area < kInfinity) return area;
        }
    return std::nullopt;
}

}  // namespace svt::drawing
