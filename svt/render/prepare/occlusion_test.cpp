#include <svt/render/occlusion.hpp>
#include <svt/render/test_volume_test.hpp>

#include <gtest/gtest.h>

namespace svt::render {
namespace {

using test::makeVolume;
using test::TestVolume;

// Boxes of one label, walls between them, and a corner of mixed voxels.
volume::Scalar scalarAt(std::int32_t i, std::int32_t j, std::int32_t k) {
    if (i < 40 && j < 70 && k < 50) return 1;
    if (i > 60 && (i * 7 + j * 5 + k * 3) % 11 == 0) return 2;
    return j == 75 ? 3 : 0;
}

std::uint32_t count(Vec3i dimension, Vec3i block, std::int32_t size) {
    std::uint32_t voxels = 0;
    for (std::int32_t k = block.z * size; k < std::min((block.z + 1) * size, dimension.z); ++k)
        for (std::int32_t j = block.y * size; j < std::min((block.y + 1) * size, dimension.y); ++j)
            for (std::int32_t i = block.x * size; i < std::min((block.x + 1) * size, dimension.x); ++i)
                voxels += scalarAt(i, j, k) % 2 == 1 ? 1 : 0;  // 2 is no body
    return voxels;
}

TEST(OcclusionField, CountsTheOpaqueVoxelsOfEachBlock) {
    const Vec3i dimension{96, 88, 64};
    const TestVolume volume = makeVolume(dimension, {0.01, 0.01, 0.01}, scalarAt);
    for (const auto& [voxelSize, first] : {std::pair{0.1, 8}, {0.016, 8}, {0.01, 16}, {0.004, 32}, {1e-5, 512}}) {
        const OcclusionField field(
            volume.bricks, voxelSize, [](volume::Scalar scalar) { return scalar % 2 == 1; }, Clipper({}, volume.grid),
            1);
        ASSERT_EQ(field.levels().size(), OcclusionField::kLevels);
        std::int32_t size = first;
        for (const OcclusionField::Level& level : field.levels()) {
            ASSERT_EQ(level.cellSize, size);
            for (std::int32_t z = 0; z < level.count.z; ++z)
                for (std::int32_t y = 0; y < level.count.y; ++y)
                    for (std::int32_t x = 0; x < level.count.x; ++x)
                        ASSERT_EQ(level.voxels[level.at(x, y, z)], count(dimension, {x, y, z}, size))
                            << size << ": " << x << ' ' << y << ' ' << z;
            size *= 2;
        }
    }
}

TEST(OcclusionField, WhatIsCutAwayShadesNothing) {
    const TestVolume volume = makeVolume({64, 64, 64}, {0.1, 0.1, 0.1}, [](auto, auto, auto) { return 1u; });
    const std::vector<ClipRegion> clips{ClipRegion::plane({0, 0, 1}, volume.grid.worldFromIndex({0, 0, 31.5}))};
    const OcclusionField field(
        volume.bricks, 0.1, [](volume::Scalar scalar) { return scalar == 1; }, Clipper(clips, volume.grid), 1);
    const OcclusionField::Level& level = field.levels()[0];
    EXPECT_EQ(level.voxels[level.at(3, 3, 3)] + level.voxels[level.at(3, 3, 4)], 512u);
}

}  // namespace
}  // namespace svt::render
