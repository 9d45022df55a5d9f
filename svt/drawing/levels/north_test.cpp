/// True north of models with a CRS, with a stated direction, and with neither; the names of elevations.

#include <svt/drawing/north.hpp>
#include <svt/drawing/section_plane.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace svt::drawing {
namespace {

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

volume::SemanticVolume plainVolume() {
    return volume::test::emptyVolume({11, 11, 11}, {1, 1, 1}, {457000, 5429000, 100});
}

volume::SemanticVolume volumeWithNorth(double degrees) {
    volume::SemanticVolume volume = plainVolume();
    volume::test::addGroup(volume, "site", "LandUse").attributes = {{"trueNorth", degrees, "deg"}};
    return volume;
}

TEST(North, IsAssumedAlongYWithoutADirection) {
    const North north = northOf(plainVolume());
    EXPECT_EQ(north.source, NorthSource::Assumed);
    EXPECT_EQ(north.degrees, 0);
}

TEST(North, ComesFromTheModel) {
    const North north = northOf(volumeWithNorth(50));
    EXPECT_EQ(north.source, NorthSource::Model);
    EXPECT_NEAR(north.direction().x, std::sin(50 / kDegreesPerRadian), 1e-12);
    EXPECT_NEAR(north.direction(90).x, std::cos(50 / kDegreesPerRadian), 1e-12) << "east";
    EXPECT_EQ(compassNames()[north.eighthOf({0, 1, 0})], "north-west") << "azimuth 310";
    EXPECT_EQ(compassNames()[north.eighthOf({1, 0, 0})], "north-east") << "azimuth 40";
}

// West of the meridian of the zone, true north lies east of grid north: by (9 - longitude) times the sine of latitude.
TEST(North, IsTheMeridianOfTheCrs) {
    volume::SemanticVolume volume = volumeWithNorth(50);
    volume.crsName = "EPSG:25832";
    const North north = northOf(volume);
    EXPECT_EQ(north.source, NorthSource::Projection);
    EXPECT_NEAR(north.degrees, (9 - 8.412) * std::sin(49.0125 / kDegreesPerRadian), 2e-3);
}

TEST(North, ElevationsAreNamedClockwiseFromNorth) {
    using Sides = std::array<std::string_view, 4>;
    EXPECT_EQ(elevationSides(plainVolume()), (Sides{"north", "east", "south", "west"}));
    EXPECT_EQ(elevationSides(volumeWithNorth(50)), (Sides{"north-east", "south-east", "south-west", "north-west"}));
    EXPECT_EQ(elevationSides(volumeWithNorth(180)), (Sides{"north", "east", "south", "west"}));
    // At every angle the names differ, and each leads to another side.
    for (int tenths = -3601; tenths <= 3600; tenths += 5) {
        const volume::SemanticVolume volume = volumeWithNorth(0.1 * tenths);
        Vec3d sum{};
        for (const std::string_view side : elevationSides(volume)) {
            const auto plane = elevationPlane(side, volume);
            ASSERT_TRUE(plane);
            EXPECT_EQ(compassNames()[northOf(volume).eighthOf(plane->normal)], side) << tenths;
            sum = sum + plane->normal;
        }
        EXPECT_NEAR(length(sum), 0, 1e-12) << tenths;
    }
}

TEST(North, AnElevationFacesTheSideNearestToItsName) {
    EXPECT_EQ(elevationPlane("north", volumeWithNorth(50))->normal, (Vec3d{1, 0, 0}));
    EXPECT_EQ(elevationPlane("north-west", volumeWithNorth(50))->normal, (Vec3d{0, 1, 0}));
    EXPECT_EQ(elevationPlane("north", volumeWithNorth(180))->normal, (Vec3d{0, -1, 0}));
    EXPECT_EQ(elevationPlane("up", plainVolume()).error().code(), Code::BadSection);
}

}  // namespace
}  // namespace svt::drawing
