#include <svt/analyze/face_areas.hpp>

#include <svt/model/classes.hpp>

#include <algorithm>
#include <string>

namespace svt::analyze {
namespace {

std::optional<FaceKind> faceKindOf(const std::string& className) {
    if (className == "RoofSurface") return FaceKind::Roof;
    if (className == "WallSurface") return FaceKind::Wall;
    if (className == "GroundSurface") return FaceKind::Ground;
    if (className == "Window" || className == "WindowSurface") return FaceKind::Window;
    if (className == "Door" || className == "DoorSurface") return FaceKind::Door;
    return std::nullopt;
}

// The nearest label of the extent above this one that has the same kind and a mesh.
bool isPartOfCounted(const volume::LabelTable& table, std::uint32_t label, FaceKind kind,
                     std::span<const std::uint32_t> extent, std::span<const std::optional<double>> areas) {
    std::uint32_t below = label;
    for (std::uint32_t above = table.labels[label].parent; above < below; above = table.labels[above].parent) {
        if (!std::binary_search(extent.begin(), extent.end(), above)) return false;
        if (areas[above] && faceKindOf(table.labels[above].className) == kind) return true;
        below = above;
    }
    return false;
}

// Whether the label is a part of a room, such as the face of a window towards the room.
bool isInRoom(const volume::LabelTable& table, std::uint32_t label) {
    std::uint32_t below = label;
    for (std::uint32_t above = table.labels[label].parent; above < below; above = table.labels[above].parent) {
        if (model::classRank(table.labels[above].className) == model::ClassRank::Room) return true;
        below = above;
    }
    return false;
}

}  // namespace

std::vector<std::optional<double>> meshAreas(const volume::SemanticVolume& volume) {
    std::vector<std::optional<double>> areas(volume.labels.labels.size());
    const Vec3d origin = volume.grid.origin();
    for (const volume::VectorParts::Triangle& triangle : volume.vectors.triangles) {
        const auto at = [&](std::size_t corner) { return volume.vectors.position(triangle.corners[corner], origin); };
        const Vec3d a = at(0);
        areas[triangle.label] = areas[triangle.label].value_or(0) + length(cross(at(1) - a, at(2) - a)) / 2;
    }
    return areas;
}

std::vector<CountedFaces> countedFaces(const volume::LabelTable& table, std::span<const std::uint32_t> extent,
                                       std::span<const std::optional<double>> areas) {
    std::vector<CountedFaces> counted;
    for (const std::uint32_t label : extent) {
        const std::optional<FaceKind> kind = faceKindOf(table.labels[label].className);
        if (kind && !isPartOfCounted(table, label, *kind, extent, areas))
            counted.push_back({label, *kind, areas[label]});
    }
    return counted;
}

void dropOpeningsOfRooms(const volume::LabelTable& table, std::vector<CountedFaces>& counted) {
    for (const FaceKind kind : {FaceKind::Window, FaceKind::Door}) {
        const auto isOutside = [&](const CountedFaces& faces) {
            return faces.kind == kind && !isInRoom(table, faces.label);
        };
        const auto isOfRoom = [&](const CountedFaces& faces) {
            return faces.kind == kind && isInRoom(table, faces.label);
        };
        if (std::any_of(counted.begin(), counted.end(), isOutside)) std::erase_if(counted, isOfRoom);
    }
}

std::array<std::optional<double>, 5> faceAreas(const volume::LabelTable& table, std::span<const std::uint32_t> extent,
                                               std::span<const std::optional<double>> areas) {
    std::array<std::optional<double>, 5> sums;
    std::array<bool, 5> isUnknown{};
    std::vector<CountedFaces> counted = countedFaces(table, extent, areas);
    dropOpeningsOfRooms(table, counted);
    for (const CountedFaces& faces : counted) {
        const auto place = static_cast<std::size_t>(faces.kind);
        if (faces.area)
            sums[place] = sums[place].value_or(0) + *faces.area;
        else
            isUnknown[place] = true;
    }
    for (std::size_t kind = 0; kind < sums.size(); ++kind)
        if (isUnknown[kind]) sums[kind].reset();
    return sums;
}

}  // namespace svt::analyze
