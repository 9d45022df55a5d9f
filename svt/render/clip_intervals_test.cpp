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
    for (const DrawnInterval& interval : clipper.cut(IndexRay({0, 5, 5}, {1, 0, 0}), {0, 100}))
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
    const DrawnIntervals drawn = clipper.cut(IndexRay({0, 5, 5}, {1, 0, 0}), {0, 100});
    EXPECT_EQ(drawn.begin()[0].capPlane, nullptr);
    ASSERT_NE(drawn.begin()[1].capPlane, nullptr);
    EXPECT_EQ(drawn.begin()[1].capPlane->normal, (Vec3d{-1, 0, 0}));
}

TEST(Clipper, IntervalsAgreeWithPoints) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> coordinate(0, 100), direction(-1, 1);
    for (int round = 0; round < 200; ++round) {
        std::vector<ClipRegion> clips;
        for (int n = 0; n < 4; ++n) {
            ClipRegion region{{}, random() % 3 == 0 ? ClipRegion::Mode::KeepOnly : ClipRegion::Mode::CutAway};
            for (unsigned plane = 0; plane < 1 + random() % 3; ++plane)
                region.halfSpaces.push_back(
                    {{direction(random), direction(random), direction(random)}, 40 * direction(random)});
            clips.push_back(region);
        }
        const Clipper clipper(clips, unitGrid());
        const IndexRay ray({coordinate(random), coordinate(random), coordinate(random)},
                           {direction(random), direction(random), direction(random)});
        const DrawnIntervals drawn = clipper.cut(ray, {0, 100});
        for (int n = 0; n < 50; ++n) {
            const double t = coordinate(random);
            bool isDrawn = false;
            for (const DrawnInterval& interval : drawn) isDrawn = isDrawn || (t >= interval.from && t < interval.to);
            ASSERT_EQ(isDrawn, clipper.keeps(ray.origin + ray.direction * t));
        }
    }
}

}  // namespace
}  // namespace svt::render
