#pragma once
/// \file
/// Semantic volumes for tests: those that a test paints (a grid, labels one by one, then the scalar of each sample), and a
/// small one with all features that a file must store.

#include <svt/volume/semantic_volume.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace svt::volume::test {

inline constexpr std::array<Vec3d, 3> kWorldAxes{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};

/// Columns of n samples; sample (i, j, k) has scalarAt(i, j, k).
template <class ScalarAt>
ColumnVolume paintedColumns(Vec3i n, const ScalarAt& scalarAt) {
    std::vector<Scalar> dense;
    dense.reserve(std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z));
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) dense.push_back(static_cast<Scalar>(scalarAt(i, j, k)));
    return ColumnVolume::fromDense(n, dense);
}

/// A volume of background without labels; `origin` is the place of sample (0, 0, 0), `spacing` in metres.
inline SemanticVolume emptyVolume(Vec3i n, Vec3d spacing, Vec3d origin = {},
                                  const std::array<Vec3d, 3>& axes = kWorldAxes) {
    SemanticVolume volume;
    volume.grid = *Grid::fromParts(n, spacing, origin, axes);
    volume.columns = paintedColumns(n, [](auto, auto, auto) { return 0u; });
    return volume;
}

/// Appends `label` as the last descendant of its parent and of the parent's ancestors. Labels are added in tree order.
inline Label& addLabel(SemanticVolume& volume, Label label) {
    auto& labels = volume.labels.labels;
    labels.push_back(std::move(label));
    const auto end = static_cast<std::uint32_t>(labels.size());
    for (std::uint32_t l = end - 1; l != kNoLabel; l = labels[l].parent) labels[l].subtreeEnd = end;
    return labels.back();
}

/// Appends a label without voxels, such as a storey.
inline Label& addGroup(SemanticVolume& volume, std::string id, std::string className, std::uint32_t parent = kNoLabel) {
    Label label;
    label.id = std::move(id);
    label.className = std::move(className);
    label.parent = parent;
    return addLabel(volume, std::move(label));
}

/// Appends a label with one scalar, the next.
inline Label& addObject(SemanticVolume& volume, std::string id, std::string className,
                        std::uint32_t parent = kNoLabel) {
    const Scalar first = volume.labels.scalarCount();
    Label& label = addGroup(volume, std::move(id), std::move(className), parent);
    label.first = first;
    label.count = 1;
    return label;
}

/// Gives sample (i, j, k) the scalar scalarAt(i, j, k), and each label its number of voxels.
template <class ScalarAt>
void paint(SemanticVolume& volume, const ScalarAt& scalarAt) {
    volume.columns = paintedColumns(volume.grid.dimension(), scalarAt);
    const auto voxels = volume.columns.countVoxels(volume.labels.scalarCount());
    for (Label& label : volume.labels.labels) {
        label.voxels = 0;
        for (Scalar s = 0; s < label.count; ++s) label.voxels += voxels[label.first + s];
    }
}

/// Samples [begin, end) along each axis.
struct PaintedBox {
    Scalar scalar = 0;
    Vec3i begin, end;
};

/// Gives each sample the scalar of the last box that contains it, else background.
inline void paintBoxes(SemanticVolume& volume, const std::vector<PaintedBox>& boxes) {
    paint(volume, [&](std::int32_t i, std::int32_t j, std::int32_t k) {
        const auto box = std::find_if(boxes.rbegin(), boxes.rend(), [&](const PaintedBox& b) {
            return i >= b.begin.x && i < b.end.x && j >= b.begin.y && j < b.end.y && k >= b.begin.z && k < b.end.z;
        });
        return box == boxes.rend() ? 0u : box->scalar;
    });
}

/// Appends a point of the volume's meshes unless it is there; `point` in metres from the grid's origin. Returns its index.
inline std::uint32_t addPoint(SemanticVolume& volume, Vec3d point) {
    Vec3i steps;
    for (int axis = 0; axis < 3; ++axis)
        steps[axis] = static_cast<std::int32_t>(std::lround(point[axis] / volume.vectors.unit));
    auto& points = volume.vectors.points;
    const auto found = std::find(points.begin(), points.end(), steps);
    const auto index = static_cast<std::uint32_t>(found - points.begin());
    if (found == points.end()) points.push_back(steps);
    return index;
}

/// Appends two triangles of a label.
inline void addQuad(SemanticVolume& volume, std::uint32_t label, const std::array<Vec3d, 4>& corners) {
    std::array<std::uint32_t, 4> at{};
    for (std::size_t n = 0; n < 4; ++n) at[n] = addPoint(volume, corners[n]);
    volume.vectors.triangles.push_back({label, {at[0], at[1], at[2]}});
    volume.vectors.triangles.push_back({label, {at[0], at[2], at[3]}});
}

/// Appends the six sides of a box, outward.
inline void addBoxMesh(SemanticVolume& volume, std::uint32_t label, Vec3d low, Vec3d high) {
    const auto corner = [&](int n) {
        return Vec3d{(n & 1) != 0 ? high.x : low.x, (n & 2) != 0 ? high.y : low.y, (n & 4) != 0 ? high.z : low.z};
    };
    for (const auto& side : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                             std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}})
        addQuad(volume, label, {corner(side[0]), corner(side[1]), corner(side[2]), corner(side[3])});
}

/// One attribute of each type, and of each value that is hard to write.
inline std::vector<Attribute> sampleAttributes() {
    return {{"text",
             std::string("Gr\xC3\xBC\xC3\x9F"
                         "e \xF0\x9F\x8F\xA0 \"'\\/\n\r\t\x7F"),
             ""},
            {"", std::string(), ""},
            {"smallest", std::numeric_limits<std::int64_t>::min(), ""},
            {"largest", std::numeric_limits<std::int64_t>::max(), ""},
            {"huge", 1e308, "m"},
            {"tiny", std::numeric_limits<double>::denorm_min(), "m\xC2\xB2"},
            {"five", 5.0, ""},
            {"minus zero", -0.0, ""},
            {"third", 1.0 / 3.0, ""},
            {"infinite", std::numeric_limits<double>::infinity(), ""},
            {"yes", true, ""},
            {"no", false, ""}};
}

/// A building with two rooms, a wall with three scalars and a storey as group.
inline std::vector<Label> sampleLabels() {
    std::vector<Label> labels(5);
    labels[0] = {
        .id = "building", .className = "Building", .name = "", .attributes = {}, .subtreeEnd = 4, .groups = {}};
    labels[0].attributes = sampleAttributes();
    labels[1] = {.id = "room-1",
                 .className = "BuildingRoom",
                 .name = "Küche",
                 .attributes = {},
                 .parent = 0,
                 .subtreeEnd = 3,
                 .groups = {4}};
    labels[1].first = 1;
    labels[1].count = 1;
    labels[1].filling = Filling::Solid;
    labels[1].volume = 12.345678901234567;
    labels[2] = {.id = "wall",
                 .className = "WallSurface",
                 .name = "Wand",
                 .attributes = {},
                 .parent = 1,
                 .subtreeEnd = 3,
                 .groups = {}};
    labels[2].first = 2;
    labels[2].count = 3;
    labels[2].filling = Filling::Winding;
    labels[2].thinVoxels = 17;
    labels[2].uncertainVoxels = 4;
    labels[2].color = {0.1f, 1.0f / 3.0f, 1.0f};
    labels[2].opacity = 0.25f;
    labels[3] = {.id = "room-2",
                 .className = "BuildingRoom",
                 .name = "Bad",
                 .attributes = {},
                 .parent = 0,
                 .subtreeEnd = 4,
                 .groups = {4}};
    labels[3].first = 5;
    labels[3].count = 1;
    labels[4] = {.id = "storey", .className = "Storey", .name = "EG", .attributes = {}, .subtreeEnd = 5, .groups = {}};
    return labels;
}

/// The rooms on both sides of the wall; its phases change from sample to sample.
inline std::vector<Scalar> sampleScalars(Vec3i dimension) {
    std::vector<Scalar> dense(std::size_t(dimension.x) * std::size_t(dimension.y) * std::size_t(dimension.z));
    for (std::int32_t k = 0; k < dimension.z; ++k)
        for (std::int32_t j = 0; j < dimension.y; ++j)
            for (std::int32_t i = 0; i < dimension.x; ++i) {
                Scalar scalar = 0;
                if (j > 1 && i < dimension.x / 2) scalar = 1;
                if (j > 1 && i > dimension.x / 2) scalar = 5;
                if (i == dimension.x / 2) scalar = 2 + static_cast<Scalar>((j + k) % 3);
                if (k == 0 || k > dimension.z - 2) scalar = 0;
                dense[std::size_t(i) +
                      std::size_t(dimension.x) * (std::size_t(j) + std::size_t(dimension.y) * std::size_t(k))] = scalar;
            }
    return dense;
}

/// A building with two rooms, a wall with a pattern of three phases and a storey as group; `dimension` of at least
/// 8 x 8 x 8 samples. Its strings have characters that are hard to write.
inline SemanticVolume sampleVolume(Vec3i dimension = {70, 66, 9}) {
    SemanticVolume volume;
    const double turn = 0.6;
    volume.grid = *Grid::fromParts(dimension, {0.05, 0.1, 1.0 / 3.0}, {458877.03, 5438353.7, -0.1},
                                   {Vec3d{turn, 0.8, 0}, Vec3d{-0.8, turn, 0}, Vec3d{0, 0, 1}});
    volume.crsName = "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783";
    volume.modelName = "Haus \"Ängström\" \\ 1\n2. Zeile\t\x01";
    volume.source = "haus.gml";

    volume.labels.labels = sampleLabels();
    volume.labels.overlaps = {{1, 3, 12, false}, {2, 1, 7, true}};
    volume.labels.phaseColors.resize(6, {0.5f, 0.25f, 0.125f});
    volume.columns = ColumnVolume::fromDense(dimension, sampleScalars(dimension));
    const auto voxels = volume.columns.countVoxels(6);
    for (Label& label : volume.labels.labels)
        for (Scalar s = 0; s < label.count; ++s) label.voxels += voxels[label.first + s];
    return volume;
}

inline bool isSame(const SemanticVolume& a, const SemanticVolume& b) {
    return a.grid == b.grid && a.labels == b.labels && a.columns == b.columns && a.crsName == b.crsName &&
           a.modelName == b.modelName && a.source == b.source && a.vectors == b.vectors && a.planes == b.planes;
}

}  // namespace svt::volume::test
