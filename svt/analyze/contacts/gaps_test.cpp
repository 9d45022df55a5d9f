#include <svt/analyze/gaps.hpp>

#include <svt/volume/random_columns_test.hpp>

#include <gtest/gtest.h>

#include <deque>
#include <set>

namespace svt::analyze {
namespace {

volume::LabelTable oneLabelEach(volume::Scalar scalars) {
    volume::LabelTable table;
    for (volume::Scalar s = 1; s < scalars; ++s) {
        volume::Label label;
        label.first = s;
        label.count = 1;
        table.labels.push_back(label);
    }
    return table;
}

TEST(Gaps, AHollowBoxHasOneAndAHoleLetsItOut) {
    const Vec3i n{12, 11, 10};
    std::vector<volume::Scalar> dense;
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) {
                const auto isIn = [&](std::int32_t m) {
                    return i >= m && j >= m && k >= m && i < n.x - m && j < n.y - m && k < n.z - m;
                };
                dense.push_back(isIn(1) && !isIn(3) ? (k < 3 ? 2u : 1u) : 0u);
            }
    const auto gaps = findGaps(volume::ColumnVolume::fromDense(n, dense), oneLabelEach(3));
    ASSERT_EQ(gaps.size(), 1u);
    EXPECT_EQ(gaps[0].voxels, 6u * 5 * 4);
    EXPECT_EQ(gaps[0].box, (SampleBox{{3, 3, 3}, {8, 7, 6}}));
    EXPECT_EQ(gaps[0].around, (std::vector<std::uint32_t>{0, 1}));
    // A way out that is one voxel wide, around a corner.
    for (const std::int32_t i : {1, 2}) dense[std::size_t(i) + 12 * (3 + 11 * 3)] = 0;
    EXPECT_TRUE(findGaps(volume::ColumnVolume::fromDense(n, dense), oneLabelEach(3)).empty());
}

// The same by flooding a dense array.
std::vector<Gap> gapsByFlood(const volume::ColumnVolume& columns, const std::vector<std::uint32_t>& labelOf) {
    const Vec3i n = columns.dimension();
    std::set<Vec3i> seen;
    std::vector<Gap> gaps;
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) {
                if (labelOf[columns.scalarAt(i, j, k)] != volume::kNoLabel || !seen.insert({i, j, k}).second) continue;
                Gap gap;
                std::set<std::uint32_t> around;
                bool isShut = true;
                std::deque<Vec3i> open{{i, j, k}};
                for (; !open.empty(); open.pop_front()) {
                    const Vec3i p = open.front();
                    ++gap.voxels;
                    gap.box.add({p, p});
                    for (int axis = 0; axis < 3; ++axis)
                        for (const int step : {-1, 1}) {
                            Vec3i q = p;
                            q[axis] += step;
                            if (q[axis] < 0 || q[axis] >= n[axis])
                                isShut = false;
                            else if (const auto label = labelOf[columns.scalarAt(q.x, q.y, q.z)];
                                     label != volume::kNoLabel)
                                around.insert(label);
                            else if (seen.insert(q).second)
                                open.push_back(q);
                        }
                }
                gap.around.assign(around.begin(), around.end());
                if (isShut) gaps.push_back(gap);
            }
    return gaps;
}

TEST(Gaps, AreThoseOfAFlood) {
    std::size_t count = 0;
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        // Three quarters filled at random, so that pieces join late and around corners.
        const Vec3i n{23, 19, 17};
        std::vector<volume::Scalar> dense(std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z));
        std::uint32_t state = seed;
        for (volume::Scalar& scalar : dense) {
            state = state * 1664525u + 1013904223u;
            scalar = (state >> 16) % 100 < 55 + 3 * seed ? 1 + (state >> 8) % 5 : 0;
        }
        const volume::ColumnVolume columns = volume::ColumnVolume::fromDense(n, dense);
        volume::LabelTable table = oneLabelEach(6);
        table.labels[2].count = 0;  // scalar 3 belongs to no label
        const std::vector<Gap> gaps = findGaps(columns, table);
        std::vector<Gap> expected = gapsByFlood(columns, table.labelOfScalar());
        count += gaps.size();
        ASSERT_EQ(gaps.size(), expected.size());
        for (std::size_t g = 0; g < gaps.size(); ++g) {
            EXPECT_TRUE(std::find(expected.begin(), expected.end(), gaps[g]) != expected.end()) << g;
            EXPECT_GE(gaps[g == 0 ? 0 : g - 1].voxels, gaps[g].voxels);
        }
    }
    EXPECT_GT(count, 100u);
}

}  // namespace
}  // namespace svt::analyze
