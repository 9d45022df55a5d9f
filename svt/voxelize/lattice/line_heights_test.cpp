#include <svt/voxelize/lattice/line_heights.hpp>

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <vector>

namespace svt::voxelize {
namespace {

TEST(LineHeights, AreThoseOfTheHeightPlanesSampleBySample) {
    std::mt19937_64 random(7);
    for (int round = 0; round < 2000; ++round) {
        const auto within = [&](std::int64_t most) {
            return std::uniform_int_distribution<std::int64_t>(-most, most)(random);
        };
        std::vector<LineHeightPlane> lines(static_cast<std::size_t>(round % 5));
        std::vector<HeightPlane> heightPlanes;
        for (LineHeightPlane& line : lines) {
            HeightPlane heightPlane;
            heightPlane.lowest = static_cast<std::int32_t>(std::abs(within(200)));
            heightPlane.highest = heightPlane.lowest + static_cast<std::int32_t>(std::abs(within(4000)));
            heightPlanes.push_back(heightPlane);
            line = {within(std::int64_t{6000} << HeightPlane::kBits),
                    within(std::int64_t{round % 9} << HeightPlane::kBits), heightPlane.lowest, heightPlane.highest};
        }
        const auto count = static_cast<std::int32_t>(1 + round % int(kLineSamples));
        std::vector<std::int32_t> numbers((lines.size() + 1) * kLineSamples);
        const std::uint64_t breaks = heightsAlong(lines, count, 5, numbers.data());
        std::uint64_t expected = 0;
        for (std::int32_t n = 0; n < count; ++n) {
            for (std::size_t l = 0; l < lines.size(); ++l) {
                const std::int32_t* height = numbers.data() + (l + 1) * kLineSamples + n;
                ASSERT_EQ(*height, heightPlanes[l].clamped(lines[l].first + n * lines[l].step))
                    << "sample " << n << " of " << count << ", height plane " << l;
                if (n > 0 && height[0] != height[-1]) expected |= std::uint64_t{1} << n;
            }
        }
        ASSERT_EQ(breaks, expected);
    }
}

TEST(LineHeights, HashTellsHeightsApart) {
    // Two height planes, one of which rises by a voxel a sample and one by two: 64 pairs of heights.
    const std::int64_t voxel = std::int64_t{1} << HeightPlane::kBits;
    const LineHeightPlane heightPlanes[2] = {{0, voxel, 0, 1000}, {300 * voxel, 2 * voxel, 0, 1000}};
    std::vector<std::int32_t> line(3 * kLineSamples), again(3 * kLineSamples), other(3 * kLineSamples);
    static_cast<void>(heightsAlong(heightPlanes, 64, 1, line.data()));
    static_cast<void>(heightsAlong(heightPlanes, 64, 1, again.data()));
    static_cast<void>(heightsAlong(heightPlanes, 64, 2, other.data()));
    std::map<std::uint32_t, int> places;  // upper ten bits
    for (std::size_t n = 0; n < kLineSamples; ++n) {
        EXPECT_EQ(line[n], again[n]);
        EXPECT_NE(line[n], other[n]);
        ++places[static_cast<std::uint32_t>(line[n]) >> 22];
    }
    EXPECT_GT(places.size(), 55u);
}

}  // namespace
}  // namespace svt::voxelize
