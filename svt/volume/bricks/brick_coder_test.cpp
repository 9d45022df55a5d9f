#include <svt/volume/bricks/brick_coder.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace svt::volume {
namespace {

using LabelAt = std::function<Scalar(std::int32_t, std::int32_t, std::int32_t)>;

// Palette in the order of first use, as bricks have it.
BrickPattern patternOf(const LabelAt& labelAt) {
    BrickPattern pattern;
    std::array<std::uint32_t, 512> index{};
    for (std::int32_t k = 0; k < 8; ++k)
        for (std::int32_t j = 0; j < 8; ++j)
            for (std::int32_t i = 0; i < 8; ++i) {
                const Scalar label = labelAt(i, j, k);
                std::uint32_t at = 0;
                while (at < pattern.palette.size() && pattern.palette[at] != label) ++at;
                if (at == pattern.palette.size()) pattern.palette.push_back(label);
                index[static_cast<std::size_t>(i + 8 * j + 64 * k)] = at;
            }
    for (std::uint32_t plane = 0; plane == 0 || (std::size_t{1} << plane) < pattern.palette.size(); ++plane)
        for (std::size_t k = 0; k < 8; ++k) {
            std::uint64_t word = 0;
            for (std::size_t bit = 0; bit < 64; ++bit)
                word |= std::uint64_t{(index[64 * k + bit] >> plane) & 1u} << bit;
            pattern.bitPlanes.push_back(word);
        }
    return pattern;
}

std::optional<BrickCode> codeByCuts(const BrickPattern& pattern) { return codeBySides(pattern, findChanges(pattern)); }

BrickVolume bricksOf(Vec3i n, const LabelAt& labelAt, BrickFaces faces = BrickFaces::Planes,
                     const std::vector<FacePlane>& planes = {}) {
    std::vector<Scalar> scalars;
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) scalars.push_back(labelAt(i, j, k));
    auto bricks = BrickVolume::fromColumns(ColumnVolume::fromDense(n, scalars), {.faces = faces, .planes = planes});
    EXPECT_TRUE(bricks.hasValue());
    return std::move(*bricks);
}

struct Coded {
    std::size_t mixed = 0, coded = 0, withPlanes = 0;
};

// Every sample of every coded brick must get its scalar from the sides on which it lies.
Coded expectCodesHold(const BrickVolume& bricks) {
    Coded found;
    const Vec3i count = bricks.brickCount(), n = bricks.dimension();
    for (std::int32_t bz = 0; bz < count.z; ++bz)
        for (std::int32_t by = 0; by < count.y; ++by)
            for (std::int32_t bx = 0; bx < count.x; ++bx) {
                const auto entry = bricks.entry(bx, by, bz);
                found.mixed += entry.isMixed() ? 1 : 0;
                if (!entry.isCoded()) continue;
                ++found.coded;
                const auto& coding = bricks.coding(entry);
                found.withPlanes += coding.plane[0] != BrickVolume::kNoPlane ? 1 : 0;
                for (std::int32_t k = 8 * bz; k < std::min(8 * bz + 8, n.z); ++k)
                    for (std::int32_t j = 8 * by; j < std::min(8 * by + 8, n.y); ++j)
                        for (std::int32_t i = 8 * bx; i < std::min(8 * bx + 8, n.x); ++i) {
                            const Vec3i at{i, j, k};
                            std::size_t cell = 0;
                            int bit = 0;
                            coding.forEachSide(
                                [&](int axis, std::uint16_t place) { cell |= std::size_t{at[axis] >= place} << bit++; },
                                [&](std::uint32_t plane) {
                                    const BrickPlane& side = bricks.planes()[plane];
                                    const double value =
                                        dot(side.normal, Vec3d{i + 0.5, j + 0.5, k + 0.5}) + side.offset;
                                    cell |= std::size_t{value > 0} << bit++;
                                });
                            EXPECT_EQ(bricks.sideScalar(coding, cell), bricks.scalarAt(i, j, k))
                                << i << ' ' << j << ' ' << k;
                        }
            }
    return found;
}

TEST(BrickCode, CornerOfABoxIsThreeCuts) {
    const BrickPattern pattern = patternOf([](auto i, auto j, auto k) { return i >= 3 && j >= 5 && k >= 1 ? 7u : 4u; });
    const auto code = codeByCuts(pattern);
    ASSERT_TRUE(code.has_value());
    EXPECT_EQ(code->cut, (std::array<std::uint8_t, 3>{3, 5, 1}));
    EXPECT_EQ(code->sideScalars, (std::vector<Scalar>{4, 4, 4, 4, 4, 4, 4, 7}));
}

TEST(BrickCode, ThreeLabelsInTwoCuts) {
    const BrickPattern pattern = patternOf([](auto i, auto, auto k) { return k < 4 ? 1u : i < 6 ? 2u : 3u; });
    const auto code = codeByCuts(pattern);
    ASSERT_TRUE(code.has_value());
    EXPECT_EQ(code->cut, (std::array<std::uint8_t, 3>{6, 0, 4}));
    EXPECT_EQ(code->sideScalars, (std::vector<Scalar>{1, 1, 2, 3}));
}

TEST(BrickCode, ASlabInsideTheBrickNeedsASideBesideTheCut) {
    const BrickPattern pattern = patternOf([](auto, auto j, auto) { return j >= 2 && j < 5 ? 9u : 0u; });
    EXPECT_FALSE(codeByCuts(pattern).has_value());
    SideMask above{};
    above.fill(~std::uint64_t{0} << (8 * 5));  // j >= 5
    const BrickSide side(above);
    const auto code = codeBySides(pattern, findChanges(pattern), {&side});
    ASSERT_TRUE(code.has_value());
    EXPECT_EQ(code->cut, (std::array<std::uint8_t, 3>{0, 2, 0}));
    EXPECT_EQ(code->sideScalars, (std::vector<Scalar>{0, 9, 0, 0}));
}

TEST(BrickCode, VoxelsInACheckerboardHaveNone) {
    EXPECT_FALSE(codeByCuts(patternOf([](auto i, auto j, auto k) { return Scalar((i + j + k) & 1); })).has_value());
}

TEST(BrickCode, ObliqueHalfSpacesAreCodedAllOverWithTheirNormal) {
    for (const Vec3d direction :
         {Vec3d{0.3, 0.5, 0.8}, Vec3d{0.5, 0.866, 0}, Vec3d{0, 0.5, 0.866}, Vec3d{1, 0.21, -0.4}}) {
        const Vec3d normal = normalized(direction);
        const Vec3i n{72, 80, 64};
        const BrickVolume bricks = bricksOf(n, [&](auto i, auto j, auto k) {
            return dot(normal, Vec3d{i + 0.5, j + 0.5, k + 0.5} - Vec3d{36, 40, 32}) < 0 ? 5u : 0u;
        });
        const Coded found = expectCodesHold(bricks);
        EXPECT_GT(found.mixed, 60u);
        EXPECT_GT(double(found.coded), 0.95 * double(found.mixed));
        for (const BrickPlane& plane : bricks.planes())
            EXPECT_GT(std::abs(dot(plane.normal, normal)), std::cos(5 * 3.14159 / 180));
    }
}

TEST(BrickCode, HoldsWhereSurfacesMeet) {
    // A house turned in plan, with rooms, a slab and a roof.
    const double c = std::cos(0.52), s = std::sin(0.52);
    const BrickVolume bricks = bricksOf({96, 96, 72}, [&](auto i, auto j, auto k) -> Scalar {
        const double x = c * (i - 48) + s * (j - 48), y = c * (j - 48) - s * (i - 48);
        if (std::abs(x) > 34 || std::abs(y) > 26 || k < 3) return 0;
        if (k > 66 - 0.9 * std::abs(y)) return 0;
        if (k > 60 - 0.9 * std::abs(y)) return 1;
        if (std::abs(x) > 28 || std::abs(y) > 20) return 2;
        if (k >= 30 && k < 36) return 3;
        return x < 4 ? 4 : x < 9 ? 2 : 5;
    });
    const Coded found = expectCodesHold(bricks);
    EXPECT_GT(double(found.coded), 0.8 * double(found.mixed));
    EXPECT_GT(found.withPlanes, 300u);
}

TEST(BrickCode, BallsAndVoxelFacesHold) {
    const LabelAt ball = [](auto i, auto j, auto k) {
        return (i - 30) * (i - 30) + (j - 33) * (j - 33) + (k - 29) * (k - 29) < 500 ? 1u : 0u;
    };
    const Coded planes = expectCodesHold(bricksOf({64, 64, 64}, ball));
    EXPECT_GT(planes.coded, 0u);
    const Coded voxels = expectCodesHold(bricksOf({64, 64, 64}, ball, BrickFaces::Voxels));
    EXPECT_EQ(voxels.coded, 0u);
    EXPECT_GT(voxels.mixed, 0u);
}

TEST(BrickCode, AWallAndWhatLiesBesideItShareOneBox) {
    // A wall of 12 voxels through the middle, one tile: one box of coded bricks holds a face of it.
    const BrickVolume bricks = bricksOf({64, 64, 64}, [](auto i, auto, auto) { return i >= 26 && i < 38 ? 1u : 0u; });
    expectCodesHold(bricks);
    EXPECT_EQ(bricks.arrays().boxes.size() - bricks.boxes().size(), 2u);
    const SameLabelBox& face = bricks.codedBox(bricks.entry(3, 2, 5));
    EXPECT_EQ(face.min, (std::array<std::uint16_t, 3>{0, 0, 0}));  // with the air on its left
    EXPECT_EQ(face.max[1], 64);
    EXPECT_EQ(face.max[2], 64);
}

// A plane through a point, with faces all over a volume.
FacePlane faceThrough(Vec3d direction, Vec3d point, Vec3i n) {
    FacePlane face;
    face.plane.normal = normalized(direction);
    face.plane.offset = -dot(face.plane.normal, point);
    face.max = {static_cast<std::uint16_t>(n.x), static_cast<std::uint16_t>(n.y), static_cast<std::uint16_t>(n.z)};
    return face;
}
double heightOver(const FacePlane& face, std::int32_t i, std::int32_t j, std::int32_t k) {
    return dot(face.plane.normal, Vec3d{i + 0.5, j + 0.5, k + 0.5}) + face.plane.offset;
}

TEST(FacesOfTheModel, AreTheOnlyPlanesOfARoof) {
    const Vec3i n{200, 160, 64};
    const FacePlane south = faceThrough({0.02, -0.5, 0.8}, {100.3, 80.2, 60.1}, n);
    const FacePlane north = faceThrough({-0.01, 0.5, 0.8}, {100.3, 80.2, 60.1}, n);
    const LabelAt roof = [&](auto i, auto j, auto k) {
        return heightOver(south, i, j, k) < 0 && heightOver(north, i, j, k) < 0 ? 1u : 0u;
    };
    const BrickVolume fitted = bricksOf(n, roof), known = bricksOf(n, roof, BrickFaces::Planes, {south, north});
    const Coded found = expectCodesHold(known);
    EXPECT_GT(found.withPlanes, 500u);
    for (std::int32_t bz = 0; bz < 8; ++bz)
        for (std::int32_t by = 0; by < 20; ++by)
            for (std::int32_t bx = 0; bx < 25; ++bx)
                EXPECT_TRUE(!known.entry(bx, by, bz).isMixed() || known.entry(bx, by, bz).isCoded());
    EXPECT_EQ(known.planes().size(), 2u);
    for (const BrickPlane& plane : known.planes()) EXPECT_TRUE(plane == south.plane || plane == north.plane);
    EXPECT_GT(fitted.planes().size(), 2u);
    EXPECT_LT(known.arrays().boxes.size(), fitted.arrays().boxes.size());
}

// The label that rays find at a point of a coded brick.
Scalar codedLabelAt(const BrickVolume& bricks, BrickVolume::Entry entry, Vec3d point) {
    std::size_t cell = 0;
    int bit = 0;
    const auto& coding = bricks.coding(entry);
    coding.forEachSide([&](int axis, std::uint16_t place) { cell |= std::size_t{point[axis] >= place} << bit++; },
                       [&](std::uint32_t number) {
                           const BrickPlane& plane = bricks.planes()[number];
                           cell |= std::size_t{dot(plane.normal, point) + plane.offset > 0} << bit++;
                       });
    return bricks.sideScalar(coding, cell);
}

//     -----  the plane of a roof goes on beyond the ridge, where it cuts corners of bricks of air.
//      /\     No ray may find the roof there: it would be a line above the ridge.
TEST(FacesOfTheModel, DoNotGoOnBeyondTheRidge) {
    const Vec3i n{64, 96, 64};
    std::size_t points = 0;
    for (const double shift : {0.0, 1.3, 2.6, 3.9, 5.2, 6.5}) {
        const Vec3d ridge{32, 44.2 + shift, 46.1 + shift};
        const FacePlane south = faceThrough({0.02, -0.35, 0.9}, ridge, n);
        const FacePlane north = faceThrough({-0.01, 0.35, 0.9}, ridge, n);
        const BrickVolume bricks =
            bricksOf(n,
                     [&](auto i, auto j, auto k) {
                         return heightOver(south, i, j, k) < 0 && heightOver(north, i, j, k) < 0 ? 1u : 0u;
                     },
                     BrickFaces::Slopes, {south, north});
        const auto over = [](const FacePlane& face, Vec3d p) { return dot(face.plane.normal, p) + face.plane.offset; };
        for (std::int32_t bz = 0; bz < n.z / 8; ++bz)
            for (std::int32_t by = 0; by < n.y / 8; ++by)
                for (std::int32_t bx = 0; bx < n.x / 8; ++bx) {
                    const auto entry = bricks.entry(bx, by, bz);
                    if (!entry.isCoded()) continue;
                    for (int at = 0; at < 32 * 32 * 32; ++at) {
                        const Vec3d p{8 * bx + (at % 32 + 0.5) / 4, 8 * by + (at / 32 % 32 + 0.5) / 4,
                                      8 * bz + (at / 1024 + 0.5) / 4};
                        if (std::max(over(south, p), over(north, p)) < 0.75) continue;
                        ASSERT_EQ(codedLabelAt(bricks, entry, p), 0u) << p.x << ' ' << p.y << ' ' << p.z;
                        ++points;
                    }
                }
    }
    EXPECT_GT(points, 100000u);
}

TEST(FacesOfTheModel, MeetByThrees) {
    // A pyramid with four faces, three of which meet only at the top, and an oblique floor.
    const Vec3i n{96, 96, 64};
    const Vec3d top{48.3, 47.6, 60.2};
    const std::vector<FacePlane> faces{faceThrough({1, 0.2, 0.9}, top, n), faceThrough({-0.3, 1, 0.9}, top, n),
                                       faceThrough({-1, -0.1, 0.9}, top, n), faceThrough({0.2, -1, 0.9}, top, n),
                                       faceThrough({0.1, -0.07, -1}, {48, 48, 9.4}, n)};
    const BrickVolume bricks = bricksOf(
        n,
        [&](auto i, auto j, auto k) {
            return std::all_of(faces.begin(), faces.end(),
                               [&](const FacePlane& face) { return heightOver(face, i, j, k) < 0; })
                       ? 3u
                       : 0u;
        },
        BrickFaces::Planes, faces);
    expectCodesHold(bricks);
    int uncoded = 0;
    const auto codes = bricks.arrays().codes;
    const auto withThree = std::count_if(codes.begin(), codes.end(), [](const BrickVolume::BoxCoding& code) {
        return code.plane[2] != BrickVolume::kNoPlane;
    });
    EXPECT_GE(withThree, 2);  // two planes are not enough there
    for (std::int32_t bz = 0; bz < 8; ++bz)
        for (std::int32_t by = 0; by < 12; ++by)
            for (std::int32_t bx = 0; bx < 12; ++bx)
                if (const auto entry = bricks.entry(bx, by, bz); entry.isMixed() && !entry.isCoded()) ++uncoded;
    EXPECT_LE(uncoded, 1);  // the top, where four faces meet
    EXPECT_EQ(bricks.planes().size(), 5u);
}

//            /\   two roofs as sheets: the samples behind a face that have a neighbour along an axis before it. What bounds
//           /  \  them below are planes, too, which the model does not have; at the ridge four planes meet.
TEST(FacesOfTheModel, CodeSheetsAndWhereTheyMeet) {
    const Vec3i n{64, 64, 48};
    const FacePlane left = faceThrough({-0.36, -0.48, 0.8}, {32.3, 31.8, 40.2}, n),
                    right = faceThrough({0.36, 0.48, 0.8}, {32.3, 31.8, 40.2}, n);
    const LabelAt roofs = [&](auto i, auto j, auto k) -> Scalar {
        const double toLeft = heightOver(left, i, j, k), toRight = heightOver(right, i, j, k);
        if (toLeft >= 0 || toRight >= 0) return 0;
        return toLeft > -0.8 ? 1u : toRight > -0.8 ? 2u : 3u;
    };
    for (const BrickFaces faces : {BrickFaces::Planes, BrickFaces::Slopes}) {
        const BrickVolume bricks = bricksOf(n, roofs, faces, {left, right});
        const Coded found = expectCodesHold(bricks);
        EXPECT_GT(found.mixed, 50u);
        EXPECT_EQ(found.coded, found.mixed);
        // Four oblique planes in one code: one of them in the place of a cut.
        const auto codes = bricks.arrays().codes;
        EXPECT_TRUE(std::any_of(codes.begin(), codes.end(), [](const BrickVolume::BoxCoding& code) {
            return code.plane[2] != BrickVolume::kNoPlane && (code.cutAxes & 0x38) != 0;
        }));
        EXPECT_LE(bricks.planes().size(), 6u);
    }
}

TEST(FacesOfTheModel, DecideWhatARowOfVoxelsIs) {
    // At the border of a brick: the edge of a step, or the place where a slope leaves the brick. Two labels, one along
    // each half.
    const Vec3i n{8, 8, 8};
    const LabelAt row = [](auto i, auto j, auto k) { return j == 7 && k == 0 ? (i < 4 ? 1u : 2u) : 0u; };
    const FacePlane slope = faceThrough({0, -0.6, 0.8}, {0, 7.5, 0.875}, n),
                    between = faceThrough({1, 0, 0}, {4, 0, 0}, n);
    const FacePlane side = faceThrough({0, 1, 0}, {0, 7, 0}, n), top = faceThrough({0, 0, 1}, {0, 0, 1}, n);
    const BrickVolume asSlope = bricksOf(n, row, BrickFaces::Planes, {slope, between});
    expectCodesHold(asSlope);
    EXPECT_EQ(asSlope.coding(asSlope.entry(0, 0, 0)).cutAxes, 1u);
    EXPECT_EQ(asSlope.planes().size(), 1u);
    const BrickVolume asStep = bricksOf(n, row, BrickFaces::Planes, {slope, between, side, top});
    expectCodesHold(asStep);
    EXPECT_EQ(asStep.coding(asStep.entry(0, 0, 0)).cutAxes, 7u);
    EXPECT_TRUE(asStep.planes().empty());
}

TEST(FacesOfTheModel, LetCutsStandBesidePlanesWhereTheyAre) {
    // A beam over a slope; its two faces are known along the first bricks alone.
    const Vec3i n{40, 8, 8};
    const FacePlane slope = faceThrough({0.02, 0.5, 0.8}, {20.2, 4.1, 3.3}, n);
    FacePlane side = faceThrough({0, 1, 0}, {0, 6, 0}, n), bottom = faceThrough({0, 0, 1}, {0, 0, 6}, n);
    side.max[0] = bottom.max[0] = 8;
    const BrickVolume bricks = bricksOf(n,
                                        [&](auto i, auto j, auto k) {
                                            return heightOver(slope, i, j, k) < 0 ? 1u : j >= 6 && k >= 6 ? 2u : 0u;
                                        },
                                        BrickFaces::Planes, {slope, side, bottom});
    expectCodesHold(bricks);
    const auto known = bricks.entry(0, 0, 0), unknown = bricks.entry(4, 0, 0);
    ASSERT_TRUE(known.isCoded());
    EXPECT_EQ(bricks.coding(known).cutAxes, 6u);
    EXPECT_TRUE(!unknown.isCoded() || bricks.coding(unknown).cutAxes == 0);
}

TEST(FacesOfTheModel, AreNotBelievedAgainstSamples) {
    const Vec3i n{80, 72, 64};
    const FacePlane truth = faceThrough({0.3, -0.5, 0.8}, {40, 36, 32}, n);
    const LabelAt half = [&](auto i, auto j, auto k) { return heightOver(truth, i, j, k) < 0 ? 1u : 0u; };
    std::vector<FacePlane> lies;
    for (int turn = 0; turn < 300; ++turn)
        lies.push_back(faceThrough({std::sin(turn * 1.7), std::cos(turn * 2.3), 0.1 * turn - 15},
                                   {40.0 + turn % 7, 36.0 + turn % 5, 32.0 - turn % 3}, n));
    lies.push_back(faceThrough({0.3, -0.5, 0.8}, {40, 36, 32.8}, n));
    const BrickVolume bricks = bricksOf(n, half, BrickFaces::Planes, lies);
    expectCodesHold(bricks);
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) ASSERT_EQ(bricks.scalarAt(i, j, k), half(i, j, k));
}

TEST(FacesOfTheModel, CountNoLongerThanTheyAreNear) {
    // The surface continues beyond the extent of its faces: there the planes are fitted.
    const Vec3i n{128, 64, 64};
    FacePlane face = faceThrough({0.1, -0.5, 0.8}, {64.234, 32.151, 32.077}, n);
    face.max[0] = 40;
    const BrickVolume bricks = bricksOf(
        n, [&](auto i, auto j, auto k) { return heightOver(face, i, j, k) < 0 ? 1u : 0u; }, BrickFaces::Planes, {face});
    expectCodesHold(bricks);
    for (std::int32_t by = 0; by < 8; ++by)
        for (std::int32_t bz = 0; bz < 8; ++bz)
            for (const std::int32_t bx : {2, 12}) {
                const auto entry = bricks.entry(bx, by, bz);
                if (!entry.isCoded()) continue;
                EXPECT_EQ(bricks.planes()[bricks.coding(entry).plane[0]] == face.plane, bx == 2) << by << ' ' << bz;
            }
}

}  // namespace
}  // namespace svt::volume
