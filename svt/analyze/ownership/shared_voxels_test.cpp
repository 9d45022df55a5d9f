#include <svt/analyze/shared_voxels.hpp>

#include <svt/volume/random_columns_test.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <map>

namespace svt::analyze {
namespace {

volume::SemanticVolume randomVolume(Vec3i n, std::uint32_t seed) {
    volume::SemanticVolume volume = volume::test::emptyVolume(n, {0.1, 0.1, 0.1}, {458877, 5438353, 110});
    volume.columns = volume::test::randomColumns(n, seed);
    for (volume::Scalar s = 1; s < volume::test::kRandomScalars; ++s) volume::test::addObject(volume, "", "");
    return volume;
}

TEST(SharedVoxels, AreThoseOfEveryVoxel) {
    const Vec3i n{130, 70, 23};
    const volume::SemanticVolume first = randomVolume(n, 3), second = randomVolume(n, 4);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> expected;
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) {
                // Scalar 0 gives kNoLabel.
                const std::uint32_t a = first.columns.scalarAt(i, j, k) - 1, b = second.columns.scalarAt(i, j, k) - 1;
                if (a != volume::kNoLabel || b != volume::kNoLabel) ++expected[{a, b}];
            }
    const auto shared = sharedVoxels(first, second, 1);
    ASSERT_TRUE(shared);
    ASSERT_EQ(shared->size(), expected.size());
    std::size_t at = 0;
    for (const auto& [pair, voxels] : expected) {
        EXPECT_EQ((*shared)[at], (SharedVoxels{pair.first, pair.second, voxels}));
        ++at;
    }
    EXPECT_EQ(*sharedVoxels(first, second, 5), *shared);
}

TEST(SharedVoxels, RefuseOtherGrids) {
    const volume::SemanticVolume first = randomVolume({20, 20, 20}, 1);
    volume::SemanticVolume moved = first;
    moved.grid = *volume::Grid::fromParts({20, 20, 20}, {0.1, 0.1, 0.1}, {458877.01, 5438353, 110}, first.grid.axes());
    volume::SemanticVolume wider = first;
    wider.grid = *volume::Grid::fromParts({20, 20, 20}, {0.1, 0.1, 0.1001}, {458877, 5438353, 110}, first.grid.axes());
    for (const volume::SemanticVolume& other : {moved, wider, randomVolume({20, 20, 21}, 1)}) {
        const auto shared = sharedVoxels(first, other);
        ASSERT_FALSE(shared);
        EXPECT_EQ(shared.error().code(), Code::BadArgument);
        EXPECT_NE(shared.error().message().find("--grid-of"), std::string::npos);
    }
}

}  // namespace
}  // namespace svt::analyze
