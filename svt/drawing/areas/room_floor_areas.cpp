#include <svt/drawing/room_floor_areas.hpp>

#include <svt/core/text.hpp>
#include <svt/drawing/levels/level_parts.hpp>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace svt::drawing {
namespace {

constexpr double kLeastHeight = 1.5;  // metres: lower spaces are voids

}  // namespace

std::vector<std::optional<double>> roomFloorAreas(const volume::SemanticVolume& volume) {
    const std::vector<volume::Label>& labels = volume.labels.labels;
    const Vec3d up = volume.grid.axes()[2];
    std::vector<std::optional<double>> areas(labels.size());
    const auto& triangles = volume.vectors.triangles;
    for (std::size_t n = 0; n < triangles.size();) {
        const std::uint32_t label = triangles[n].label;
        const bool isRoom = isRoomSpace(labels[label]) && volume::hasClosedMesh(labels[label].filling);
        double below = 0, lowest = kInfinity, highest = -kInfinity;
        for (; n < triangles.size() && triangles[n].label == label; ++n) {
            if (!isRoom) continue;
            Vec3d corners[3];
            for (std::size_t c = 0; c < 3; ++c) {
                corners[c] = volume.vectors.position(triangles[n].corners[c], {});
                lowest = std::min(lowest, dot(corners[c], up));
                highest = std::max(highest, dot(corners[c], up));
            }
            below += std::max(0.0, -0.5 * dot(cross(corners[1] - corners[0], corners[2] - corners[0]), up));
        }
        if (isRoom && highest - lowest >= kLeastHeight) areas[label] = below;
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
