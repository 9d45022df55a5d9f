#include <svt/illustrate/inset/inset_frame.hpp>

#include <svt/illustrate/scene_painter.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace svt::illustrate {
namespace {

// A plate (1) of 20 x 20 m with a small block (2) at its north-east.
volume::SemanticVolume plate() {
    volume::SemanticVolume volume = volume::test::emptyVolume({40, 40, 8}, {0.5, 0.5, 0.5});
    for (const char* id : {"plate", "block"}) volume::test::addObject(volume, id, "BuildingConstructiveElement");
    volume::test::paintBoxes(volume, {{1, {0, 0, 0}, {40, 40, 1}}, {2, {32, 32, 1}, {36, 36, 6}}});
    return volume;
}

Scene fromAbove() {
    Scene scene;
    scene.width = 400;
    scene.height = 300;
    scene.samples = 1;
    scene.camera.preset = "top";
    scene.camera.isParallel = true;
    return scene;
}

bool isRed(image::Rgba8 c) { return c.r > c.g + 60; }

TEST(Inset, ShowsItsOwnViewAndWhereItIs) {
    const volume::SemanticVolume volume = plate();
    ScenePainter painter(volume);
    Scene scene = fromAbove();
    const auto plain = painter.paint(scene);
    Inset inset;
    inset.corner = Inset::Corner::BottomLeft;
    inset.size = 0.25;
    inset.scene = R"({"camera":{"preset":"top","parallel":true,"around":"id=block"}})";
    scene.insets = {inset};
    const auto painting = painter.paint(scene);
    ASSERT_TRUE(painting && plain) << painting.error().toString();
    const PictureBox place = insetPlace(scene, inset);
    EXPECT_EQ(place.width(), 100);
    EXPECT_EQ(place.height(), 75);
    EXPECT_EQ(place.left, 6);
    EXPECT_EQ(place.bottom, 294);
    // Within the inset the block is large, and a pixel says so.
    EXPECT_EQ(painting->frame.label.at(int(place.left) + 50, int(place.top) + 37), 2u);
    // The frame of the inset, and one around the block in the picture, right of the inset and above its middle.
    bool hasFrame = false;
    for (int y = -1; y <= 1; ++y) hasFrame |= isRed(painting->frame.color.at(int(place.left) + 30, int(place.top) + y));
    EXPECT_TRUE(hasFrame);
    int red = 0, block = 0;
    for (int y = 0; y < 150; ++y)
        for (int x = 200; x < 400; ++x) {
            red += isRed(painting->frame.color.at(x, y));
            block += painting->frame.label.at(x, y) == 2;
        }
    EXPECT_GT(red, 40);
    EXPECT_GT(block, 100);
    // The drawing stands aside of the inset.
    for (int y = 220; y < 290; ++y)
        for (int x = int(place.right) + 1; x < int(place.right) + 4; ++x) EXPECT_EQ(painting->frame.label.at(x, y), 0u);
}

TEST(Inset, MarksThePictureInAnOverview) {
    const volume::SemanticVolume volume = plate();
    ScenePainter painter(volume);
    Scene scene = fromAbove();
    scene.camera.around = "id=block";
    Inset inset;
    inset.scene = R"({"camera":{"preset":"top","parallel":true}})";
    scene.insets = {inset};
    const auto painting = painter.paint(scene);
    ASSERT_TRUE(painting);
    const PictureBox place = insetPlace(scene, inset);
    int inside = 0;
    for (int y = int(place.top) + 4; y < int(place.bottom) - 4; ++y)
        for (int x = int(place.left) + 4; x < int(place.right) - 4; ++x)
            inside += isRed(painting->frame.color.at(x, y));
    EXPECT_GT(inside, 10);
}

TEST(Inset, LeadersDoNotCross) {
    const PictureBox shown{100, 100, 140, 130}, place{300, 10, 390, 80};
    const auto leaders = leadersBetween(shown, place);
    ASSERT_EQ(leaders.size(), 2u);
    for (const auto& [from, to] : leaders) {
        EXPECT_TRUE((from.x == 100 || from.x == 140) && (from.y == 100 || from.y == 130));
        EXPECT_TRUE((to.x == 300 || to.x == 390) && (to.y == 10 || to.y == 80));
    }
    EXPECT_TRUE(leadersBetween(PictureBox{0, 0, 100, 100}, PictureBox{20, 20, 30, 30}).empty());
}

TEST(Inset, IsWrittenAndRead) {
    Scene scene;
    scene.insets = {{Inset::Corner::BottomLeft, 0.2, "Beam", false, R"({"camera":{"around":"id=beam"}})"}};
    scene.explode = 2.5;
    scene.sun = Sun{"2026-06-21 15:00", {{49.0, 8.4}}, 2};
    scene.hasLegend = false;
    scene.passes[0].representation.hasCells = true;
    const auto read = parseScene(writeScene(scene));
    ASSERT_TRUE(read) << read.error().toString();
    EXPECT_EQ(*read, scene);
    const auto own = insetScene(scene, scene.insets[0]);
    ASSERT_TRUE(own);
    EXPECT_EQ(own->camera.around, "id=beam");
    EXPECT_EQ(own->title, "Beam");
    EXPECT_EQ(own->width, 256);
    EXPECT_EQ(own->explode, 2.5) << "what it does not say is that of the picture";
    for (const char* bad : {R"({"insets":[{"corner":"middle"}]})", R"({"insets":[{"scene":{"size":[1,2]}}]})",
                            R"({"insets":[{"scene":{"nothing":1}}]})", R"({"insets":[{},{},{},{},{}]})",
                            R"({"sun":{}})", R"({"sun":{"time":"x","place":[1]}})", R"({"explode":-1})"})
        EXPECT_EQ(parseScene(bad).error().code(), Code::BadScene) << bad;
}

}  // namespace
}  // namespace svt::illustrate
