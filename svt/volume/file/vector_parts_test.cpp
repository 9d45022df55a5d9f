#include <svt/volume/vector_parts.hpp>

#include <svt/volume/file/zstd_frame_test.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>

namespace svt::volume {
namespace {

constexpr std::size_t kLabels = 9;

VectorParts someParts() {
    std::mt19937 random(7);
    VectorParts parts;
    for (int n = 0; n < 200; ++n)
        parts.points.push_back({static_cast<std::int32_t>(random()), static_cast<std::int32_t>(random() % 100000),
                                -static_cast<std::int32_t>(random() % 300)});
    parts.points[3] = {std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max(), 0};
    parts.points[4] = {std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::min(), -1};
    const auto point = [&] { return static_cast<std::uint32_t>(random() % parts.points.size()); };
    for (std::uint32_t n = 0; n < 90; ++n) parts.segments.push_back({n / 10, {point(), point()}});
    for (std::uint32_t n = 0; n < 80; ++n) parts.triangles.push_back({n / 20 + 4, {point(), point(), point()}});
    return parts;
}

void expectRefused(const std::vector<std::byte>& frame, std::string_view reason) {
    const auto parts = readVectorParts(frame, kLabels);
    ASSERT_FALSE(parts) << "accepted, expected: " << reason;
    EXPECT_EQ(parts.error().code(), Code::BadVolume);
    EXPECT_NE(parts.error().message().find(reason), std::string::npos) << parts.error().message();
}

TEST(VectorParts, ComeBackAsWritten) {
    for (const VectorParts& parts : {someParts(), VectorParts()}) {
        const auto frame = compressVectorParts(parts);
        ASSERT_TRUE(frame);
        const auto read = readVectorParts(*frame, kLabels);
        ASSERT_TRUE(read) << read.error().toString();
        EXPECT_EQ(*read, parts);
        EXPECT_EQ(*compressVectorParts(*read), *frame);
    }
}

TEST(VectorParts, UnitsArePowersOfTwo) {
    VectorParts parts;
    parts.points = {{1048576, -5, 1}};
    const Vec3d place = parts.position(0, {458877, 5438353, 100});
    EXPECT_NEAR(place.x, 458878, 1e-9);
    EXPECT_NEAR(place.y, 5438353 - 5 * 0x1p-20, 1e-9);
    EXPECT_NEAR(place.z, 100 + 0x1p-20, 1e-9);
    parts.unit = VectorParts::kCoarsestUnit;
    EXPECT_NEAR(parts.position(0, {}).x, 1024, 1e-9);
    EXPECT_EQ(readVectorParts(*compressVectorParts(parts), kLabels)->unit, VectorParts::kCoarsestUnit);
    for (const double wrong : {1e-4, 0x1p-21, 1.0, 0.0}) {
        parts.unit = wrong;
        EXPECT_FALSE(checkVectorParts(parts, kLabels)) << wrong;
    }
}

// The worked examples of docs/formats/svt.md.
TEST(VectorParts, TheExamplesOfTheFormatRead) {
    VectorParts expected;
    expected.points = {{0, 0, 0}, {1 << 20, 0, 0}, {1 << 20, 1 << 20, 0}};
    expected.segments = {{2, {0, 1}}};
    expected.triangles = {{0, {0, 1, 2}}};
    const auto parts = readVectorParts(test::zstdFrameOf({20,   3,    1,    1, 0, 0x80, 0x80, 0x80, 0x01, 0, 0, 0, 0x80,
                                                          0x80, 0x80, 0x01, 0, 0, 0,    2,    0,    0,    0, 0, 0, 0}),
                                       kLabels);
    ASSERT_TRUE(parts) << parts.error().toString();
    EXPECT_EQ(*parts, expected);
    const auto old = readTenthParts(
        test::zstdFrameOf({3, 1, 1, 0, 0, 0, 0xA0, 0x9C, 0x01, 0, 0, 0, 0xA0, 0x9C, 0x01, 0, 2, 0, 2, 0, 0, 2, 2}),
        kLabels);
    ASSERT_TRUE(old) << old.error().toString();
    EXPECT_EQ(*old, expected);
}

TEST(VectorParts, DamagedOnesAreRefused) {
    expectRefused({}, "not a zstd frame");
    expectRefused(std::vector<std::byte>(40, std::byte{7}), "not a zstd frame");
    expectRefused(test::zstdFrameOf({}), "do not fit in");
    expectRefused(test::zstdFrameOf({9, 0, 0, 0}), "the unit 2^-9 m");
    expectRefused(test::zstdFrameOf({21, 0, 0, 0}), "the unit 2^-21 m");
    expectRefused(test::zstdFrameOf({0xFF, 0xFF, 0xFF, 0xFF, 0x0F, 0, 0, 0}), "the unit 2^-4294967295 m");
    expectRefused(test::zstdFrameOf({20, 1, 0, 0, 2, 2}), "do not fit in 2 bytes");
    expectRefused(test::zstdFrameOf({20, 0xFF, 0xFF, 0xFF, 0xFF, 0x0F, 0, 0, 1}), "do not fit in");
    expectRefused(test::zstdFrameOf({20, 1, 0, 0, 2, 2, 2, 2}), "1 bytes are left over");
    expectRefused(test::zstdFrameOf({20, 1, 0, 0, 2, 2, 0x80}), "cut short");
    expectRefused(test::zstdFrameOf({20, 1, 0, 0, 0xFF, 0xFF, 0xFF, 0xFF, 0x7F, 0, 0}), "longer than 32 bits");
    expectRefused(test::zstdFrameOf({20, 1, 1, 0, 0, 0, 0, 9, 0, 2}), "segment 0 is of label 9, there are 9");
    expectRefused(test::zstdFrameOf({20, 1, 1, 0, 0, 0, 0, 1, 0, 0}), "segment 0 uses point 1, there are 1");
    expectRefused(test::zstdFrameOf({20, 1, 0, 1, 0, 0, 0, 1, 2, 0, 0}), "triangle 0 uses point 4294967295");
    // 3, then a difference that wraps around to 2.
    expectRefused(test::zstdFrameOf({20, 1, 2, 0, 0, 0, 0, 3, 0xFF, 0xFF, 0xFF, 0xFF, 0x0F, 0, 2, 2, 2}),
                  "out of the order");
    std::vector<std::uint8_t> zeros(std::size_t{64} << 20, 0);
    expectRefused(test::zstdFrameOf(zeros), "are possible");
}

TEST(VectorParts, AnyDamageIsToldOrReadsAsParts) {
    const auto frame = compressVectorParts(someParts());
    ASSERT_TRUE(frame);
    std::mt19937 random(3);
    for (int round = 0; round < 2000; ++round) {
        auto damaged = *frame;
        damaged[random() % damaged.size()] = static_cast<std::byte>(random());
        if (round % 5 == 0) damaged.resize(random() % damaged.size());
        const auto parts = readVectorParts(damaged, kLabels);
        if (parts) {
            EXPECT_TRUE(checkVectorParts(*parts, kLabels));
        }
    }
}

TEST(VectorParts, TrianglesOfALabelHaveADigest) {
    VectorParts parts;
    parts.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
    parts.triangles = {{1, {0, 1, 2}}, {3, {1, 2, 0}}, {3, {0, 1, 3}}, {4, {0, 2, 1}}};
    EXPECT_TRUE(trianglesOf(parts, 0).empty());
    EXPECT_EQ(trianglesOf(parts, 1).size(), 1u);
    EXPECT_EQ(trianglesOf(parts, 3).data(), parts.triangles.data() + 1);
    EXPECT_EQ(trianglesOf(parts, 3).size(), 2u);
    EXPECT_EQ(trianglesOf(parts, 4).size(), 1u);
    EXPECT_TRUE(trianglesOf(parts, 5).empty());
    const auto digest = [&](std::size_t t, std::uint64_t seed) { return digestOf(parts, parts.triangles[t], seed); };
    EXPECT_EQ(digest(0, 1), digest(1, 1)) << "another first corner";
    EXPECT_NE(digest(0, 1), digest(2, 1));
    EXPECT_NE(digest(0, 1), digest(3, 1)) << "another orientation";
    EXPECT_NE(digest(0, 1), digest(0, 2));
}

}  // namespace
}  // namespace svt::volume
