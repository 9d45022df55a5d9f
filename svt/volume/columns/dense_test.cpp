#include <svt/volume/dense.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

namespace svt::volume {
namespace {

std::vector<Scalar> randomScalars(Vec3i dimension, Scalar largest) {
    std::vector<Scalar> scalars(std::size_t(dimension.x) * std::size_t(dimension.y) * std::size_t(dimension.z));
    std::uint32_t state = 7;
    for (Scalar& scalar : scalars) {
        state = state * 1664525u + 1013904223u;
        scalar = (state >> 16) % 4 == 0 ? (state >> 8) % (largest + 1) : 3;
    }
    return scalars;
}

TEST(Dense, ArrayComesBackFromItsColumns) {
    for (const Vec3i dimension : {Vec3i{2, 2, 2}, Vec3i{64, 64, 5}, Vec3i{65, 130, 7}, Vec3i{3, 70, 40}}) {
        const auto scalars = randomScalars(dimension, 255);
        const auto columns = ColumnVolume::fromDense(dimension, scalars);
        const auto dense = toDense<std::uint32_t>(columns);
        ASSERT_TRUE(dense);
        EXPECT_TRUE(*dense == scalars);
        const auto small = toDense<std::uint8_t>(columns);
        ASSERT_TRUE(small);
        EXPECT_TRUE(std::equal(small->begin(), small->end(), scalars.begin(), scalars.end()));
    }
}

TEST(Dense, BoxesJoinToTheWhole) {
    const Vec3i dimension{70, 150, 20};
    const auto columns = ColumnVolume::fromDense(dimension, randomScalars(dimension, 60000));
    const auto whole = toDense<std::uint16_t>(columns);
    ASSERT_TRUE(whole);
    for (const DenseBox box : {DenseBox{0, 150, 3, 11}, DenseBox{64, 128, 19, 20}, DenseBox{60, 131, 5, 6},
                               DenseBox{149, 150, 0, 20}, DenseBox{7, 7, 0, 20}}) {
        const std::size_t rows = std::size_t(box.jEnd - box.jBegin);
        std::vector<std::uint16_t> part(70 * rows * std::size_t(box.kEnd - box.kBegin));
        copyBox<std::uint16_t>(columns, box, part);
        for (std::int32_t k = box.kBegin; k < box.kEnd; ++k)
            for (std::int32_t j = box.jBegin; j < box.jEnd; ++j)
                for (std::int32_t i = 0; i < 70; ++i)
                    ASSERT_EQ(
                        part[std::size_t(i) + 70 * (std::size_t(j - box.jBegin) + rows * std::size_t(k - box.kBegin))],
                        (*whole)[std::size_t(i) + 70 * (std::size_t(j) + 150 * std::size_t(k))]);
    }
}

TEST(Dense, PartOfTheRowsIsThatOfTheWhole) {
    const Vec3i dimension{150, 70, 20};
    const auto columns = ColumnVolume::fromDense(dimension, randomScalars(dimension, 60000));
    const auto whole = toDense<std::uint16_t>(columns);
    ASSERT_TRUE(whole);
    for (const DenseBox box : {DenseBox{0, 70, 0, 20, 3, 11}, DenseBox{60, 66, 5, 18, 63, 129},
                               DenseBox{64, 70, 0, 17, 149, 150}, DenseBox{0, 70, 0, 20, 64, 64},
                               DenseBox{0, 70, 3, 4, 0, 150}, DenseBox{1, 69, 3, 4, 128, DenseBox::kRowEnd}}) {
        const std::int32_t iEnd = box.iEnd == DenseBox::kRowEnd ? 150 : box.iEnd;
        std::vector<std::uint16_t> expected;
        for (std::int32_t k = box.kBegin; k < box.kEnd; ++k)
            for (std::int32_t j = box.jBegin; j < box.jEnd; ++j)
                for (std::int32_t i = box.iBegin; i < iEnd; ++i)
                    expected.push_back((*whole)[std::size_t(i) + 150 * (std::size_t(j) + 70 * std::size_t(k))]);
        std::vector<std::uint16_t> part(expected.size());
        copyBox<std::uint16_t>(columns, box, part);
        EXPECT_TRUE(part == expected) << box.iBegin;
    }
}

TEST(Dense, AnyNumberOfThreadsGivesTheSame) {
    const Vec3i dimension{200, 200, 20};
    const auto columns = ColumnVolume::fromDense(dimension, randomScalars(dimension, 9));
    const auto one = toDense<std::uint8_t>(columns, 1 << 30, 1);
    const auto many = toDense<std::uint8_t>(columns, 1 << 30, 3);
    ASSERT_TRUE(one && many);
    EXPECT_TRUE(*one == *many);
}

TEST(Dense, ScalarThatDoesNotFitIsRefused) {
    const auto columns = ColumnVolume::fromDense({2, 2, 2}, std::vector<Scalar>{0, 0, 0, 256, 0, 0, 0, 0});
    EXPECT_EQ(largestScalar(columns), 256u);
    const auto dense = toDense<std::uint8_t>(columns);
    ASSERT_FALSE(dense);
    EXPECT_EQ(dense.error().code(), Code::BadArgument);
    EXPECT_TRUE(toDense<std::uint16_t>(columns));
}

TEST(Dense, ArrayOverTheLimitIsRefused) {
    const auto columns = ColumnVolume::fromDense({10, 10, 10}, std::vector<Scalar>(1000, 0));
    EXPECT_TRUE(toDense<std::uint8_t>(columns, 1000));
    const auto dense = toDense<std::uint8_t>(columns, 999);
    ASSERT_FALSE(dense);
    EXPECT_EQ(dense.error().code(), Code::GridTooLarge);
}

}  // namespace
}  // namespace svt::volume
