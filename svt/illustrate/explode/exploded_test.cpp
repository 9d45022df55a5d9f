#include <svt/illustrate/exploded.hpp>

#include <svt/analyze/scalar_boxes.hpp>
#include <svt/illustrate/scene_painter.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

namespace svt::illustrate {
namespace {

// A building (0) of two storeys (1, 4), each with a room (2, 5) and a slab below it (3, 6), and a wall of the whole
// height (7) that belongs to no storey. 0.1 m voxels, heights in samples:
//
//      56 +---+ wall
//         |   | room 5: 32 .. 56
//      32 |   +------- slab 6: 28 .. 32
//      28 |   | room 2: 4 .. 28
//       4 |   +------- slab 3: 0 .. 4
//       0 +---+
volume::SemanticVolume building() {
    volume::SemanticVolume volume = volume::test::emptyVolume({16, 16, 56}, {0.1, 0.1, 0.1}, {0.05, 0.05, 0.05});
    volume::test::addGroup(volume, "b", "Building");
    volume::test::addGroup(volume, "eg", "Storey", 0);
    volume::test::addObject(volume, "r1", "BuildingRoom", 1);
    volume::test::addObject(volume, "s1", "FloorSurface", 1);
    volume::test::addGroup(volume, "og", "Storey", 0);
    volume::test::addObject(volume, "r2", "BuildingRoom", 4);
    volume::test::addObject(volume, "s2", "FloorSurface", 4);
    volume::test::addObject(volume, "w", "WallSurface", 0);
    volume::test::paint(volume, [](int i, int, int k) { return i < 4 ? 5 : k < 4 ? 2 : k < 28 ? 1 : k < 32 ? 4 : 3; });
    // The upper face of the upper slab, and the wall's side.
    volume.planes = {{{{0, 0, 1}, -32}, {4, 0, 31}, {16, 16, 33}}, {{{1, 0, 0}, -4}, {3, 0, 0}, {5, 16, 56}}};
    volume.vectors.unit = volume::VectorParts::kCoarsestUnit;
    volume.vectors.points = {{0, 0, 0}, {0, 0, static_cast<std::int32_t>(5.6 * 1024)}};
    volume.vectors.segments = {{7, {0, 1}}};
    return volume;
}

TEST(ExplodeStoreys, LiftsEachStoreyWithItsFloor) {
    const volume::SemanticVolume volume = building();
    const auto apart = explodeStoreys(volume, 1.6);
    ASSERT_TRUE(apart) << apart.error().toString();
    EXPECT_EQ(apart->grid.dimension(), (Vec3i{16, 16, 72}));
    EXPECT_EQ(apart->grid.origin(), volume.grid.origin());
    const auto range = [&](int i) {
        std::string text;
        std::uint32_t from = 0;
        for (const volume::Run& run : apart->columns.column(i, 8)) {
            text += std::to_string(run.scalar) + ":" + std::to_string(from) + "-" + std::to_string(run.end) + " ";
            from = run.end;
        }
        return text;
    };
    EXPECT_EQ(range(8), "2:0-4 1:4-28 0:28-44 4:44-48 3:48-72 ");
    EXPECT_EQ(range(1), "5:0-28 0:28-44 5:44-72 ") << "the wall is cut at the ceiling of the lower room";
    // All that there was is there, once.
    EXPECT_EQ(apart->columns.countVoxels(6)[5], volume.columns.countVoxels(6)[5]);
}

TEST(ExplodeStoreys, LiftsPlanesAndEdges) {
    const auto apart = explodeStoreys(building(), 1.6);
    ASSERT_TRUE(apart);
    ASSERT_EQ(apart->planes.size(), 3u) << "the level plane for both storeys, the upright one once";
    EXPECT_EQ(apart->planes[1].plane.offset, -48);
    EXPECT_EQ(apart->planes[1].min[2], 47);
    EXPECT_EQ(apart->planes[2].max[2], 72);
    EXPECT_TRUE(volume::checkFacePlanes(apart->planes, apart->grid.dimension()));
    ASSERT_EQ(apart->vectors.segments.size(), 2u) << "one piece of the wall's edge in each storey";
    std::vector<double> heights;
    for (const auto& segment : apart->vectors.segments)
        for (const std::uint32_t end : segment.ends) heights.push_back(apart->vectors.position(end, {}).z);
    ASSERT_EQ(heights.size(), 4u);
    EXPECT_NEAR(heights[0], 0, 0.002);
    EXPECT_NEAR(heights[1], 2.75, 0.002);
    EXPECT_NEAR(heights[2], 4.35, 0.002);
    EXPECT_NEAR(heights[3], 7.2, 0.002);
    EXPECT_TRUE(volume::checkVectorParts(apart->vectors, apart->labels.labels.size()));
}

TEST(ExplodeStoreys, SaysWhatItCannot) {
    volume::SemanticVolume low = building();
    for (auto& label : low.labels.labels)
        if (label.className == "Storey" || label.className == "BuildingRoom") label.className = "Building";
    EXPECT_EQ(explodeStoreys(low, 1).error().code(), Code::BadArgument);
    EXPECT_EQ(explodeStoreys(building(), 0).error().code(), Code::BadArgument);
    EXPECT_EQ(explodeStoreys(building(), 1e6).error().code(), Code::BadArgument);
}

// In the picture there is a gap between the storeys, and sections find them where they are.
TEST(ExplodeStoreys, IsDrawn) {
    const volume::SemanticVolume volume = building();
    ScenePainter painter(volume);
    Scene scene;
    scene.width = 64;
    scene.height = 200;
    scene.camera.preset = "front";
    scene.camera.isParallel = true;
    scene.explode = 1.6;
    scene.passes[0].show = {"all"};  // rooms too
    const auto painting = painter.paint(scene);
    ASSERT_TRUE(painting) << painting.error().toString();
    // 7.2 m fill 92 % of the height: the gap of 1.6 m is about 41 pixels.
    int gap = 0;
    for (int y = 20; y < 180; ++y) gap += painting->frame.label.at(32, y) == 0 ? 1 : 0;
    EXPECT_NEAR(gap, 41, 3);
    scene.passes[0].cut = "storey=og+0.1";
    EXPECT_TRUE(painter.paint(scene));
    scene.explode = 0;
    EXPECT_TRUE(painter.paint(scene));
}

}  // namespace
}  // namespace svt::illustrate
