/// Stairs of boxes: treads on risers, treads of one block, ramps.

#include <svt/drawing/exact/boxes_test.hpp>
#include <svt/drawing/stair_flights.hpp>

#include <gtest/gtest.h>

namespace svt::drawing {
namespace {

constexpr double kRise = 0.1364, kGoing = 0.27, kBoard = 0.06;

struct StairBoxes : Boxes {
    StairBoxes() {
        addLabel("stair", "BuildingConstructiveElement", volume::Filling::Solid, 1);
        volume.labels.labels.back().attributes.push_back({"ifcType", std::string("IfcStair"), ""});
    }
    void add(Vec3d low, Vec3d high) { volume::test::addBoxMesh(volume, 0, low, high); }
};

// The top of a riser lies 6 cm below the tread that it carries.
TEST(StairFlights, TreadsOnRisersCountOnce) {
    StairBoxes stair;
    for (int n = 0; n < 11; ++n) {
        const double x = kGoing * n, top = kRise * (n + 1);
        stair.add({x, 0, top - 0.2}, {x + 0.24, 1, top - kBoard});
        stair.add({x, 0, top - kBoard}, {x + kGoing, 1, top});
    }
    const auto flights = findStairFlights(stair.volume);
    ASSERT_EQ(flights.size(), 1u);
    EXPECT_EQ(flights[0].treads.size(), 11u);
    EXPECT_NEAR(flights[0].riser, kRise, 1e-5);
    EXPECT_NEAR(flights[0].going, kGoing, 1e-5);
    EXPECT_EQ(flights[0].risersTo(12 * kRise), 12);
}

TEST(StairFlights, BlocksOnBlocksAreTreads) {
    StairBoxes stair;
    for (int n = 0; n < 8; ++n) stair.add({kGoing * n, 0, 0.18 * n}, {kGoing * 8, 1, 0.18 * (n + 1)});
    const auto flights = findStairFlights(stair.volume);
    ASSERT_EQ(flights.size(), 1u);
    ASSERT_EQ(flights[0].treads.size(), 8u);
    EXPECT_NEAR(flights[0].treads[0].center.x - stair.volume.grid.origin().x, 0.5 * kGoing, 1e-4);
    EXPECT_NEAR(flights[0].going, kGoing, 1e-4);
}

TEST(StairFlights, ALandingDoesNotCountAsGoing) {
    StairBoxes stair;
    for (int n = 0; n < 9; ++n) {
        const double x = kGoing * n + (n > 4 ? 1 : 0);
        stair.add({x, 0, 0.17 * n}, {x + kGoing + (n == 4 ? 1 : 0), 1, 0.17 * (n + 1)});
    }
    const auto flights = findStairFlights(stair.volume);
    ASSERT_EQ(flights.size(), 1u);
    EXPECT_EQ(flights[0].treads.size(), 9u);
    EXPECT_NEAR(flights[0].going, kGoing, 1e-5);
}

// The edge of the floor that the stair reaches, and the foot of a post.
TEST(StairFlights, SmallerFacesBetweenTreadsDoNotCount) {
    StairBoxes stair;
    for (int n = 0; n < 8; ++n) stair.add({kGoing * n, 0, 0.19 * n}, {kGoing * (n + 1), 1, 0.19 * (n + 1)});
    stair.add({kGoing * 7, 1, 0}, {kGoing * 8, 1.9, 0.19 * 7 + 0.085});
    const auto flights = findStairFlights(stair.volume);
    ASSERT_EQ(flights.size(), 1u);
    EXPECT_EQ(flights[0].treads.size(), 8u);
    EXPECT_NEAR(flights[0].riser, 0.19, 1e-5);
}

TEST(StairFlights, TwoStepsAreNoFlightAndHideNoOther) {
    StairBoxes stair;
    stair.addLabel("flight", "BuildingConstructiveElement", volume::Filling::Solid, 2);
    stair.volume.labels.labels.back().attributes.push_back({"ifcType", std::string("IfcStair"), ""});
    for (int n = 0; n < 2; ++n) stair.add({kGoing * n, 3, 0}, {kGoing * (n + 1), 4, 0.18 * (n + 1)});
    for (int n = 0; n < 8; ++n)
        volume::test::addBoxMesh(stair.volume, 1, {kGoing * n, 0, 0}, {kGoing * (n + 1), 1, 0.18 * (n + 1)});
    const auto flights = findStairFlights(stair.volume);
    ASSERT_EQ(flights.size(), 1u);
    EXPECT_EQ(flights[0].treads.size(), 8u);
}

TEST(StairFlights, PlatesOfSteelAreTreads) {
    StairBoxes stair;
    for (int n = 0; n < 5; ++n)
        stair.add({kGoing * n, 0, 0.18 * (n + 1) - 0.005}, {kGoing * (n + 1), 1, 0.18 * (n + 1)});
    const auto flights = findStairFlights(stair.volume);
    ASSERT_EQ(flights.size(), 1u);
    EXPECT_EQ(flights[0].treads.size(), 5u);
}

TEST(StairFlights, ABlockIsNoStair) {
    StairBoxes ramp;
    ramp.add({0, 0, 0}, {4, 1, 1});
    EXPECT_TRUE(findStairFlights(ramp.volume).empty());
}

}  // namespace
}  // namespace svt::drawing
