#include <svt/illustrate/scene_painter.hpp>
#include <svt/illustrate/sun.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace svt::illustrate {
namespace {

double dayOf(const char* text, double longitude = 0) {
    const auto day = parseSunTime(text, longitude);
    EXPECT_TRUE(day) << text;
    return day ? *day : 0;
}

TEST(Sun, TimesAreJulianDays) {
    EXPECT_EQ(dayOf("2000-01-01 12:00Z"), 2451545.0) << "the epoch J2000";
    EXPECT_EQ(dayOf("1987-06-19 12:00Z"), 2446966.0) << "Meeus, example 7.a and its table";
    EXPECT_NEAR(dayOf("2026-06-21 15:00+02:00"), dayOf("2026-06-21T13:00:00Z"), 1e-9);
    EXPECT_NEAR(dayOf("2026-06-21 15:00", 8.4), dayOf("2026-06-21 14:00Z"), 1e-9) << "the time of 15 degrees east";
    EXPECT_NEAR(dayOf("2026-06-21 15:00-03:30"), dayOf("2026-06-21 18:30Z"), 1e-9);
    for (const char* bad : {"", "2026-06-21", "2026-06-31 12:00", "2025-02-29 12:00", "2026-06-21 25:00",
                            "21.6.2026 15:00", "2026-06-21 15:00 CEST", "2026-06-21 15:00+2"})
        EXPECT_EQ(parseSunTime(bad, 0).error().code(), Code::BadScene) << bad;
}

// Reda and Andreas, Solar Position Algorithm for Solar Radiation Applications (NREL/TP-560-34302), example of table A5.1:
// topocentric zenith without refraction 90 - 39.872046, azimuth 194.340241.
TEST(Sun, StandsWhereTheAlgorithmOfNrelHasIt) {
    const SunPosition sun = sunPosition(dayOf("2003-10-17 12:30:30-07:00"), 39.742476, -105.1786);
    EXPECT_NEAR(sun.elevation, 39.872046, 0.02);
    EXPECT_NEAR(sun.azimuth, 194.340241, 0.02);
}

// At the solstice the sun is 23.44 degrees north; at noon of the meridian's own time it stands in the south.
TEST(Sun, StandsHighestAtMidsummer) {
    double most = 0, azimuth = 0;
    for (int minute = 0; minute < 1440; ++minute) {
        const SunPosition sun = sunPosition(dayOf("2026-06-21 00:00Z") + minute / 1440.0, 52.52, 13.405);
        if (sun.elevation > most) most = sun.elevation, azimuth = sun.azimuth;
    }
    EXPECT_NEAR(most, 90 - 52.52 + 23.436, 0.02);
    EXPECT_NEAR(azimuth, 180, 1);
}

// A plate of 10 x 10 m with a post of 1 x 1 x 4 m in its middle, 0.1 m voxels.
volume::SemanticVolume postOnPlate() {
    volume::SemanticVolume volume = volume::test::emptyVolume({100, 100, 50}, {0.1, 0.1, 0.1}, {0.05, 0.05, 0.05});
    for (const char* id : {"plate", "post"}) volume::test::addObject(volume, id, "BuildingConstructiveElement");
    volume::test::paintBoxes(volume, {{1, {0, 0, 0}, {100, 100, 2}}, {2, {45, 45, 2}, {55, 55, 42}}});
    return volume;
}

Scene fromAbove() {
    Scene scene;
    scene.width = scene.height = 100;
    scene.samples = 1;
    scene.camera.preset = "top";
    scene.camera.isParallel = true;
    scene.lines.strength = 0;
    scene.ambientOcclusion = 0;
    scene.sun = Sun{"2026-06-21 12:00Z", {{47.0, 0.0}}, 0};
    return scene;
}

// Seen from above, the shadow of the post falls to the north, as long as its height over the tangent of the elevation.
TEST(Sun, ShadowsAreAsLongAsTheSunIsLow) {
    const volume::SemanticVolume volume = postOnPlate();
    for (const char* time : {"2026-06-21 12:00Z", "2026-03-20 12:00Z"}) {
        ScenePainter painter(volume);
        Scene scene = fromAbove();
        scene.sun->time = time;
        const auto light = sunlightOf(*scene.sun, volume);
        ASSERT_TRUE(light);
        const auto painting = painter.paint(scene);
        ASSERT_TRUE(painting) << painting.error().toString();
        const auto& image = painting->frame.color;
        // The plate fills 92 of 100 pixels; along the column through the post, to the north.
        int shaded = 0;
        const int lit = image.at(10, 90).r;
        for (int y = 0; y < 100; ++y)
            shaded += painting->frame.label.at(50, y) == 1 && image.at(50, y).r < lit - 20 ? 1 : 0;
        const double metres = shaded / 9.2;
        EXPECT_NEAR(metres, 4 / std::tan(light->position.elevation * 3.14159265 / 180), 0.3) << time;
        // And none of it to the south.
        EXPECT_GT(image.at(50, 70).r, lit - 5);
    }
}

TEST(Sun, LargerOnesCastSofterShadows) {
    const volume::SemanticVolume volume = postOnPlate();
    ScenePainter painter(volume);
    const auto shadesOf = [&](double size) {
        Scene scene = fromAbove();
        scene.sun->size = size;
        const auto painting = painter.paint(scene);
        std::vector<int> shades;
        for (int y = 0; y < 45 && painting; ++y) shades.push_back(painting->frame.color.at(50, y).r);
        std::sort(shades.begin(), shades.end());
        shades.erase(std::unique(shades.begin(), shades.end()), shades.end());
        return shades.size();
    };
    EXPECT_GE(shadesOf(15), shadesOf(0) + 4);
}

TEST(Sun, NeedsAPlace) {
    const volume::SemanticVolume volume = postOnPlate();
    const Sun sun{"2026-06-21 12:00Z", {}, 0.53};
    EXPECT_EQ(sunlightOf(sun, volume).error().code(), Code::BadScene);
    volume::SemanticVolume placed = volume;
    placed.labels.labels[0].attributes = {
        {"latitude", 47.0, "deg"}, {"longitude", 8.0, "deg"}, {"trueNorth", 90.0, "deg"}};
    const auto light = sunlightOf(sun, placed);
    ASSERT_TRUE(light);
    EXPECT_EQ(light->latitude, 47);
    EXPECT_GT(-light->direction.x, 0.2) << "north lies in the east of the map, so the south is in its west";
    // A place of the user keeps the north of the model.
    const auto given = sunlightOf({"2026-06-21 12:00Z", std::array<double, 2>{47.0, 8.0}, 0.53}, placed);
    ASSERT_TRUE(given);
    EXPECT_NEAR(length(given->direction - light->direction), 0, 1e-12);
    placed.crsName = "EPSG:25832";
    placed.grid = *volume::Grid::fromParts(placed.grid.dimension(), {0.1, 0.1, 0.1}, {457000, 5429000, 100},
                                           {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
    const auto mapped = sunlightOf(sun, placed);
    ASSERT_TRUE(mapped);
    EXPECT_NEAR(mapped->latitude, 49.0125, 0.01);
    EXPECT_NEAR(mapped->longitude, 8.412, 0.01);
    EXPECT_LT(std::abs(mapped->direction.x), 0.35);
}

// As the reference draws it, to the last bit.
TEST(Sun, LightsAsTheReferenceDoes) {
    const volume::SemanticVolume volume = postOnPlate();
    Scene scene = fromAbove();
    scene.camera = {};
    scene.sun->size = 2;
    const auto spec = makeFrameSpec(scene, volume);
    ASSERT_TRUE(spec);
    const auto bricks = volume::BrickVolume::fromColumns(volume.columns);
    const auto frame = render::castRays(*bricks, volume.grid, *spec);
    const auto reference = render::castRaysReference(*bricks, volume.grid, *spec);
    ASSERT_TRUE(frame && reference);
    EXPECT_EQ(frame->color, reference->color);
}

}  // namespace
}  // namespace svt::illustrate
