#include <svt/drawing/storey_floors.hpp>

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/model/classes.hpp>
#include <svt/model/query.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace svt::drawing {
namespace {

constexpr double kLowestRoom = 1.5;     // metres: lower spaces are voids
constexpr double kSmallestFloor = 1;    // m2
constexpr double kSameFloor = 0.01;     // metres
constexpr double kWithinStorey = 1.2;   // metres
constexpr double kLevelCosine = 0.999;  // of the slope up to which a face is level

bool isRoomSpace(const volume::Label& label) {
    return model::isSpace(label.className) && model::classRank(label.className) == model::ClassRank::Room;
}

bool isLowerFloor(const FloorHeight& a, const FloorHeight& b) {
    return std::tie(a.at, a.area) < std::tie(b.at, b.area);
}

FloorHeight floorHeightOf(const LabelExtent& extent) { return {extent.floor, extent.floorArea, extent.bound}; }

// The triangles of one label.
class MeshExtent {
public:
    MeshExtent(const volume::VectorParts& parts, const volume::Grid& grid, bool isSpace)
        : parts_(parts), axes_(grid.axes()), isSpace_(isSpace) {}

    void add(const volume::VectorParts::Triangle& triangle) {
        Vec3d corner[3];
        for (std::size_t n = 0; n < 3; ++n) {
            const Vec3d p = parts_.position(triangle.corners[n], {});
            corner[n] = {dot(p, axes_[0]), dot(p, axes_[1]), dot(p, axes_[2])};
            extent_.box.add(corner[n]);
        }
        const Vec3d twice = cross(corner[1] - corner[0], corner[2] - corner[0]);
        if (isSpace_ && -twice.z > kLevelCosine * length(twice))
            levels_.push_back({(corner[0].z + corner[1].z + corner[2].z) / 3, -0.5 * twice.z, 0});
    }

    LabelExtent get() {
        const Vec3d size = extent_.box.size();
        extent_.floor = extent_.box.min.z;
        extent_.floorArea = size.x * size.y;
        std::sort(levels_.begin(), levels_.end(), isLowerFloor);
        if (const auto floor = mainFloor(levels_, -kInfinity, kInfinity)) {
            extent_.floor = floor->at;
            extent_.floorArea = floor->area;
        }
        return extent_;
    }

private:
    const volume::VectorParts& parts_;
    const std::array<Vec3d, 3>& axes_;
    bool isSpace_;
    LabelExtent extent_;
    std::vector<FloorHeight> levels_;  // of faces that look down
};

// The extents of a storey's features, and the heights that follow.
class StoreyExtent {
public:
    void add(const volume::Label& label, const LabelExtent& extent) {
        if (extent.box.isEmpty()) return;
        all_.add(extent);
        if (!model::isSpace(label.className)) return;
        spaces_.add(extent);
        spaceFloors_.push_back(floorHeightOf(extent));
        const Vec3d size = extent.box.size();
        if (isRoomSpace(label) && size.z >= kLowestRoom && size.x * size.y >= kSmallestFloor)
            roomFloors_.push_back(floorHeightOf(extent));
    }

    // Adds the storey itself: its declared elevation, and its own geometry for a storey without features.
    void addStorey(const volume::Label& storey, const LabelExtent& extent, const volume::Grid& grid) {
        if (!extent.box.isEmpty()) own_.add(extent);
        for (const Attribute& attribute : storey.attributes)
            if (const auto* height = std::get_if<double>(&attribute.value); height && attribute.name == "elevation")
                elevation_ = *height - dot(grid.origin(), grid.axes()[2]);
    }

    // \param ofModel  floors of all rooms of the model, the lowest first
    std::optional<StoreyHeights> heights(std::uint32_t label, std::span<const FloorHeight> ofModel) {
        const LabelExtent& extent = !spaces_.box.isEmpty() ? spaces_ : !all_.box.isEmpty() ? all_ : own_;
        if (extent.box.isEmpty()) return std::nullopt;
        const FloorHeight floor = floorAt(extent, ofModel);
        return StoreyHeights{label, floor.at, extent.box.min.z, extent.box.max.z, floor.bound};
    }

private:
    struct Sum : LabelExtent {
        void add(const LabelExtent& other) {
            box.add(other.box);
            bound = std::max(bound, other.bound);
        }
    };

    FloorHeight floorAt(const LabelExtent& extent, std::span<const FloorHeight> ofModel) {
        const double low = extent.box.min.z, top = extent.box.max.z;
        for (std::vector<FloorHeight>* floors : {&roomFloors_, &spaceFloors_}) {
            std::sort(floors->begin(), floors->end(), isLowerFloor);
            if (const auto floor = mainFloor(*floors, -kInfinity, kInfinity)) return *floor;
        }
        if (const auto floor = mainFloor(ofModel, low - extent.bound - kSameFloor, low + kWithinStorey)) return *floor;
        if (elevation_ && *elevation_ > low && *elevation_ < top) return {*elevation_, 0, 0};
        return {low, 0, extent.bound};
    }

    Sum own_, all_, spaces_;
    std::vector<FloorHeight> roomFloors_, spaceFloors_;
    std::optional<double> elevation_;  // metres above the grid's lower corner
};

// The labels directly below each label: its children, and the members of a group. A district has a thousand storeys, so
// these are found once for all.
class StoreyMembers {
public:
    explicit StoreyMembers(const volume::LabelTable& table) : begins_(table.labels.size() + 1, 0) {
        const auto forEachAbove = [&](std::uint32_t l, const auto& visit) {
            const volume::Label& label = table.labels[l];
            if (label.parent != volume::kNoLabel) visit(label.parent);
            for (const std::uint32_t group : label.groups) visit(group);
        };
        const auto count = static_cast<std::uint32_t>(table.labels.size());
        for (std::uint32_t l = 0; l < count; ++l) forEachAbove(l, [&](std::uint32_t above) { ++begins_[above + 1]; });
        for (std::size_t l = 1; l < begins_.size(); ++l) begins_[l] += begins_[l - 1];
        labels_.resize(begins_.back());
        std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
        for (std::uint32_t l = 0; l < count; ++l)
            forEachAbove(l, [&](std::uint32_t above) { labels_[next[above]++] = l; });
    }

    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t above) const noexcept {
        return std::span(labels_).subspan(begins_[above], begins_[above + 1] - begins_[above]);
    }

private:
    std::vector<std::size_t> begins_;
    std::vector<std::uint32_t> labels_;
};

Result<std::vector<std::uint32_t>> labelsOnStorey(const std::string& storey, const analyze::LabelRows& rows) {
    std::string quoted;
    for (const char c : storey) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += c;
    }
    return analyze::selectLabels(rows, fmt::format("storey=\"{}\"", quoted));
}

}  // namespace

std::vector<LabelExtent> labelExtents(const volume::SemanticVolume& volume) {
    const auto& labels = volume.labels.labels;
    const auto& triangles = volume.vectors.triangles;
    std::vector<LabelExtent> extents(labels.size());
    for (std::size_t n = 0; n < triangles.size();) {
        const std::uint32_t label = triangles[n].label;
        MeshExtent mesh(volume.vectors, volume.grid, model::isSpace(labels[label].className));
        for (; n < triangles.size() && triangles[n].label == label; ++n) mesh.add(triangles[n]);
        extents[label] = mesh.get();
    }
    const auto samples = analyze::labelBoxes(volume.columns, volume.labels);
    const Vec3d spacing = volume.grid.spacing(), half{0.5, 0.5, 0.5};
    for (std::size_t l = 0; l < extents.size(); ++l) {
        LabelExtent& extent = extents[l];
        if (!extent.box.isEmpty() || samples[l].isEmpty()) continue;
        extent.box.add(scaled(toDouble(samples[l].min) - half, spacing));
        extent.box.add(scaled(toDouble(samples[l].max) + half, spacing));
        extent.floor = extent.box.min.z;
        extent.floorArea = extent.box.size().x * extent.box.size().y;
        extent.bound = spacing.z;
    }
    return extents;
}

std::optional<FloorHeight> mainFloor(std::span<const FloorHeight> floors, double low, double high) {
    std::optional<FloorHeight> best;
    double area = 0;  // of floors [n, end), which are one
    std::size_t end = 0;
    for (std::size_t n = 0; n < floors.size(); ++n) {
        if (n > 0 && end >= n) area -= floors[n - 1].area;
        if (end <= n) {
            end = n;
            area = 0;
        }
        for (; end < floors.size() && floors[end].at < floors[n].at + kSameFloor; ++end) area += floors[end].area;
        if (floors[n].at < low || floors[n].at >= high || (best && area <= best->area)) continue;
        best = FloorHeight{floors[n].at, area, floors[n].bound};
    }
    return best;
}

std::vector<FloorHeight> roomFloors(const volume::SemanticVolume& volume, std::span<const LabelExtent> extents) {
    std::vector<FloorHeight> floors;
    for (std::size_t l = 0; l < extents.size(); ++l) {
        const Vec3d size = extents[l].box.size();
        if (isRoomSpace(volume.labels.labels[l]) && size.z >= kLowestRoom && size.x * size.y >= kSmallestFloor)
            floors.push_back(floorHeightOf(extents[l]));
    }
    std::sort(floors.begin(), floors.end(), isLowerFloor);
    return floors;
}

Result<StoreyHeights> storeyHeights(const std::string& storey, const volume::SemanticVolume& volume) {
    return storeyHeights(storey, volume, volume.labels);
}

Result<StoreyHeights> storeyHeights(const std::string& storey, const volume::SemanticVolume& volume,
                                    const analyze::LabelRows& rows) {
    SVT_TRY(selected, labelsOnStorey(storey, rows));
    const auto& labels = volume.labels.labels;
    const std::vector<LabelExtent> extents = labelExtents(volume);
    StoreyExtent extent;
    std::uint32_t found = volume::kNoLabel;
    const auto isStoreyItself = [&](std::uint32_t l) {
        return (labels[l].id == storey || labels[l].name == storey) && model::query::isStorey(rows.get()[l]);
    };
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        if (!isStoreyItself(l)) continue;
        extent.addStorey(labels[l], extents[l], volume.grid);
        found = std::min(found, l);
    }
    for (const std::uint32_t l : *selected)
        if (!isStoreyItself(l)) extent.add(labels[l], extents[l]);
    const auto heights = extent.heights(found, roomFloors(volume, extents));
    if (!heights) return Error(Code::NothingSelected, fmt::format("the storey '{}' has no voxels", storey));
    return *heights;
}

Result<std::pair<double, double>> storeyVoxels(const std::string& storey, const volume::SemanticVolume& volume,
                                               const analyze::LabelRows& rows) {
    SVT_TRY(selected, labelsOnStorey(storey, rows));
    const auto boxes = analyze::labelBoxes(volume.columns, volume.labels);
    analyze::SampleBox spaces, all;
    for (const std::uint32_t l : *selected) {
        all.add(boxes[l]);
        if (model::isSpace(volume.labels.labels[l].className)) spaces.add(boxes[l]);
    }
    if (all.isEmpty()) return Error(Code::NothingSelected, fmt::format("the storey '{}' has no voxels", storey));
    const analyze::SampleBox& box = spaces.isEmpty() ? all : spaces;
    const double spacing = volume.grid.spacing().z;
    return std::pair((box.min.z - 0.5) * spacing, (box.max.z + 0.5) * spacing);
}

std::vector<StoreyHeights> findStoreys(const volume::SemanticVolume& volume) {
    const std::vector<LabelExtent> extents = labelExtents(volume);
    const std::vector<FloorHeight> floors = roomFloors(volume, extents);
    const analyze::LabelRows labelRows(volume.labels);
    const std::span<const model::QueryRow> rows = labelRows.get();
    const StoreyMembers members(volume.labels);
    std::vector<std::uint32_t> seenBy(rows.size(), volume::kNoLabel);
    std::vector<StoreyHeights> storeys;
    for (std::uint32_t l = 0; l < rows.size(); ++l) {
        if (!model::query::isStorey(rows[l])) continue;
        StoreyExtent extent;
        extent.addStorey(volume.labels.labels[l], extents[l], volume.grid);
        std::vector<std::uint32_t> open{l};
        while (!open.empty()) {
            const std::uint32_t above = open.back();
            open.pop_back();
            for (const std::uint32_t below : members.of(above)) {
                if (seenBy[below] == l) continue;
                seenBy[below] = l;
                if (below == l) continue;
                extent.add(volume.labels.labels[below], extents[below]);
                open.push_back(below);
            }
        }
        if (const auto heights = extent.heights(l, floors)) storeys.push_back(*heights);
    }
    std::stable_sort(storeys.begin(), storeys.end(),
                     [](const StoreyHeights& a, const StoreyHeights& b) { return a.floor < b.floor; });
    return storeys;
}

}  // namespace svt::drawing
