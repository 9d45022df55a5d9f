#include <svt/drawing/storey_floors.hpp>

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/drawing/levels/level_parts.hpp>
#include <svt/model/classes.hpp>
#include <svt/model/query.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace svt::drawing {
namespace {

constexpr double kLeastSpaceHeight = 1.0;  // metres

constexpr double kSameFloor = 0.01;     // metres
constexpr double kLevelCosine = 0.999;  // of the slope up to which a face is level
constexpr double kThickestSlab = 1;     // metres: thicker ones slope, or are foundations
constexpr double kHangsAbove = 3;       // metres: the features of a storey may begin that far above its level
constexpr std::size_t kMostAbove = 64;  // hostile models: groups in groups

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

std::optional<FloorHeight> mainOf(std::vector<FloorHeight>& floors, double low = -kInfinity, double high = kInfinity) {
    std::sort(floors.begin(), floors.end(), isLowerFloor);
    return mainFloor(floors, low, high);
}

// The extents of a storey's features, and the heights that follow.
class StoreyExtent {
public:
    void add(const volume::Label& label, const LabelExtent& extent) {
        if (extent.box.isEmpty()) return;
        all_.add(extent);
        ++features_;
        const Vec3d size = extent.box.size();
        const double area = size.x * size.y;
        if (!model::isSpace(label.className)) {
            if (isFloorSlab(label) && size.z <= kThickestSlab) slabs_.push_back({extent.box.max.z, area, extent.bound});
            if (isWallPart(label)) walls_.push_back({extent.box.min.z, std::hypot(size.x, size.y), extent.bound});
            return;
        }
        spaces_.add(extent);
        // A beam that a program writes as a space has no floor.
        if (size.z >= kLeastSpaceHeight) spaceFloors_.push_back(floorHeightOf(extent));
        if (isRoomOfSize(label, extent)) roomFloors_.push_back(floorHeightOf(extent));
    }

    // Adds the storey itself: its declared level, and its own geometry for a storey without features.
    void addStorey(const volume::Label& storey, const LabelExtent& extent, const volume::Grid& grid) {
        if (!extent.box.isEmpty()) own_.add(extent);
        const double corner = dot(grid.origin(), grid.axes()[2]);
        if (const auto height = numberOf(storey, "modelElevation"); height && std::isfinite(*height))
            declared_ = *height - corner;
        else if (const auto stated = numberOf(storey, "elevation"); stated && lowerTexts(storey, {"ifcType"}).empty())
            stated_ = *stated - corner;
    }

    // \param ofModel  floors of all rooms of the model, the lowest first
    std::optional<StoreyHeights> heights(std::uint32_t label, std::span<const FloorHeight> ofModel) {
        const LabelExtent& extent = !spaces_.box.isEmpty() ? spaces_ : !all_.box.isEmpty() ? all_ : own_;
        if (extent.box.isEmpty()) return std::nullopt;
        StoreyHeights heights;
        heights.label = label;
        heights.low = extent.box.min.z;
        heights.top = extent.box.max.z;
        heights.declared = declared_;
        heights.features = features_;
        for (const FloorHeight& floor : roomFloors_) heights.roomArea += floor.area;
        if (!spaceFloors_.empty())
            useRooms(heights);
        else
            useParts(heights, ofModel, extent);
        return heights;
    }

private:
    struct Sum : LabelExtent {
        void add(const LabelExtent& other) {
            box.add(other.box);
            bound = std::max(bound, other.bound);
        }
    };

    static void use(StoreyHeights& heights, const FloorHeight& floor, FloorSource source) {
        heights.floor = floor.at;
        heights.bound = floor.bound;
        heights.source = source;
    }

    void useRooms(StoreyHeights& heights) {
        const FloorHeight rooms = *mainOf(roomFloors_.empty() ? spaceFloors_ : roomFloors_);
        heights.measured = rooms.at;
        if (declared_ && std::abs(*declared_ - rooms.at) <= kFloorBuildUp + rooms.bound)
            use(heights, {*declared_, 0, 0}, FloorSource::Declared);
        else
            use(heights, rooms, FloorSource::Rooms);
    }

    void useParts(StoreyHeights& heights, std::span<const FloorHeight> ofModel, const LabelExtent& extent) {
        const double low = extent.box.min.z, top = extent.box.max.z;
        if (declared_ && *declared_ >= low - kHangsAbove && *declared_ <= top + kSameStorey) {
            const auto slab = mainOf(slabs_, *declared_ - kSameStorey, *declared_ + kSameStorey);
            if (slab) heights.measured = slab->at;
            if (slab && std::abs(*declared_ - slab->at) > kFloorBuildUp + slab->bound)
                return use(heights, *slab, FloorSource::Slabs);
            return use(heights, {*declared_, 0, 0}, FloorSource::Declared);
        }
        if (const auto rooms = mainFloor(ofModel, low - extent.bound - kSameFloor, low + kSameStorey))
            return use(heights, *rooms, FloorSource::Rooms);
        if (stated_ && *stated_ > low && *stated_ < top) return use(heights, {*stated_, 0, 0}, FloorSource::Declared);
        for (const auto& [parts, source] :
             {std::pair(&slabs_, FloorSource::Slabs), std::pair(&walls_, FloorSource::Walls)}) {
            std::sort(parts->begin(), parts->end(), isLowerFloor);
            if (parts->empty()) continue;
            const double lowest = parts->front().at;
            return use(heights, *mainFloor(*parts, lowest, lowest + kSameStorey), source);
        }
        use(heights, {low, 0, extent.bound}, FloorSource::Lowest);
    }

    Sum own_, all_, spaces_;
    std::vector<FloorHeight> roomFloors_, spaceFloors_, slabs_, walls_;
    std::size_t features_ = 0;
    std::optional<double> declared_;  // metres above the grid's lower corner
    std::optional<double> stated_;    // the same, of a format that does not define its zero
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
    for (std::size_t l = 0; l < extents.size(); ++l)
        if (isRoomOfSize(volume.labels.labels[l], extents[l])) floors.push_back(floorHeightOf(extents[l]));
    std::sort(floors.begin(), floors.end(), isLowerFloor);
    return floors;
}

std::vector<std::uint32_t> storeysOfLabels(const volume::LabelTable& table) {
    const auto& labels = table.labels;
    const analyze::LabelRows labelRows(table);
    const std::span<const model::QueryRow> rows = labelRows.get();
    std::vector<std::uint32_t> storeys(labels.size(), volume::kNoLabel), open;
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        open.assign(1, l);
        const auto add = [&](std::uint32_t above) {
            if (above < labels.size() && std::find(open.begin(), open.end(), above) == open.end())
                open.push_back(above);
        };
        for (std::size_t n = 0; n < open.size() && n < kMostAbove && storeys[l] == volume::kNoLabel; ++n) {
            if (model::query::isStorey(rows[open[n]])) storeys[l] = open[n];
            // Groups first: the parent of a room can be its building, and a group its storey.
            for (const std::uint32_t group : labels[open[n]].groups) add(group);
            add(labels[open[n]].parent);
        }
    }
    return storeys;
}

Result<StoreyHeights> storeyHeights(const std::string& storey, const volume::SemanticVolume& volume) {
    return storeyHeights(storey, volume, volume.labels);
}

Result<StoreyHeights> storeyHeights(const std::string& storey, const volume::SemanticVolume& volume,
                                    const analyze::LabelRows& rows) {
    SVT_TRY(selected, labelsOnStorey(storey, rows));
    const auto& labels = volume.labels.labels;
    const std::vector<LabelExtent> extents = labelExtents(volume);
    const std::vector<std::uint32_t> storeys = storeysOfLabels(volume.labels);
    StoreyExtent extent, below;
    std::uint32_t found = volume::kNoLabel;
    std::vector<bool> isNamed(labels.size(), false);
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        const bool isIt = labels[l].id == storey || labels[l].name == storey;
        if (!isIt || storeys[l] != l) continue;
        isNamed[l] = true;
        extent.addStorey(labels[l], extents[l], volume.grid);
        below.addStorey(labels[l], extents[l], volume.grid);
        found = std::min(found, l);
    }
    bool hasOwn = false;
    for (const std::uint32_t l : *selected) {
        if (isNamed[l]) continue;
        below.add(labels[l], extents[l]);
        if (storeys[l] == volume::kNoLabel || !isNamed[storeys[l]]) continue;
        hasOwn = hasOwn || !extents[l].box.isEmpty();
        extent.add(labels[l], extents[l]);
    }
    // A storey of partial storeys has features only through these.
    const auto heights = (hasOwn ? extent : below).heights(found, roomFloors(volume, extents));
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
    SVT_TRY(heights, storeyHeights(storey, volume, rows));
    const double spacing = volume.grid.spacing().z, low = (box.min.z - 0.5) * spacing,
                 top = (box.max.z + 0.5) * spacing;
    const double floor = heights->floor - kFloorBuildUp;
    return std::pair(floor < top ? std::max(low, floor) : low, top);
}

std::vector<StoreyHeights> findStoreys(const volume::SemanticVolume& volume) {
    const auto& labels = volume.labels.labels;
    const std::vector<LabelExtent> extents = labelExtents(volume);
    const std::vector<FloorHeight> floors = roomFloors(volume, extents);
    const std::vector<std::uint32_t> storeyOf = storeysOfLabels(volume.labels);
    std::map<std::uint32_t, StoreyExtent> extentOf;  // by label of the storey
    for (std::uint32_t l = 0; l < labels.size(); ++l)
        if (storeyOf[l] == l)
            extentOf[l].addStorey(labels[l], extents[l], volume.grid);
        else if (storeyOf[l] != volume::kNoLabel)
            extentOf[storeyOf[l]].add(labels[l], extents[l]);
    std::vector<StoreyHeights> storeys;
    for (auto& [label, extent] : extentOf)
        if (const auto heights = extent.heights(label, floors)) storeys.push_back(*heights);
    std::stable_sort(storeys.begin(), storeys.end(),
                     [](const StoreyHeights& a, const StoreyHeights& b) { return a.floor < b.floor; });
    return storeys;
}

}  // namespace svt::drawing
