#include <svt/voxelize/line_heights.hpp>

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace svt::voxelize {
namespace {

TEST(LineHeights, AreThoseOfTheLevelSampleBySample) {
    std::mt19937_64 random(7);
    std::array<std::int32_t, kLineSpace> heights{};
    for (int round = 0; round < 2000; ++round) {
        const auto within = [&](std::int64_t most) {
            return std::uniform_int_distribution<std::int64_t>(-most, most)(random);
        };
        Level level;
        level.lowest = static_cast<std::int32_t>(std::abs(within(200)));
        level.highest = level.lowest + static_cast<std::int32_t>(std::abs(within(4000)));
        const std::int64_t first = within(std::int64_t{6000} << Level::kBits);
        const std::int64_t step = within(std::int64_t{round % 9} << Level::kBits);
        const auto count = static_cast<std::int32_t>(1 + round % int(kLineSamples));
        const std::uint64_t breaks = heightsAlong(level, first, step, count, heights.data());
        std::uint64_t expected = 0;
        for (std::int32_t n = 0; n < count; ++n) {
            ASSERT_EQ(heights[std::size_t(n)], level.clamped(first + n * step)) << "sample " << n << " of " << count;
            if (n > 0 && heights[std::size_t(n)] != heights[std::size_t(n) - 1]) expected |= std::uint64_t{1} << n;
        }
        ASSERT_EQ(breaks, expected);
    }
}

}  // namespace
}  // namespace svt::voxelize
