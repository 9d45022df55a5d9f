#include <svt/render/clip_intervals.hpp>

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

namespace svt::render {
namespace {

// A grid whose voxel space is world space.
volume::Grid unitGrid() {
    return *volume::Grid::fromParts({100, 100, 100}, {1, 1, 1}, {0.5, 0.5, 0.5},
                                    {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
}

// Intervals along x through y = z = 5, from 0 to 100.
std::vector<std::pair<double, double>> intervals(const std::vector<ClipRegion>& clips) {
    const Clipper clipper(clips, unitGrid());
    std::vector<std::pair<double, double>> result;
    for (const DrawnInterval& interval : clipper.cut(VoxelRay({0, 5, 5}, {1, 0, 0}), {0, 100}))
        result.emplace_back(interval.from, interval.to);
    return result;
}

using List = std::vector<std::pair<double, double>>;

Box3d slab(double from, double to) { return {{from, 0, 0}, {to, 10, 10}}; }

TEST(Clipper, PlanesAndBoxesCutIntervals) {
    using Mode = ClipRegion::Mode;
    EXPECT_EQ(intervals({}), (List{{0, 100}}));
    EXPECT_EQ(intervals({ClipRegion::plane({1, 0, 0}, {30, 0, 0})}), (List{{0, 30}}));
    EXPECT_EQ(intervals({ClipRegion::plane({-1, 0, 0}, {30, 0, 0})}), (List{{30, 100}}));
    EXPECT_EQ(intervals({ClipRegion::plane({0, 1, 0}, {0, 4, 0})}), (List{}));
    EXPECT_EQ(intervals({ClipRegion::plane({0, 1, 0}, {0, 6, 0})}), (List{{0, 100}}));
    EXPECT_EQ(intervals({ClipRegion::box(slab(20, 40), Mode::CutAway)}), (List{{0, 20}, {40, 100}}));
    EXPECT_EQ(intervals({ClipRegion::box(slab(20, 40), Mode::KeepOnly)}), (List{{20, 40}}));
    EXPECT_EQ(intervals({ClipRegion::box(slab(20, 40), Mode::CutAway), ClipRegion::box(slab(60, 70), Mode::CutAway)}),
              (List{{0, 20}, {40, 60}, {70, 100}}));
    EXPECT_EQ(intervals({ClipRegion::box(slab(20, 60), Mode::KeepOnly), ClipRegion::box(slab(30, 40), Mode::CutAway)}),
              (List{{20, 30}, {40, 60}}));
    EXPECT_EQ(intervals({ClipRegion::box(slab(-20, 30), Mode::CutAway), ClipRegion::box(slab(30, 200), Mode::CutAway)}),
              (List{}));
}

TEST(Clipper, AStartKnowsThePlaneThatMadeIt) {
    const std::vector<ClipRegion> clips{ClipRegion::box(slab(20, 40), ClipRegion::Mode::CutAway)};
    const Clipper clipper(clips, unitGrid());
    const DrawnIntervals drawn = clipper.cut(VoxelRay({0, 5, 5}, {1, 0, 0}), {0, 100});
    EXPECT_FALSE(drawn.begin()[0].cap);
    ASSERT_NE(drawn.begin()[1].cap.plane, nullptr);
    EXPECT_EQ(drawn.begin()[1].cap.plane->normal, (Vec3d{-1, 0, 0}));
}

TEST(Clipper, RoundBodiesCutIntervals) {
    const auto region = [](const RoundBody& body, ClipRegion::Mode mode) { return ClipRegion{{{{}, {body}}}, mode}; };
    const RoundBody ball = RoundBody::ball({50, 5, 5}, 8);
    EXPECT_EQ(intervals({region(ball, ClipRegion::Mode::KeepOnly)}), (List{{42, 58}}));
    EXPECT_EQ(intervals({region(ball, ClipRegion::Mode::CutAway)}), (List{{0, 42}, {58, 100}}));
    EXPECT_EQ(intervals({region(RoundBody::ball({50, 30, 5}, 10), ClipRegion::Mode::KeepOnly)}), (List{}));
    EXPECT_EQ(intervals({region(RoundBody::cylinder({50, 5, 0}, {0, 0, 2}, 16), ClipRegion::Mode::KeepOnly)}),
              (List{{34, 66}}));
    // Along its axis a cylinder has no ends.
    EXPECT_EQ(intervals({region(RoundBody::cylinder({50, 6, 5}, {1, 0, 0}, 2), ClipRegion::Mode::KeepOnly)}),
              (List{{0, 100}}));
    EXPECT_EQ(intervals({region(RoundBody::cylinder({50, 9, 5}, {1, 0, 0}, 2), ClipRegion::Mode::KeepOnly)}), (List{}));
    // The ray runs 4 beside the axis, where the cone is 4 wide 8 beyond its tip.
    const auto cone = [](Vec3d tip, Vec3d axis) { return RoundBody::cone(tip, axis, {0, 0.5, 0}, {0, 0, 0.5}); };
    EXPECT_EQ(intervals({region(cone({20, 9, 5}, {1, 0, 0}), ClipRegion::Mode::KeepOnly)}), (List{{28, 100}}));
    EXPECT_EQ(intervals({region(cone({20, 9, 5}, {-1, 0, 0}), ClipRegion::Mode::KeepOnly)}), (List{{0, 12}}));
    // From its tip, as rays from the eye run through a cutaway.
    EXPECT_EQ(intervals({region(cone({0, 5, 5}, {1, 0, 0}), ClipRegion::Mode::CutAway)}), (List{}));
    EXPECT_EQ(intervals({region(cone({0, 5, 5}, {-1, 0, 0}), ClipRegion::Mode::CutAway)}), (List{{0, 100}}));
}

TEST(Clipper, ARoundStartFacesOutwards) {
    const std::vector<ClipRegion> clips{{{{{}, {RoundBody::ball({50, 5, 11}, 10)}}}, ClipRegion::Mode::KeepOnly}};
    const Clipper clipper(clips, unitGrid());
    const DrawnIntervals drawn = clipper.cut(VoxelRay({0, 5, 5}, {1, 0, 0}), {0, 100});
    ASSERT_EQ(drawn.end() - drawn.begin(), 1);
    EXPECT_DOUBLE_EQ(drawn.begin()->from, 42);
    const Vec3d normal = drawn.begin()->cap.normalAt({42, 5, 5});
    EXPECT_NEAR(length(normal - Vec3d{-0.8, 0, -0.6}), 0, 1e-12);
}

TEST(Clipper, PartsOfARegionAreJoined) {
    const auto part = [](double from, double to) { return ClipRegion::box(slab(from, to), {}).parts[0]; };
    const ClipRegion region{{part(60, 70), part(20, 40), part(35, 50), part(37, 39)}, ClipRegion::Mode::KeepOnly};
    EXPECT_EQ(intervals({region}), (List{{20, 50}, {60, 70}}));
    EXPECT_EQ(intervals({{region.parts, ClipRegion::Mode::CutAway}}), (List{{0, 20}, {50, 60}, {70, 100}}));
    EXPECT_EQ(intervals({region, ClipRegion::box(slab(45, 65), ClipRegion::Mode::CutAway)}),
              (List{{20, 45}, {65, 70}}));
}

RoundBody randomRound(std::mt19937& random) {
    std::uniform_real_distribution<double> coordinate(0, 100), direction(-1, 1), size(5, 40);
    const Vec3d center{coordinate(random), coordinate(random), coordinate(random)};
    const Vec3d axis{direction(random), direction(random), direction(random)};
    switch (random() % 3) {
        case 0: return RoundBody::ball(center, size(random));
        case 1: return RoundBody::cylinder(center, axis, size(random));
        default: break;
    }
    const Vec3d u = normalized(cross(axis, {0, 0, 1}));
    return RoundBody::cone(center, axis, u * (size(random) / 30), normalized(cross(axis, u)) * (size(random) / 30));
}

TEST(Clipper, IntervalsAgreeWithPoints) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> coordinate(0, 100), direction(-1, 1);
    const volume::Grid uneven = *volume::Grid::fromParts({100, 200, 50}, {1, 0.5, 2}, {3, 2, 1},
                                                         {Vec3d{0.8, 0.6, 0}, Vec3d{-0.6, 0.8, 0}, Vec3d{0, 0, 1}});
    int drawnCount = 0;
    for (int round = 0; round < 400; ++round) {
        std::vector<ClipRegion> clips;
        for (int n = 0; n < 3; ++n) {
            ClipRegion region{{}, random() % 3 == 0 ? ClipRegion::Mode::KeepOnly : ClipRegion::Mode::CutAway};
            for (unsigned p = 0; p < 1 + random() % 3; ++p) {
                ConvexPart part;
                for (unsigned plane = 0; plane < random() % 3; ++plane)
                    part.halfSpaces.push_back(
                        {{direction(random), direction(random), direction(random)}, 40 * direction(random)});
                if (part.halfSpaces.empty() || random() % 2 == 0) part.rounds.push_back(randomRound(random));
                region.parts.push_back(part);
            }
            clips.push_back(region);
        }
        const Clipper clipper(clips, round % 2 == 0 ? unitGrid() : uneven);
        const VoxelRay ray({coordinate(random), coordinate(random), coordinate(random)},
                           {direction(random), direction(random), direction(random)});
        const DrawnIntervals drawn = clipper.cut(ray, {0, 100});
        for (int n = 0; n < 50; ++n) {
            const double t = coordinate(random);
            bool isDrawn = false;
            for (const DrawnInterval& interval : drawn) isDrawn = isDrawn || (t >= interval.from && t < interval.to);
            ASSERT_EQ(isDrawn, clipper.keeps(ray.origin + ray.direction * t));
            drawnCount += isDrawn ? 1 : 0;
        }
    }
    EXPECT_GT(drawnCount, 1000);
}

}  // namespace
}  // namespace svt::render
