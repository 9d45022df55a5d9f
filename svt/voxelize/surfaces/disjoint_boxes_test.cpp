#include <svt/voxelize/surfaces/disjoint_boxes.hpp>

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <tuple>

namespace svt::voxelize {
namespace {

using Voxel = std::tuple<std::int32_t, std::int32_t, std::int32_t>;

// How many of the boxes hold each voxel.
std::map<Voxel, int> countVoxels(const std::vector<ClaimedBox>& boxes) {
    std::map<Voxel, int> counts;
    for (const ClaimedBox& box : boxes)
        for (std::int32_t j = box.firstRow; j < box.endRow; ++j)
            for (std::int32_t i = box.begin; i < box.end; ++i)
                for (std::int32_t k = box.low; k < box.high; ++k) ++counts[{i, j, k}];
    return counts;
}

TEST(DisjointBoxes, HoldEachVoxelOnce) {
    std::mt19937 random(3);
    for (int round = 0; round < 200; ++round) {
        const auto number = [&](std::int32_t from, std::int32_t to) {
            return std::uniform_int_distribution<std::int32_t>(from, to)(random);
        };
        std::vector<ClaimedBox> boxes;
        for (int b = number(0, 40); b > 0; --b) {
            const std::int32_t j = number(0, 5), i = number(0, 8), k = number(0, 8);
            boxes.push_back({j, j + 1, i, i + number(1, 4), k, k + number(1, 8), 7});
        }
        std::vector<ClaimedBox> disjoint;
        const std::uint64_t voxels = addDisjoint(boxes, disjoint);
        const auto expected = countVoxels(boxes), counts = countVoxels(disjoint);
        EXPECT_EQ(voxels, expected.size());
        ASSERT_EQ(counts.size(), expected.size());
        for (const auto& [voxel, count] : counts) {
            EXPECT_EQ(count, 1);
            EXPECT_TRUE(expected.contains(voxel));
        }
        for (const ClaimedBox& box : disjoint) EXPECT_EQ(box.claim, 7u);
    }
}

TEST(DisjointBoxes, AWallOfManyRowsIsOneBox) {
    // Rows of a wall, each in pieces that overlap: of one run within another, side by side, and end to end.
    std::vector<ClaimedBox> boxes, disjoint;
    for (std::int32_t j = 10; j < 20; ++j) {
        boxes.push_back({j, j + 1, 4, 6, 0, 65'535, 1});
        boxes.push_back({j, j + 1, 5, 7, 3, 9, 1});
        boxes.push_back({j, j + 1, 6, 8, 0, 9, 1});
        boxes.push_back({j, j + 1, 6, 8, 9, 65'535, 1});
    }
    EXPECT_EQ(addDisjoint(boxes, disjoint), std::uint64_t{10} * 4 * 65'535);
    ASSERT_EQ(disjoint.size(), 1u);
    EXPECT_EQ(std::tie(disjoint[0].firstRow, disjoint[0].endRow, disjoint[0].begin, disjoint[0].end),
              std::make_tuple(10, 20, 4, 8));
    EXPECT_EQ(std::tie(disjoint[0].low, disjoint[0].high), std::make_tuple(0, 65'535));
}

}  // namespace
}  // namespace svt::voxelize
