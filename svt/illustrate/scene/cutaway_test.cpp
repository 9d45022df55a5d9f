#include <svt/illustrate/scene/cutaway.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

namespace svt::illustrate {
namespace {

using analyze::SampleBox;

// 20 x 20 x 3 m of 0.1 m voxels, seen from above at a slant.
class CutawayTest : public ::testing::Test {
protected:
    CutawayTest() {
        grid_ = *volume::Grid::fromParts({200, 200, 30}, {0.1, 0.1, 0.1}, {0, 0, 0},
                                         {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
        camera_.eye = {10, -15, 40};
        camera_.target = {10, 10, 1};
    }
    static SampleBox boxAt(std::int32_t x, std::int32_t y, std::int32_t size) {
        SampleBox box;
        box.min = {x, y, 5};
        box.max = {x + size, y + size, 10};
        return box;
    }
    [[nodiscard]] std::vector<render::ConvexPart> partsOf(std::vector<SampleBox> targets, std::size_t most = 16) const {
        return cutawayParts(camera_, grid_, std::move(targets), 0.15, most);
    }
    static bool contains(const render::ConvexPart& part, Vec3d p) {
        return std::all_of(part.rounds.begin(), part.rounds.end(),
                           [&](const auto& round) { return round.contains(p); }) &&
               std::all_of(part.halfSpaces.begin(), part.halfSpaces.end(),
                           [&](const auto& half) { return dot(half.normal, p) + half.offset > 0; });
    }
    static int countOf(const std::vector<render::ConvexPart>& parts, Vec3d p) {
        return static_cast<int>(
            std::count_if(parts.begin(), parts.end(), [&](const auto& part) { return contains(part, p); }));
    }
    volume::Grid grid_;
    render::Camera camera_;
};

TEST_F(CutawayTest, OneTargetHasTheBodyThatItAlwaysHad) {
    const auto parts = partsOf({boxAt(20, 20, 10)});
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_TRUE(parts[0].halfSpaces.empty());
    EXPECT_EQ(parts[0].rounds[0], cutawayBody(camera_, grid_, boxAt(20, 20, 10), 0.15));
}

TEST_F(CutawayTest, FarTargetsHaveOneEach) {
    const std::vector<SampleBox> targets{boxAt(20, 20, 10), boxAt(170, 20, 10), boxAt(20, 170, 10)};
    const auto parts = partsOf(targets);
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_EQ(countOf(parts, {10, 10, 2.9}), 0) << "nothing is cut away between them";
    for (std::size_t n = 0; n < targets.size(); ++n)
        EXPECT_TRUE(contains(parts[n], grid_.worldFromIndex(toDouble(targets[n].min))));
}

TEST_F(CutawayTest, TargetsInEachOthersOpeningShareIt) {
    const auto parts = partsOf({boxAt(20, 20, 10), boxAt(27, 20, 10), boxAt(170, 170, 10)});
    ASSERT_EQ(parts.size(), 2u);
    for (const double x : {2.1, 2.9, 3.6}) EXPECT_TRUE(contains(parts[0], {x, 2.5, 0.8})) << x;
}

// Targets in a row, whose widest openings would meet: they open less, until they are apart.
TEST_F(CutawayTest, NeighboursOpenLess) {
    const std::vector<SampleBox> targets{boxAt(60, 60, 6), boxAt(80, 60, 6), boxAt(100, 60, 6)};
    const auto parts = partsOf(targets);
    ASSERT_EQ(parts.size(), 3u);
    for (double x = 0; x < 20; x += 0.1)
        for (double y = 0; y < 20; y += 0.1)
            for (const double z : {0.5, 1.5, 2.9})
                ASSERT_LE(countOf(parts, {x, y, z}), 1) << x << ", " << y << ", " << z;
    for (const auto& target : targets) {
        EXPECT_EQ(countOf(parts, grid_.worldFromIndex(toDouble(target.min))), 1);
        // And what is before them is cut away: 2 m nearer to the eye.
        const Vec3d middle = grid_.worldFromIndex((toDouble(target.min) + toDouble(target.max)) * 0.5);
        EXPECT_EQ(countOf(parts, middle + normalized(camera_.eye - middle) * 2.0), 1);
    }
}

// Targets anywhere, also one behind the other: where openings crossed, what stays between them would hang in the air.
TEST_F(CutawayTest, NoTwoOpeningsMeetWhereverTheTargetsAre) {
    std::uint32_t state = 7;
    const auto next = [&](std::int32_t below) {
        state = state * 1664525u + 1013904223u;
        return static_cast<std::int32_t>(state >> 8) % below;
    };
    camera_.eye = {10, -30, 8};
    for (int round = 0; round < 12; ++round) {
        std::vector<SampleBox> targets;
        for (int n = 0; n < 3 + round % 5; ++n) targets.push_back(boxAt(20 + next(150), 20 + next(150), 4 + next(12)));
        const auto parts = partsOf(targets);
        for (double x = 0.25; x < 20; x += 0.5)
            for (double y = 0.25; y < 20; y += 0.5)
                for (double z = 0.25; z < 3; z += 0.5)
                    ASSERT_LE(countOf(parts, {x, y, z}), 1) << round << ": " << x << ", " << y << ", " << z;
        for (const auto& target : targets)
            EXPECT_EQ(countOf(parts, grid_.worldFromIndex((toDouble(target.min) + toDouble(target.max)) * 0.5)), 1);
    }
}

// Many targets all over the place, on a floor of 0.5 m that carries them: before them all is cut away, but neither the floor
// below and beside them nor what is behind.
TEST_F(CutawayTest, AGroupKeepsWhatCarriesItAndWhatIsBehind) {
    std::vector<SampleBox> targets;
    for (std::int32_t n = 0; n < 80; ++n) targets.push_back(boxAt(30 + 7 * (n % 10), 60 + 7 * (n / 10), 6));
    const auto parts = partsOf(targets);
    ASSERT_EQ(parts.size(), 1u);
    for (const auto& target : targets)
        EXPECT_TRUE(contains(parts[0], grid_.worldFromIndex((toDouble(target.min) + toDouble(target.max)) * 0.5)));
    EXPECT_TRUE(contains(parts[0], {6, 9, 2.9})) << "a roof over them";
    EXPECT_FALSE(contains(parts[0], {6, 9, 0.45})) << "the floor below them, up to its surface";
    EXPECT_FALSE(contains(parts[0], {6, 9, 0.2})) << "the floor below them";
    EXPECT_FALSE(contains(parts[0], {6, 3, 0.2})) << "the floor before them";
    EXPECT_FALSE(contains(parts[0], {6, 14, 0.8})) << "what is behind them";
    EXPECT_FALSE(contains(parts[0], {15, 9, 0.8})) << "what is beside them";
}

TEST_F(CutawayTest, ThereAreNoMoreThanAskedFor) {
    EXPECT_EQ(partsOf({boxAt(20, 20, 10), boxAt(170, 20, 10), boxAt(20, 170, 10)}, 2).size(), 2u);
    EXPECT_EQ(partsOf({boxAt(20, 20, 10), boxAt(170, 20, 10), boxAt(20, 170, 10)}, 1).size(), 1u);
    EXPECT_EQ(partsOf(std::vector<SampleBox>(1000, boxAt(20, 20, 10))).size(), 1u);
}

}  // namespace
}  // namespace svt::illustrate
