#include <svt/voxelize/lattice/scan.hpp>

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace svt::voxelize {
namespace {

using Sample = std::pair<std::int32_t, std::int32_t>;

// Even quanta, as vertices are.
QuantaPoint corner(std::int64_t x, std::int64_t y, std::int64_t z = 0) {
    return {std::int32_t(2 * x), std::int32_t(2 * y), std::int32_t(2 * z)};
}

// Samples that a triangle covers, by scanning.
std::map<Sample, int> scanned(const QuantaPoint& a, const QuantaPoint& b, const QuantaPoint& c) {
    std::map<Sample, int> samples;
    ScanTriangle triangle;
    if (!setUpScan(a, b, c, kScanAxes[2], triangle)) return samples;
    scanRows(triangle, -1000, 1000, -1000, 1000, [&](std::int32_t j, std::int32_t begin, std::int32_t end) {
        for (std::int32_t i = begin; i < end; ++i) samples[{i, j}] += 1;
    });
    return samples;
}

// The same by three edge functions at sample (512 i + 1, 512 j + 1); an even vertex makes no zero on axis-parallel
// edges.
bool isInside(const QuantaPoint& a, const QuantaPoint& b, const QuantaPoint& c, Sample at, bool& isOnEdge) {
    const std::int64_t x = std::int64_t(at.first) * kQuanta + 1, y = std::int64_t(at.second) * kQuanta + 1;
    const auto side = [&](const QuantaPoint& p, const QuantaPoint& q) {
        return (std::int64_t(q[0]) - p[0]) * (y - p[1]) - (std::int64_t(q[1]) - p[1]) * (x - p[0]);
    };
    const std::int64_t s[3] = {side(a, b), side(b, c), side(c, a)};
    isOnEdge = s[0] == 0 || s[1] == 0 || s[2] == 0;
    return (s[0] > 0 && s[1] > 0 && s[2] > 0) || (s[0] < 0 && s[1] < 0 && s[2] < 0);
}

TEST(ScanRows, CoversExactlyTheSamplesInside) {
    std::mt19937_64 random(5);
    std::uniform_int_distribution<int> uniform(-256, 256 * 13);
    for (int n = 0; n < 500; ++n) {
        const QuantaPoint a = corner(uniform(random), uniform(random)), b = corner(uniform(random), uniform(random)),
                          c = corner(uniform(random), uniform(random));
        const auto samples = scanned(a, b, c);
        for (std::int32_t j = -2; j < 15; ++j)
            for (std::int32_t i = -2; i < 15; ++i) {
                bool isOnEdge = false;
                const bool expected = isInside(a, b, c, {i, j}, isOnEdge);
                if (isOnEdge) continue;
                ASSERT_EQ(samples.count({i, j}) != 0, expected) << n << ": " << i << ' ' << j;
            }
    }
}

TEST(ScanRows, FanAroundAPointCoversEverySampleOnce) {
    // Whatever the point in the middle, also on sample lines and edges through samples.
    std::mt19937_64 random(6);
    std::uniform_int_distribution<int> uniform(100, 256 * 11);
    const std::vector<QuantaPoint> rim{corner(-10, -10),           corner(1500, -200),        corner(256 * 12 + 7, 0),
                                       corner(256 * 12, 256 * 12), corner(700, 256 * 13 + 3), corner(-90, 256 * 11)};
    std::map<Sample, int> whole;
    for (int n = 0; n < 200; ++n) {
        const QuantaPoint middle = corner(uniform(random), uniform(random));
        std::map<Sample, int> covered;
        for (std::size_t r = 0; r < rim.size(); ++r)
            for (const auto& [sample, count] : scanned(middle, rim[r], rim[(r + 1) % rim.size()]))
                covered[sample] += count;
        for (const auto& [sample, count] : covered)
            ASSERT_EQ(count, 1) << n << ": " << sample.first << ' ' << sample.second;
        if (n == 0) whole = covered;
        ASSERT_EQ(covered, whole) << n;
    }
    EXPECT_GT(whole.size(), 120u);
}

TEST(SetUpScan, TriangleThatMeetsNoSampleLineIsNone) {
    ScanTriangle triangle;
    EXPECT_FALSE(setUpScan(corner(10, 10), corner(200, 10), corner(10, 200), kScanAxes[2], triangle));  // between lines
    EXPECT_FALSE(setUpScan(corner(0, 0), corner(500, 500), corner(1000, 1000), kScanAxes[2], triangle));  // upright
}

TEST(SetUpScan, SignTellsWhichWayTheFaceLooks) {
    ScanTriangle up, down;
    ASSERT_TRUE(setUpScan(corner(0, 0), corner(1000, 0), corner(0, 1000), kScanAxes[2], up));
    ASSERT_TRUE(setUpScan(corner(0, 0), corner(0, 1000), corner(1000, 0), kScanAxes[2], down));
    EXPECT_EQ(up.sign, -1);
    EXPECT_EQ(down.sign, 1);
    // The same for lines along x and y: a face that looks along the axis ends the solid.
    ScanTriangle east, north;
    ASSERT_TRUE(setUpScan({0, 0, 0}, {0, 2000, 0}, {0, 0, 2000}, kScanAxes[0], east));
    ASSERT_TRUE(setUpScan({0, 0, 0}, {0, 0, 2000}, {2000, 0, 0}, kScanAxes[1], north));
    EXPECT_EQ(east.sign, -1);
    EXPECT_EQ(north.sign, -1);
}

TEST(SampleAbove, IsTheFirstSampleOverTheFace) {
    ScanTriangle flat;
    ASSERT_TRUE(setUpScan(corner(0, 0, 640), corner(2000, 0, 640), corner(0, 2000, 640), kScanAxes[2], flat));
    EXPECT_TRUE(flat.height.isFlat());
    EXPECT_EQ(sampleAbove(flat, flat.height.base), 3);  // 1280 quanta are 2.5 voxels
    ScanTriangle slope;                                 // one voxel up for two along
    ASSERT_TRUE(setUpScan(corner(0, 0, 0), corner(256 * 20, 0, 256 * 10), corner(0, 256 * 20, 0), kScanAxes[2], slope));
    for (std::int32_t i = 1; i < 10; ++i)
        EXPECT_EQ(sampleAbove(slope, slope.height.base + slope.height.slopeX * i), i / 2 + (i % 2 == 0 ? 0 : 1)) << i;
}

TEST(FirstSampleAbove, EvenCoordinatesMeetNoSample) {
    EXPECT_EQ(firstSampleAbove(0), 0);  // sample 0 stands at 1
    EXPECT_EQ(firstSampleAbove(2), 1);  // sample 1 at 513
    EXPECT_EQ(firstSampleAbove(512), 1);
    EXPECT_EQ(firstSampleAbove(514), 2);
    EXPECT_EQ(firstSampleAbove(-510), 0);
    EXPECT_EQ(firstSampleAbove(-512), -1);
}

}  // namespace
}  // namespace svt::voxelize
