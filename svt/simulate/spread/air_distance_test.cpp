// Lengths of ways through air against exact ones.
#include <svt/simulate/spread/air_distance.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace svt::simulate {
namespace {

constexpr std::uint32_t kRoom = 2;

RoomAir airWhere(Vec3i size, const std::function<std::uint32_t(Vec3i)>& zoneAt) {
    RoomAir air;
    air.size = size;
    for (std::int32_t k = 0; k < size.z; ++k)
        for (std::int32_t j = 0; j < size.y; ++j)
            for (std::int32_t i = 0; i < size.x; ++i) air.zones.push_back(zoneAt({i, j, k}));
    return air;
}

// Largest error relative to the exact length, of voxels at least ten voxels away.
double worstError(const RoomAir& air, AirDistance& distance, std::span<const std::uint32_t> reached,
                  const std::function<double(Vec3d)>& exact) {
    double worst = 0;
    for (const std::uint32_t v : reached) {
        const double length = exact(toDouble(air.place(v)));
        if (length >= 10) worst = std::max(worst, std::abs(double{distance.at(v)} / length - 1));
    }
    return worst;
}

TEST(AirDistance, InAnEmptyRoomIsThatOfAStraightLine) {
    const RoomAir air = airWhere({60, 50, 40}, [](Vec3i) { return kRoom; });
    AirDistance distance(air, {1, 1, 1});
    for (const Vec3d place : {Vec3d{20.3, 24.6, 19.8}, Vec3d{0, 0, 0}, Vec3d{-0.4, 30.2, 39.4}}) {
        const Vec3i voxel{std::max(0, int(std::round(place.x))), int(std::round(place.y)), int(std::round(place.z))};
        const auto reached = distance.from(place, voxel);
        EXPECT_EQ(reached.size(), air.zones.size());
        EXPECT_LT(worstError(air, distance, reached, [&](Vec3d p) { return length(p - place); }), 0.01);
        EXPECT_TRUE(std::is_sorted(reached.begin(), reached.end(),
                                   [&](auto a, auto b) { return distance.at(a) < distance.at(b); }));
    }
}

TEST(AirDistance, FollowsUnequalSpacings) {
    const RoomAir air = airWhere({40, 40, 60}, [](Vec3i) { return kRoom; });
    const Vec3d spacing{0.1, 0.2, 0.05}, place{10, 12, 30};
    AirDistance distance(air, spacing);
    double worst = 0;
    for (const std::uint32_t v : distance.from(place, {10, 12, 30})) {
        const double exact = length(scaled(toDouble(air.place(v)) - place, spacing));
        if (exact >= 1.5) worst = std::max(worst, std::abs(double{distance.at(v)} / exact - 1));
    }
    EXPECT_LT(worst, 0.03);
}

TEST(AirDistance, GoesAroundTheEndOfAWall) {
    // A wall across the room, open for y >= 40: the way leads by its end.
    constexpr double kWall = 30, kEnd = 39.5;
    const RoomAir air = airWhere({61, 60, 3}, [](Vec3i p) { return p.x == 30 && p.y < 40 ? RoomAir::kNone : kRoom; });
    AirDistance distance(air, {1, 1, 1});
    const Vec3d place{15, 15, 1};
    const auto reached = distance.from(place, {15, 15, 1});
    EXPECT_EQ(reached.size(), air.zones.size() - 120);
    const double error = worstError(air, distance, reached, [&](Vec3d p) {
        const double straight = std::hypot(p.x - place.x, p.y - place.y, p.z - place.z);
        if (p.x < kWall) return straight;
        const double at = place.y + (p.y - place.y) * (kWall - place.x) / (p.x - place.x);
        if (at >= kEnd) return straight;
        const double first = std::hypot(kWall - 0.5 - place.x, kEnd - place.y);
        const double last = std::hypot(std::max(0.0, p.x - kWall - 0.5), p.y - kEnd);
        return std::hypot(first + std::min(1.0, p.x - kWall + 0.5) + last, p.z - place.z);
    });
    EXPECT_LT(error, 0.05);
}

TEST(AirDistance, PassesCommonAirAndNotFromRoomToRoom) {
    // Rooms 2, 3 and 4 in a row; common air lies between the last two.
    const RoomAir air = airWhere({30, 5, 5}, [](Vec3i p) -> std::uint32_t {
        return p.x < 10 ? 2 : p.x < 20 ? 3 : p.x == 20 ? RoomAir::kCommon : 4;
    });
    AirDistance distance(air, {1, 1, 1});
    EXPECT_EQ(distance.from({5, 2, 2}, {5, 2, 2}).size(), 250u);
    EXPECT_EQ(distance.from({25, 2, 2}, {25, 2, 2}).size(), 500u);
    EXPECT_FALSE(distance.isReached(0));
    EXPECT_EQ(distance.from({5, 2, 2}, {5, 2, 2}).size(), 250u) << "the last distances are forgotten";
    EXPECT_FALSE(distance.isReached(29));
}

TEST(AirDistance, DoesNotPassAnEdge) {
    // Two halves that share an edge only.
    const RoomAir air = airWhere({10, 10, 4}, [](Vec3i p) { return (p.x < 5) == (p.y < 5) ? kRoom : RoomAir::kNone; });
    AirDistance distance(air, {1, 1, 1});
    EXPECT_EQ(distance.from({4, 4, 1}, {4, 4, 1}).size(), 100u);
}

}  // namespace
}  // namespace svt::simulate
