/// Boxes anywhere between samples: bricks must tell the label of any point, not only of samples.

#include <svt/volume/brick_volume.hpp>
#include <svt/volume/face_planes.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace svt::volume {
namespace {

struct LabelledBox {
    Vec3d min, max;
    Scalar scalar = 0;
    [[nodiscard]] bool contains(Vec3d p) const {
        return p.x > min.x && p.y > min.y && p.z > min.z && p.x < max.x && p.y < max.y && p.z < max.z;
    }
};

// The last box that contains it.
Scalar scalarOf(const std::vector<LabelledBox>& boxes, Vec3d p) {
    Scalar scalar = 0;
    for (const LabelledBox& box : boxes)
        if (box.contains(p)) scalar = box.scalar;
    return scalar;
}

std::vector<FacePlane> facesOf(const std::vector<LabelledBox>& boxes, Vec3i dimension) {
    std::vector<FacePlane> faces;
    for (const LabelledBox& box : boxes)
        for (int axis = 0; axis < 3; ++axis)
            for (const double at : {box.min[axis], box.max[axis]}) {
                FacePlane face;
                face.plane.normal[axis] = 1;
                face.plane.offset = -at;
                for (int n = 0; n < 3; ++n) {
                    const double low = n == axis ? at : box.min[n], high = n == axis ? at : box.max[n];
                    const auto a = static_cast<std::size_t>(n);
                    face.min[a] = static_cast<std::uint16_t>(std::max(std::floor(low), 0.0));
                    face.max[a] = static_cast<std::uint16_t>(
                        std::clamp(std::ceil(high), double(face.min[a]) + 1, double(dimension[n])));
                }
                faces.push_back(face);
            }
    return faces;
}

ColumnVolume columnsOf(const std::vector<LabelledBox>& boxes, Vec3i n) {
    std::vector<Scalar> dense;
    for (int k = 0; k < n.z; ++k)
        for (int j = 0; j < n.y; ++j)
            for (int i = 0; i < n.x; ++i) dense.push_back(scalarOf(boxes, {i + 0.5, j + 0.5, k + 0.5}));
    return ColumnVolume::fromDense(n, dense);
}

// As rays see it.
Scalar scalarAt(const BrickVolume& bricks, Vec3d p) {
    const Vec3i voxel{static_cast<std::int32_t>(p.x), static_cast<std::int32_t>(p.y), static_cast<std::int32_t>(p.z)};
    const auto entry = bricks.entry(voxel.x >> 3, voxel.y >> 3, voxel.z >> 3);
    if (!entry.isCoded()) return bricks.scalarAt(voxel.x, voxel.y, voxel.z);
    const auto& coding = bricks.coding(entry);
    std::size_t side = 0;
    int bit = 0;
    coding.forEachSide([&](int axis, std::uint16_t place) { side |= std::size_t{p[axis] > place} << bit++; },
                       [&](std::uint32_t number) {
                           const BrickPlane& plane = bricks.planes()[number];
                           side |= std::size_t{dot(plane.normal, p) + plane.offset > 0} << bit++;
                       });
    return bricks.sideScalar(coding, side);
}

class Dice {
public:
    explicit Dice(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15ull + 1) {}
    double next(double low, double high) {
        state_ ^= state_ << 13;
        state_ ^= state_ >> 7;
        state_ ^= state_ << 17;
        return low + (high - low) * double(state_ >> 11) * 0x1p-53;
    }

private:
    std::uint64_t state_;
};

// Share of points whose label is not that of the boxes.
double wrongShare(const std::vector<LabelledBox>& boxes, const BrickVolume& bricks, Vec3i n, Dice& dice) {
    int wrong = 0;
    constexpr int kPoints = 100000;
    for (int p = 0; p < kPoints; ++p) {
        const Vec3d point{dice.next(0, n.x), dice.next(0, n.y), dice.next(0, n.z)};
        wrong += scalarAt(bricks, point) != scalarOf(boxes, point) ? 1 : 0;
    }
    return double(wrong) / kPoints;
}

TEST(FaceCuts, ABoxIsItselfWhereverItsFacesLie) {
    const Vec3i n{150, 140, 60};
    Dice dice(7);
    for (int trial = 0; trial < 40; ++trial) {
        LabelledBox box{{}, {}, 5};
        for (int axis = 0; axis < 3; ++axis) {
            // Often just beside the border of bricks, or of tiles of 64 columns.
            const double near = trial % 2 == 0 ? 8 * std::floor(dice.next(1, 3)) : axis < 2 && trial % 3 == 0 ? 64 : 20;
            box.min[axis] = std::max(1.0, near + dice.next(-0.5, 0.5));
            box.max[axis] = std::min(n[axis] - 2.0, box.min[axis] + dice.next(6, 60));
        }
        const ColumnVolume columns = columnsOf({box}, n);
        const auto faces = facesOf({box}, n);
        const auto bricks = *BrickVolume::fromColumns(columns, {.planes = faces});
        const auto plain = *BrickVolume::fromColumns(columns);
        EXPECT_LT(wrongShare({box}, bricks, n, dice), 2e-4) << trial;
        // Without the planes borders are those of voxels.
        EXPECT_GT(wrongShare({box}, plain, n, dice), wrongShare({box}, bricks, n, dice)) << trial;
        for (int k = 0; k < n.z; ++k)
            for (int j = 0; j < n.y; ++j)
                for (int i = 0; i < n.x; ++i) ASSERT_EQ(bricks.scalarAt(i, j, k), columns.scalarAt(i, j, k));
    }
}

TEST(FaceCuts, RoomsAndWallsMeetOnTheirFaces) {
    // Two rooms in a building, a wall between them.
    const Vec3i n{140, 90, 50};
    Dice dice(11);
    double before = 0, after = 0;
    for (int trial = 0; trial < 20; ++trial) {
        const double w = dice.next(5, 8), m = dice.next(50, 70);
        const Vec3d low{dice.next(8, 17), dice.next(8, 17), dice.next(4, 9)},
            high{dice.next(110, 130), dice.next(60, 80), 42.3};
        const std::vector<LabelledBox> boxes{{low, high, 1},
                                             {low + Vec3d{w, w, 3.3}, {m, high.y - w, high.z - 3.7}, 2},
                                             {{m + w, low.y + w, low.z + 3.3}, high - Vec3d{w, w, 3.7}, 3}};
        const ColumnVolume columns = columnsOf(boxes, n);
        const auto faces = facesOf(boxes, n);
        before += wrongShare(boxes, *BrickVolume::fromColumns(columns), n, dice);
        after += wrongShare(boxes, *BrickVolume::fromColumns(columns, {.planes = faces}), n, dice);
    }
    EXPECT_LT(after, 0.03 * before) << before;
}

// At a corner of a shell of four voxels six faces meet in a brick: three planes take the places of cuts.
TEST(FaceCuts, AThinShellKeepsItsFacesInCorners) {
    const Vec3i n{100, 90, 50};
    Dice dice(5);
    std::size_t inCuts = 0;
    for (int trial = 0; trial < 20; ++trial) {
        const double w = dice.next(3, 4.5);
        // Corners in the middle of bricks.
        const Vec3d low{9.5 + dice.next(0, 1), 17.5 + dice.next(0, 1), 9.5 + dice.next(0, 1)},
            high{78.5 - dice.next(0, 1), 70.5 - dice.next(0, 1), 38.5 - dice.next(0, 1)};
        const std::vector<LabelledBox> boxes{{low, high, 1}, {low + Vec3d{w, w, w}, high - Vec3d{w, w, w}, 2}};
        const ColumnVolume columns = columnsOf(boxes, n);
        const auto faces = facesOf(boxes, n);
        const auto bricks = *BrickVolume::fromColumns(columns, {.planes = faces});
        EXPECT_LT(wrongShare(boxes, bricks, n, dice), 1e-4) << trial;
        for (const auto& code : bricks.arrays().codes)
            for (int axis = 0; axis < 3; ++axis) {
                const std::uint32_t plane = code.planeInCut(axis);
                if (plane == BrickVolume::kNoPlane) continue;
                ++inCuts;
                EXPECT_EQ(bricks.planes()[plane].normal[axis], 1);
                EXPECT_FALSE(code.hasCut(axis));
            }
        for (int k = 0; k < n.z; ++k)
            for (int j = 0; j < n.y; ++j)
                for (int i = 0; i < n.x; ++i) ASSERT_EQ(bricks.scalarAt(i, j, k), columns.scalarAt(i, j, k));
    }
    EXPECT_GT(inCuts, 100u);
}

TEST(BoxCoding, KeepsNumbersOfPlanesInCuts) {
    BrickVolume::BoxCoding code;
    code.cut[1] = 77;
    code.cutAxes = 2;
    code.setPlaneInCut(0, 0);
    code.setPlaneInCut(2, BrickVolume::BoxCoding::kMostPlanesInCuts - 1);
    EXPECT_EQ(code.planeInCut(0), 0u);
    EXPECT_EQ(code.planeInCut(1), BrickVolume::kNoPlane);
    EXPECT_EQ(code.planeInCut(2), BrickVolume::BoxCoding::kMostPlanesInCuts - 1);
    std::vector<std::uint32_t> sides;
    code.plane[0] = 9;
    code.forEachSide(
        [&](int axis, std::uint16_t place) {
            sides.insert(sides.end(), {std::uint32_t(axis), place});
        },
        [&](std::uint32_t number) { sides.push_back(number); });
    EXPECT_EQ(sides, (std::vector<std::uint32_t>{0, 1, 77, BrickVolume::BoxCoding::kMostPlanesInCuts - 1, 9}));
}

TEST(FaceBorders, AreFoundByTheirBorderAndNotBeyondTheirFaces) {
    const Vec3i n{64, 64, 64};
    const LabelledBox box{{10.3, 12, 9}, {30.7, 20, 40}, 1};
    const auto faces = facesOf({box}, n);
    const FaceBorders borders({}, n, faces);
    const auto found = borders.find(0, 10, {8, 8, 8});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->normal, (Vec3d{1, 0, 0}));
    EXPECT_NEAR(found->offset, -10.3, 1e-6);
    EXPECT_TRUE(borders.find(0, 31, {24, 8, 8}));   // 30.7 is nearer to 31
    EXPECT_FALSE(borders.find(0, 11, {8, 8, 8}));   // between other samples
    EXPECT_FALSE(borders.find(0, 10, {8, 40, 8}));  // the faces end before this brick
    EXPECT_FALSE(borders.find(1, 10, {8, 8, 8}));
    EXPECT_FALSE(borders.find(0, 900, {8, 8, 8}));
}

}  // namespace
}  // namespace svt::volume
