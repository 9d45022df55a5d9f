#include <svt/analyze/label_measures.hpp>

#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

namespace svt::analyze {
namespace {

TEST(LabelMeasures, AreBoxAndSumOfContacts) {
    const volume::SemanticVolume volume = volume::test::sampleVolume();
    const auto contacts = findContacts(volume.columns, volume.grid, volume.labels, 1);
    const auto measures = measureLabels(volume, contacts);
    ASSERT_EQ(measures.size(), 5u);
    // The wall stands in the middle of 70 x 66 samples, in layers 1 to 7 of 9; voxels of 0.05 x 0.1 x 1/3 m.
    const Box3d box = worldBox({{35, 0, 1}, {35, 65, 7}}, volume.grid);
    EXPECT_EQ(measures[2].box.min, box.min);
    EXPECT_EQ(measures[2].box.max, box.max);
    const double sides = 66 * 7 * 0.1 / 3, ends = 2 * 7 * 0.05 / 3, levels = 2 * 66 * 0.05 * 0.1;
    EXPECT_NEAR(measures[2].area, 2 * sides + ends + levels, 0.03 * measures[2].area);
    EXPECT_GT(measures[2].outsideArea, ends + levels - 1e-9);
    EXPECT_LT(measures[2].outsideArea, measures[2].area - 2 * 64 * 7 * 0.1 / 3 + 1e-9);
    // Features without voxels have neither.
    EXPECT_TRUE(measures[4].box.isEmpty());
    EXPECT_EQ(measures[4].area, 0);
}

TEST(LabelMeasures, WorldBoxesReachHalfAVoxelFurther) {
    const volume::Grid grid = *volume::Grid::fromParts({10, 10, 10}, {0.5, 1, 2}, {100, 200, 300},
                                                       {Vec3d{0, 1, 0}, Vec3d{-1, 0, 0}, Vec3d{0, 0, 1}});
    const Box3d box = worldBox({{2, 3, 4}, {5, 3, 4}}, grid);
    // Index x is world y, index y is world -x.
    EXPECT_EQ(box.min, (Vec3d{100 - 3.5, 200 + 0.75, 300 + 7}));
    EXPECT_EQ(box.max, (Vec3d{100 - 2.5, 200 + 2.75, 300 + 9}));
    EXPECT_TRUE(worldBox({}, grid).isEmpty());
}

TEST(LabelMeasures, BoxesAreThoseOfMeshesWhereThereAreAny) {
    // A beam of 4.1 m and 3 cm keeps one voxel of 5 cm; a surface stands for the material behind it.
    volume::SemanticVolume volume = volume::test::emptyVolume({100, 4, 4}, {0.05, 0.05, 0.05}, {500000, 5400000, 100});
    volume::test::addObject(volume, "beam", "BuildingConstructiveElement").filling = volume::Filling::Solid;
    volume::test::addObject(volume, "wall", "WallSurface").filling = volume::Filling::Body;
    volume::test::addObject(volume, "without mesh", "Window");
    volume::test::addBoxMesh(volume, 0, {0.3, 0.06, 0.06}, {4.4, 0.09, 0.09});
    volume::test::addQuad(volume, 1, {Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{1, 0, 0.1}, Vec3d{0, 0, 0.1}});
    volume::test::paintBoxes(volume,
                             {{1, {40, 1, 1}, {41, 2, 2}}, {2, {0, 0, 0}, {20, 2, 2}}, {3, {60, 0, 0}, {62, 1, 1}}});
    const std::vector<Box3d> boxes = labelWorldBoxes(volume);
    ASSERT_EQ(boxes.size(), 3u);
    EXPECT_NEAR(boxes[0].min.x, 500000.3, 1e-6);
    EXPECT_NEAR(boxes[0].max.x, 500004.4, 1e-6);
    EXPECT_NEAR(boxes[0].size().y, 0.03, 2e-6);
    EXPECT_NEAR(boxes[1].size().y, 0.1, 1e-6) << "surface and material";
    const Box3d voxels = worldBox({{60, 0, 0}, {61, 0, 0}}, volume.grid);
    EXPECT_EQ(boxes[2].min, voxels.min);
    EXPECT_EQ(boxes[2].max, voxels.max);
    EXPECT_EQ(measureLabels(volume, {})[0].box.max.x, boxes[0].max.x);
}

TEST(LabelMeasures, VolumesAreThoseOfSolidsUnlessVoxelsWereLost) {
    volume::LabelTable table;
    const auto add = [&](volume::Filling filling, double volume, std::uint64_t voxels) {
        volume::Label label;
        label.filling = filling;
        label.volume = volume;
        label.voxels = voxels;
        table.labels.push_back(label);
    };
    add(volume::Filling::Solid, 1.1, 100);
    add(volume::Filling::Solid, 2.2, 150);  // lost to 0
    add(volume::Filling::Surface, 0, 70);
    add(volume::Filling::Winding, 0, 60);
    add(volume::Filling::Solid, 5.5, 0);  // lost all
    table.overlaps = {{0, 1, 50, false}};
    const volume::Grid grid =
        *volume::Grid::fromParts({9, 9, 9}, {0.1, 0.1, 1}, {}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
    const auto volumes = ownVolumes(table, grid);
    const double expected[] = {1.1, 1.5, 0, 0.6, 0};
    for (std::size_t l = 0; l < 5; ++l) EXPECT_NEAR(volumes[l], expected[l], 1e-12) << l;
}

TEST(LabelMeasures, SheetsCountWithTheBodyThatTheyBound) {
    // A room of 8 x 8 x 4 voxels of 1 m3 with a floor of one layer, a window in the floor, and a stove.
    volume::SemanticVolume volume = volume::test::emptyVolume({8, 8, 4}, {1, 1, 1});
    volume::test::addObject(volume, "room", "BuildingRoom").filling = volume::Filling::Solid;
    volume::test::addObject(volume, "floor", "FloorSurface", 0).filling = volume::Filling::Surface;
    volume::test::addObject(volume, "window", "Window", 1).filling = volume::Filling::Surface;
    volume::test::addObject(volume, "stove", "BuildingFurniture", 0).filling = volume::Filling::Solid;
    volume::test::paintBoxes(
        volume,
        {{1, {0, 0, 0}, {8, 8, 4}}, {2, {0, 0, 0}, {8, 8, 1}}, {3, {0, 0, 0}, {2, 2, 1}}, {4, {4, 4, 1}, {6, 6, 2}}});
    volume.labels.labels[0].volume = 256;
    volume.labels.overlaps = {{3, 0, 4, true}};
    const auto measures = ownMeasures(volume.labels, volume.grid);
    EXPECT_EQ(measures[0].voxels, 256u - 64 - 4);
    EXPECT_EQ(measures[0].volume, 252.0) << "the room without the stove, with its floor";
    EXPECT_EQ(measures[0].countedVolume, 252.0);
    EXPECT_FALSE(measures[1].volume || measures[2].volume);
    volume.labels.overlaps.clear();
    EXPECT_EQ(ownMeasures(volume.labels, volume.grid)[0].volume, 256.0);
}

}  // namespace
}  // namespace svt::analyze
