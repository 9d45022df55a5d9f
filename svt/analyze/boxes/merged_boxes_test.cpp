#include <svt/analyze/merged_boxes.hpp>

#include <svt/volume/dense.hpp>
#include <svt/volume/label_table.hpp>
#include <svt/volume/random_columns_test.hpp>

#include <gtest/gtest.h>

#include <numeric>

namespace svt::analyze {
namespace {

using volume::ColumnVolume;
using volume::Scalar;

ColumnVolume filled(Vec3i size, const std::vector<GroupBox>& boxes) {
    std::vector<Scalar> dense(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z), 0);
    for (const GroupBox& b : boxes)
        for (int k = b.box.begin.z; k < b.box.end.z; ++k)
            for (int j = b.box.begin.y; j < b.box.end.y; ++j)
                for (int i = b.box.begin.x; i < b.box.end.x; ++i) {
                    Scalar& at = dense[std::size_t(i) +
                                       std::size_t(size.x) * (std::size_t(j) + std::size_t(size.y) * std::size_t(k))];
                    EXPECT_EQ(at, 0u) << "a voxel in two boxes";
                    at = b.group;
                }
    return ColumnVolume::fromDense(size, dense);
}

// Scalar s is group s, background none.
std::vector<std::uint32_t> ownGroups(std::size_t count) {
    std::vector<std::uint32_t> groups(count);
    std::iota(groups.begin(), groups.end(), 0u);
    groups[0] = volume::kNoLabel;
    return groups;
}

TEST(MergeBoxes, ABoxIsABoxAndAnLIsTwo) {
    const Vec3i size{90, 80, 30};
    const GroupBox box{3, {{10, 20, 5}, {70, 75, 25}}};
    auto boxes = mergeBoxes(filled(size, {box}), ownGroups(4), 10);
    ASSERT_TRUE(boxes);
    EXPECT_EQ(*boxes, std::vector{box});

    const std::vector<GroupBox> corner{{1, {{0, 0, 0}, {90, 10, 30}}}, {1, {{0, 10, 0}, {10, 80, 30}}}};
    boxes = mergeBoxes(filled(size, corner), ownGroups(2), 10);
    ASSERT_TRUE(boxes);
    EXPECT_EQ(*boxes, corner);
}

TEST(MergeBoxes, GroupsJoinScalarsAndLeaveOthersOut) {
    const std::vector<GroupBox> parts{
        {1, {{0, 0, 0}, {9, 9, 4}}}, {2, {{0, 0, 4}, {9, 9, 9}}}, {3, {{9, 0, 0}, {12, 9, 9}}}};
    const ColumnVolume columns = filled({12, 9, 9}, parts);
    const std::vector<std::uint32_t> groups{volume::kNoLabel, 7, 7, volume::kNoLabel};
    const auto boxes = mergeBoxes(columns, groups, 10);
    ASSERT_TRUE(boxes);
    EXPECT_EQ(*boxes, (std::vector<GroupBox>{{7, {{0, 0, 0}, {9, 9, 9}}}}));
}

TEST(MergeBoxes, BoxesHoldEveryVoxelOnceAndNothingElse) {
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        const Vec3i size{70 + int(seed), 66, 40};
        const auto columns = volume::test::randomColumns(size, seed);
        const auto boxes = mergeBoxes(columns, ownGroups(64), 1'000'000);
        ASSERT_TRUE(boxes);
        EXPECT_GT(boxes->size(), 10u);
        EXPECT_EQ(filled(size, *boxes), columns);
        EXPECT_TRUE(std::is_sorted(boxes->begin(), boxes->end(), [](const GroupBox& a, const GroupBox& b) {
            return std::tie(a.group, a.box.begin.z, a.box.begin.y, a.box.begin.x) <
                   std::tie(b.group, b.box.begin.z, b.box.begin.y, b.box.begin.x);
        }));
        const auto tooMany = mergeBoxes(columns, ownGroups(64), boxes->size() - 1);
        ASSERT_FALSE(tooMany);
        EXPECT_EQ(tooMany.error().code(), Code::BadArgument);
    }
}

}  // namespace
}  // namespace svt::analyze
