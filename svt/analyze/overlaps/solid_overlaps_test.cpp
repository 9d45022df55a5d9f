/// Overlaps of solids whose common volume is known: boxes, wedges, turned boxes; thinner than any voxel, touching, doubled.

#include <svt/analyze/solid_overlaps.hpp>
#include <svt/plane/common_volume.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace svt::analyze {
namespace {

// A volume of solids with meshes, 1 m voxels without labels.
struct Solids {
    volume::SemanticVolume volume = volume::test::emptyVolume({3, 3, 3}, {1, 1, 1}, {500000, 5400000, 100});

    std::uint32_t addLabel(const std::string& id, double size) {
        volume::Label& label = volume::test::addObject(volume, id, "BuildingConstructiveElement");
        label.filling = volume::Filling::Solid;
        label.volume = size;
        return label.subtreeEnd - 1;
    }

    void addTriangle(std::uint32_t label, const std::array<Vec3d, 3>& corners) {
        volume::VectorParts::Triangle triangle{label, {}};
        for (std::size_t n = 0; n < 3; ++n) triangle.corners[n] = volume::test::addPoint(volume, corners[n]);
        volume.vectors.triangles.push_back(triangle);
    }

    // A box whose corners are moved by `place`; its sides are split along the other diagonal where `other` says so.
    template <class Place>
    void addBox(const std::string& id, Vec3d low, Vec3d high, bool other, const Place& place) {
        const Vec3d size = high - low;
        const std::uint32_t label = addLabel(id, size.x * size.y * size.z);
        const auto corner = [&](int n) {
            return place({(n & 1) != 0 ? high.x : low.x, (n & 2) != 0 ? high.y : low.y, (n & 4) != 0 ? high.z : low.z});
        };
        for (const auto& side : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                                 std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
            const std::size_t first = other ? 1 : 0;
            for (const std::size_t n : {first + 1, first + 2})
                addTriangle(label, {corner(side[first]), corner(side[n % 4]), corner(side[(n + 1) % 4])});
        }
    }
    void addBox(const std::string& id, Vec3d low, Vec3d high, bool other = false) {
        addBox(id, low, high, other, [](Vec3d p) { return p; });
    }
};

TEST(SolidOverlaps, BoxesThatOverlapByAMillimetre) {
    Solids solids;
    solids.addBox("a", {0, 0, 0}, {2, 3, 1});
    solids.addBox("b", {1.999, 1, 0.5}, {5, 9, 4}, true);
    const auto overlaps = solidOverlaps(solids.volume).pairs;
    ASSERT_EQ(overlaps.size(), 1u);
    EXPECT_EQ(overlaps[0].a, 0u) << "the smaller one has it";
    EXPECT_EQ(overlaps[0].b, 1u);
    EXPECT_EQ(overlaps[0].voxels, 0u);
    EXPECT_TRUE(overlaps[0].isExact);
    EXPECT_NEAR(overlaps[0].volume, 0.001 * 2 * 0.5, overlaps[0].bound);
    EXPECT_LT(overlaps[0].bound, 2e-5);
}

TEST(SolidOverlaps, BoxesThatTouchDoNotOverlap) {
    Solids solids;
    solids.addBox("a", {0, 0, 0}, {2, 3, 1});
    solids.addBox("beside", {2, 0, 0}, {4, 3, 1}, true);
    solids.addBox("above", {0.3, 0.2, 1}, {4, 3, 2});
    solids.addBox("edge", {2, 3, 0}, {4, 5, 1});
    EXPECT_TRUE(solidOverlaps(solids.volume).pairs.empty());
}

TEST(SolidOverlaps, DoubledSolidsOverlapWholly) {
    Solids solids;
    // Thinner than a voxel, and turned, so that no face is along an axis.
    const double turn = 0.3;
    const auto place = [&](Vec3d p) {
        const Vec3d q{p.x * std::cos(turn) - p.z * std::sin(turn), p.y, p.x * std::sin(turn) + p.z * std::cos(turn)};
        return Vec3d{q.x * std::cos(turn) - q.y * std::sin(turn), q.x * std::sin(turn) + q.y * std::cos(turn), q.z};
    };
    solids.addBox("pane", {0.2, 0.1, 0.3}, {1.4, 0.14, 2.3}, false, place);
    solids.addBox("again", {0.2, 0.1, 0.3}, {1.4, 0.14, 2.3}, true, place);
    const auto overlaps = solidOverlaps(solids.volume).pairs;
    ASSERT_EQ(overlaps.size(), 1u);
    EXPECT_NEAR(overlaps[0].volume, 1.2 * 0.04 * 2, overlaps[0].bound);
    EXPECT_NEAR(overlaps[0].volume, 1.2 * 0.04 * 2, 2e-5);
}

TEST(SolidOverlaps, ABoxTurnedByAnEighthMeetsItsLikeInAnOctagon) {
    Solids solids;
    solids.addBox("a", {-1, -1, 0}, {1, 1, 1});
    solids.addBox("b", {-1, -1, 0.25}, {1, 1, 0.75}, false, [](Vec3d p) {
        return Vec3d{(p.x - p.y) * std::numbers::sqrt2 / 2, (p.x + p.y) * std::numbers::sqrt2 / 2, p.z};
    });
    const auto overlaps = solidOverlaps(solids.volume).pairs;
    ASSERT_EQ(overlaps.size(), 1u);
    EXPECT_NEAR(overlaps[0].volume, 8 * (std::numbers::sqrt2 - 1) * 0.5, overlaps[0].bound);
}

// A wedge under the plane z = x / 2 through a box: planes cross within the overlap.
TEST(SolidOverlaps, ARoofThroughABox) {
    Solids solids;
    solids.addBox("box", {0, 0, 0.5}, {4, 2, 1.5});
    solids.addBox("wedge", {0, 0, 0}, {4, 2, 1}, false, [](Vec3d p) { return Vec3d{p.x, p.y, p.z * p.x / 2}; });
    const auto overlaps = solidOverlaps(solids.volume).pairs;
    ASSERT_EQ(overlaps.size(), 1u);
    // Over x: from 1 to 3 it rises from 0 to 1, then the box is full.
    EXPECT_NEAR(overlaps[0].volume, 2 * (0.5 * 2 + 1), overlaps[0].bound);
}

TEST(SolidOverlaps, WithoutMeshesOrPastTheWorkVoxelsTell) {
    Solids solids;
    solids.addBox("a", {0, 0, 0}, {2, 3, 1});
    solids.addBox("b", {1, 1, 0}, {5, 9, 4});
    solids.volume.labels.overlaps = {{1, 0, 2, false}};
    auto overlaps = solidOverlaps(solids.volume).pairs;
    ASSERT_EQ(overlaps.size(), 1u);
    EXPECT_EQ(overlaps[0].a, 1u) << "as the voxels have it";
    EXPECT_EQ(overlaps[0].voxels, 2u);
    EXPECT_NEAR(overlaps[0].volume, 2, overlaps[0].bound);
    EXPECT_TRUE(overlaps[0].isExact);
    for (const std::uint64_t work : {0u, 1u, 20u, 30u}) {
        const SolidOverlaps found = solidOverlaps(solids.volume, {.work = work});
        EXPECT_FALSE(found.isComplete) << work;
        overlaps = found.pairs;
        ASSERT_EQ(overlaps.size(), 1u);
        EXPECT_FALSE(overlaps[0].isExact) << work;
        EXPECT_TRUE(std::isinf(overlaps[0].bound)) << work;
    }
    EXPECT_TRUE(solidOverlaps(solids.volume).isComplete);
    EXPECT_EQ(solidOverlaps(solids.volume).withoutMesh, 0u);
    solids.volume.vectors = {};
    EXPECT_EQ(solidOverlaps(solids.volume).withoutMesh, 2u) << "thin overlaps of both are unknown";
    overlaps = solidOverlaps(solids.volume).pairs;
    ASSERT_EQ(overlaps.size(), 1u);
    EXPECT_FALSE(overlaps[0].isExact);
    EXPECT_DOUBLE_EQ(overlaps[0].volume, 2) << "two voxels of a cubic metre";
}

TEST(SolidOverlaps, ComparisonsAreCountedBeforeTheyAreMade) {
    std::vector<plane::RoofTriangle> a, b;
    const auto add = [](std::vector<plane::RoofTriangle>& list, double x) {
        plane::RoofTriangle triangle;
        ASSERT_TRUE(plane::makeRoofTriangle({Vec3d{x, 0, 0}, Vec3d{x + 1, 0, 0}, Vec3d{x, 1, 0}}, triangle));
        list.push_back(triangle);
    };
    for (const double x : {0.0, 0.5, 2.0, 4.0}) add(a, x);
    for (const double x : {1.0, 1.2, 8.0}) add(b, x);
    // 0.5 meets both of 1.0 and 1.2; 2.0 meets 1.2; 0.0 touches only 1.0.
    EXPECT_EQ(plane::comparisons(a, b), 3u);
    plane::RoofTriangle upright;
    EXPECT_FALSE(plane::makeRoofTriangle({Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{1, 0, 1}}, upright));
}

}  // namespace
}  // namespace svt::analyze
