#pragma once
/// \file
/// A small semantic volume with all features that a file must store.

#include <svt/volume/semantic_volume.hpp>

#include <limits>
#include <vector>

namespace svt::volume::test {

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
