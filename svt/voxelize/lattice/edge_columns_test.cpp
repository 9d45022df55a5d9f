#include <svt/voxelize/lattice/edge_columns.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>

namespace svt::voxelize {
namespace {

// The walk, row by row.
void expectRowsOfWalk(EdgeWalk walk, std::int32_t firstColumn, std::int32_t width, std::int32_t count) {
    std::array<std::uint8_t, kEdgeSpace> columns{};
    const EdgeRows rows = edgeColumns(walk, firstColumn, width, count, columns.data());
    std::int64_t previous = 0;
    for (std::int32_t row = 0; row < count; ++row, walk.nextRow()) {
        const std::int64_t column = walk.sample() - firstColumn;
        const bool isWithin = column > 0 && column < width;
        ASSERT_EQ(rows.west >> row & 1, column <= 0 ? 1u : 0u) << "row " << row << " of " << count;
        ASSERT_EQ(rows.within >> row & 1, isWithin ? 1u : 0u) << "row " << row << " of " << count;
        if (isWithin) {
            ASSERT_EQ(columns[std::size_t(row)], column) << "row " << row << " of " << count;
        }
        if (row > 0) {
            ASSERT_EQ(rows.moves >> row & 1, column != previous ? 1u : 0u) << "row " << row << " of " << count;
        }
        previous = column;
    }
    const std::uint64_t beyond = count < 64 ? ~std::uint64_t{0} << count : 0;
    EXPECT_EQ((rows.west | rows.within | rows.moves) & beyond, 0u);
}

TEST(EdgeColumns, AreThoseOfTheWalkRowByRow) {
    std::mt19937 random(11);
    int within = 0;
    for (int round = 0; round < 6000; ++round) {
        const auto number = [&](std::int32_t from, std::int32_t to) {
            return std::uniform_int_distribution<std::int32_t>(from, to)(random);
        };
        // Edges as long as a few tiles, steep and flat ones, some over many columns a row; even quanta.
        const std::int32_t reach = std::array{200, 3000, 60'000, 1'000'000}[std::size_t(round % 4)];
        const std::int32_t x0 = 2 * number(0, 20'000), x1 = x0 + 2 * number(-reach, reach);
        const std::int32_t y0 = 2 * number(0, 20'000), y1 = y0 + 2 * number(1, 40'000);
        const auto first = static_cast<std::int32_t>(firstSampleAbove(y0));
        const auto end = static_cast<std::int32_t>(firstSampleAbove(y1));
        if (first >= end) continue;
        const std::int32_t row = number(first, end - 1), count = std::min(64, end - row);
        const std::int32_t width = number(1, 64);
        // A tile that the edge meets, mostly.
        const EdgeWalk walk(x0, y0, x1, y1, row);
        const auto firstColumn = static_cast<std::int32_t>(walk.sample()) - number(-2, width + 1);
        expectRowsOfWalk(walk, firstColumn, width, count);
        within += walk.sample() > firstColumn && walk.sample() < firstColumn + width ? 1 : 0;
    }
    EXPECT_GT(within, 2000);
}

TEST(EdgeColumns, ReachTheEndsOfTheLattice) {
    constexpr std::int32_t kFar = 1 << 28;
    for (const std::int32_t row : {-1000, 0, 31, 500'000}) {
        expectRowsOfWalk(EdgeWalk(-kFar, -kFar, kFar, kFar, row), row, 64, 64);
        expectRowsOfWalk(EdgeWalk(kFar, -kFar, -kFar, kFar, row), -row, 64, 64);
        expectRowsOfWalk(EdgeWalk(kFar, -kFar, kFar - 2, kFar, row), kFar / 512 - 5, 64, 64);
    }
}

}  // namespace
}  // namespace svt::voxelize
