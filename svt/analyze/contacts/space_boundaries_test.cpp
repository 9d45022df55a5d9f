#include <svt/analyze/space_boundaries.hpp>

#include <gtest/gtest.h>

namespace svt::analyze {
namespace {

using volume::ColumnVolume;
using volume::kNoLabel;
using volume::Scalar;

constexpr Vec3i kSize{40, 30, 20};

class Scene {
public:
    Scene() : dense(std::size_t(kSize.x) * kSize.y * kSize.z, 0) {}

    // A label under `parent` with the next scalar.
    std::uint32_t add(const char* className, std::uint32_t parent = kNoLabel) {
        const auto number = static_cast<std::uint32_t>(table.labels.size());
        volume::Label label;
        label.className = className;
        label.parent = parent;
        label.subtreeEnd = number + 1;
        label.first = number + 1;
        label.count = 1;
        table.labels.push_back(label);
        return number;
    }
    void fill(std::uint32_t label, Vec3i begin, Vec3i end) {
        for (int k = begin.z; k < end.z; ++k)
            for (int j = begin.y; j < end.y; ++j)
                for (int i = begin.x; i < end.x; ++i)
                    dense[std::size_t(i) +
                          std::size_t(kSize.x) * (std::size_t(j) + std::size_t(kSize.y) * std::size_t(k))] = label + 1;
    }
    [[nodiscard]] std::vector<SpaceBoundary> find(Vec3d spacing = {0.1, 0.2, 0.25}) const {
        const auto grid = volume::Grid::fromParts(kSize, spacing, {}, {Vec3d{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
        return findSpaceBoundaries(ColumnVolume::fromDense(kSize, dense), *grid, table);
    }

    volume::LabelTable table;
    std::vector<Scalar> dense;
};

TEST(SpaceBoundaries, AWallOfTwoLayersBetweenTwoRoomsAndNothingBelow) {
    Scene s;
    const auto left = s.add("BuildingRoom"), right = s.add("BuildingRoom"),
               brick = s.add("BuildingConstructiveElement"), plaster = s.add("BuildingConstructiveElement");
    s.fill(left, {0, 0, 0}, {10, 30, 20});
    s.fill(brick, {10, 0, 0}, {14, 30, 20});
    s.fill(plaster, {14, 0, 0}, {15, 30, 20});
    s.fill(right, {15, 0, 0}, {40, 30, 20});
    const auto found = s.find();
    const auto wall =
        std::find_if(found.begin(), found.end(), [&](const auto& b) { return b.a == left && b.b == right; });
    ASSERT_NE(wall, found.end());
    EXPECT_EQ(wall->axis, 0);
    EXPECT_NEAR(wall->area, 30 * 0.2 * 20 * 0.25, 1e-9);
    ASSERT_EQ(wall->layers.size(), 2u);
    EXPECT_EQ(wall->layers[0].label, brick);
    EXPECT_NEAR(wall->layers[0].thickness, 0.4, 1e-9);
    EXPECT_EQ(wall->layers[1].label, plaster);
    EXPECT_NEAR(wall->layers[1].thickness, 0.1, 1e-9);
    // The rest are rooms that touch the border of the grid.
    double outside = 0;
    for (const SpaceBoundary& b : found)
        if (&b != &*wall) {
            EXPECT_EQ(b.b, kNoLabel);
            EXPECT_TRUE(b.layers.empty());
            outside += b.area;
        }
    EXPECT_NEAR(outside, 2 * 30 * 0.2 * 20 * 0.25 + 2 * (35 * 0.1) * (20 * 0.25 + 30 * 0.2), 1e-9);
}

TEST(SpaceBoundaries, LayersRunFromTheFirstLabelToTheSecondWhicheverWayTheyAreCrossed) {
    for (const bool isTurned : {false, true}) {
        Scene s;
        const auto room = s.add("BuildingRoom"), inner = s.add("BuildingConstructiveElement"),
                   outer = s.add("BuildingConstructiveElement");
        s.fill(outer, {4, 4, 4}, {30, 26, 16});
        s.fill(inner, {5, 5, 5}, {29, 25, 15});
        s.fill(room, {8, 8, 8}, {26, 22, 12});
        if (isTurned) std::reverse(s.dense.begin(), s.dense.end());
        const auto found = s.find({0.1, 0.1, 0.1});
        ASSERT_EQ(found.size(), 3u) << "one for each axis";
        const double areas[3] = {2 * 14 * 4 * 0.01, 2 * 18 * 4 * 0.01, 2 * 18 * 14 * 0.01};
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(found[std::size_t(axis)].axis, axis);
            EXPECT_EQ(found[std::size_t(axis)].b, kNoLabel);
            EXPECT_NEAR(found[std::size_t(axis)].area, areas[axis], 1e-9);
            const auto& layers = found[std::size_t(axis)].layers;
            ASSERT_EQ(layers.size(), 2u);
            EXPECT_EQ(layers[0].label, inner);
            EXPECT_NEAR(layers[0].thickness, 0.3, 1e-9);
            EXPECT_EQ(layers[1].label, outer);
            EXPECT_NEAR(layers[1].thickness, 0.1, 1e-9);
        }
    }
}

TEST(SpaceBoundaries, WhatStandsInARoomBelongsToIt) {
    Scene s;
    const auto storey = s.add("Storey"), room = s.add("BuildingRoom", storey), table = s.add("BuildingFurniture", room),
               surface = s.add("InteriorWallSurface", room), wall = s.add("BuildingConstructiveElement", storey);
    EXPECT_EQ(spacesOfLabels(s.table), (std::vector<std::uint32_t>{storey, room, room, room, kNoLabel}));
    s.fill(wall, {2, 2, 2}, {38, 28, 18});
    s.fill(surface, {4, 4, 4}, {36, 26, 16});
    s.fill(room, {5, 5, 5}, {35, 25, 15});
    s.fill(table, {10, 10, 5}, {20, 20, 8});
    for (const SpaceBoundary& b : s.find()) {
        EXPECT_EQ(b.a, room);
        ASSERT_EQ(b.layers.size(), 1u);
        EXPECT_EQ(b.layers[0].label, wall);
    }
    EXPECT_EQ(s.find().size(), 3u);
}

TEST(SpaceBoundaries, MaterialBehindASurfaceOfARoomIsALayerAndNotAPartOfTheRoom) {
    Scene s;
    const auto room = s.add("BuildingRoom"), wall = s.add("InteriorWallSurface", room);
    s.add("Door", wall);
    s.add("DoorSurface", wall);
    s.add("BuildingFurniture", room);
    s.table.labels[wall].filling = volume::Filling::Body;
    EXPECT_EQ(spacesOfLabels(s.table), (std::vector<std::uint32_t>{room, kNoLabel, kNoLabel, kNoLabel, room}));
    s.fill(wall, {2, 2, 2}, {38, 28, 18});
    s.fill(room, {5, 5, 5}, {35, 25, 15});
    const auto found = s.find();
    ASSERT_EQ(found.size(), 3u);
    for (const SpaceBoundary& b : found) {
        EXPECT_EQ(b.b, kNoLabel);
        ASSERT_EQ(b.layers.size(), 1u);
        EXPECT_EQ(b.layers[0].label, wall);
    }
}

TEST(SpaceBoundaries, ConductancesOfASlantedSlabAddUpToItsOwn) {
    Scene s;
    const auto below = s.add("BuildingRoom"), slab = s.add("BuildingConstructiveElement"),
               above = s.add("BuildingRoom");
    // The plane 3 x + 4 z = d in steps of 0.05 m: the normal is (0.6, 0, 0.8).
    for (int k = 0; k < kSize.z; ++k)
        for (int j = 0; j < kSize.y; ++j)
            for (int i = 0; i < kSize.x; ++i) {
                const int at = 3 * i + 4 * k;
                s.fill(at < 80 ? below : at < 100 ? slab : above, {i, j, k}, {i + 1, j + 1, k + 1});
            }
    double conductance = 0;
    for (const SpaceBoundary& b : s.find({0.05, 0.05, 0.05}))
        if (b.a == below && b.b == above) conductance += b.area / b.layers.at(0).thickness;
    // 20 / 5 steps thick. All 20 rows lead along x through it, and of the columns those with i in [8, 26]: others begin or
    // end within it.
    const double thickness = 20 / 5.0 * 0.05;
    const double areaX = 20 * 30 * 0.0025, areaZ = 19 * 30 * 0.0025;
    EXPECT_NEAR(conductance, areaX * 0.6 / thickness + areaZ * 0.8 / thickness, 0.002 * conductance);
}

}  // namespace
}  // namespace svt::analyze
