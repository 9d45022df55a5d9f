/// Volumes that add up to the union of solids, compared with counts of unit cubes, and sums of features that contain each
/// other.

#include <svt/analyze/exclusive_volumes.hpp>
#include <svt/analyze/overlaps/common_volume_of_all.hpp>
#include <svt/analyze/overlaps/convex_cells.hpp>
#include <svt/analyze/overlaps/solid_clips.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace svt::analyze {
namespace {

using volume::Filling;

struct CubeBox {
    Vec3i low, high;
    [[nodiscard]] bool contains(Vec3i cube) const noexcept {
        return low.x <= cube.x && cube.x < high.x && low.y <= cube.y && cube.y < high.y && low.z <= cube.z &&
               cube.z < high.z;
    }
};

void addSolid(volume::SemanticVolume& volume, const std::string& id, Vec3d low, Vec3d high) {
    volume::Label& label = volume::test::addObject(volume, id, "BuildingConstructiveElement");
    const Vec3d size = high - low;
    label.filling = Filling::Solid;
    label.volume = size.x * size.y * size.z;
    volume::test::addBoxMesh(volume, label.subtreeEnd - 1, low, high);
}

double sumOf(const std::vector<Measure>& measures) {
    double sum = 0;
    for (const Measure& measure : measures) sum += measure.volume.value_or(0);
    return sum;
}

TEST(ExclusiveVolumes, OfRandomBoxesAreCountsOfCubes) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        std::mt19937 random(seed);
        const auto below = [&](std::uint32_t n) { return static_cast<std::int32_t>(random() % n); };
        volume::SemanticVolume volume = volume::test::emptyVolume({3, 3, 3}, {1, 1, 1});
        std::vector<CubeBox> boxes;
        for (int n = 0; n < 5; ++n) {
            const Vec3i low{below(6), below(6), below(6)};
            const CubeBox box{low, {low.x + 1 + below(5), low.y + 1 + below(5), low.z + 1 + below(5)}};
            boxes.push_back(box);
            addSolid(volume, std::to_string(n), toDouble(box.low), toDouble(box.high));
        }
        // The smaller solid has the space, then that with the smaller id.
        std::vector<double> expected(boxes.size(), 0);
        double all = 0;
        for (std::int32_t k = 0; k < 12; ++k)
            for (std::int32_t j = 0; j < 12; ++j)
                for (std::int32_t i = 0; i < 12; ++i) {
                    std::set<std::pair<double, std::size_t>> owners;
                    for (std::size_t n = 0; n < boxes.size(); ++n)
                        if (boxes[n].contains({i, j, k})) owners.insert({volume.labels.labels[n].volume, n});
                    if (owners.empty()) continue;
                    expected[owners.begin()->second] += 1;
                    all += 1;
                }
        const auto measures = exclusiveMeasures(volume);
        for (std::size_t n = 0; n < boxes.size(); ++n) {
            ASSERT_TRUE(measures[n].volume);
            EXPECT_NEAR(*measures[n].volume, expected[n], 1e-4) << "seed " << seed << " box " << n;
            EXPECT_EQ(measures[n].countedVolume, 0);
        }
        EXPECT_NEAR(sumOf(measures), all, 1e-4 * all);
    }
}

TEST(ExclusiveVolumes, OfThreeWedgesHaveTheirCommonVolume) {
    // Three copies of a roof of triangles share all of it, so two of them are left without space.
    volume::SemanticVolume volume = volume::test::emptyVolume({3, 3, 3}, {1, 1, 1});
    for (std::uint32_t l = 0; l < 3; ++l) {
        volume::Label& label = volume::test::addObject(volume, std::to_string(l), "RoofSurface");
        label.filling = Filling::Solid;
        label.volume = 0.5 * 4 * 3 * 6;
        const Vec3d a{0, 0, 0}, b{4, 0, 0}, c{2, 0, 3}, d{0, 6, 0}, e{4, 6, 0}, f{2, 6, 3};
        for (const auto& quad : {std::array{a, d, e, b}, std::array{a, c, f, d}, std::array{b, e, f, c}})
            volume::test::addQuad(volume, l, quad);
        for (const auto& [p, q, r] : {std::tuple{a, b, c}, std::tuple{d, f, e}})
            volume.vectors.triangles.push_back({l,
                                                {volume::test::addPoint(volume, p), volume::test::addPoint(volume, q),
                                                 volume::test::addPoint(volume, r)}});
    }
    const auto measures = exclusiveMeasures(volume);
    EXPECT_NEAR(*measures[0].volume, 36, 1e-4);
    EXPECT_NEAR(*measures[1].volume, 0, 1e-4);
    EXPECT_NEAR(*measures[2].volume, 0, 1e-4);
}

// A hull of 1000 m3 with a room of 512 m3. Its voxels are coarse: walls have some of those that lie in the room.
TEST(ExclusiveVolumes, OfHullRoomAndWallsAddUpToTheHull) {
    volume::SemanticVolume volume = volume::test::emptyVolume({12, 12, 12}, {1, 1, 1});
    addSolid(volume, "hull", {0, 0, 0}, {10, 10, 10});
    addSolid(volume, "room", {1, 1, 1}, {9, 9, 9});
    for (const std::uint64_t voxels : {450, 150}) {
        volume::Label& wall = volume::test::addObject(volume, "wall" + std::to_string(voxels), "InteriorWallSurface");
        wall.filling = Filling::Body;
        wall.voxels = voxels;
    }
    auto& labels = volume.labels.labels;
    labels[0].voxels = 0;
    labels[0].subtreeEnd = 4;
    labels[1].className = "BuildingRoom";
    labels[1].subtreeEnd = 4;
    labels[1].parent = 0;
    labels[2].parent = labels[3].parent = 1;
    labels[1].voxels = 400;
    volume.labels.overlaps = {{1, 0, 512, true}};
    const auto measures = exclusiveMeasures(volume);
    EXPECT_NEAR(measures[1].volume.value_or(0), 512, 1e-6);
    EXPECT_NEAR(measures[2].volume.value_or(0), 488 * 0.75, 1e-6);
    EXPECT_NEAR(measures[3].countedVolume, 488 * 0.25, 1e-6);
    EXPECT_NEAR(sumOf(measures), 1000, 1e-6);
}

TEST(ExclusiveVolumes, StayCountedWithoutClosedMeshes) {
    volume::SemanticVolume volume = volume::test::emptyVolume({8, 8, 4}, {1, 1, 1});
    addSolid(volume, "room", {-0.5, -0.5, -0.5}, {7.5, 7.5, 3.5});
    volume::test::addObject(volume, "open stove", "BuildingFurniture", 0).filling = Filling::Winding;
    volume::test::paintBoxes(volume, {{1, {0, 0, 0}, {8, 8, 4}}, {2, {4, 4, 1}, {6, 6, 2}}});
    volume.labels.overlaps = {{1, 0, 4, true}};
    const auto measures = exclusiveMeasures(volume);
    EXPECT_EQ(measures[0].volume, 252.0) << "the stove has no mesh that could be subtracted";
    EXPECT_EQ(measures[0].countedVolume, 252.0);
    EXPECT_EQ(measures[1].volume, 4.0);
    // Without work, everything is counted.
    volume.labels.overlaps.clear();
    EXPECT_EQ(exclusiveMeasures(volume, 0)[0].countedVolume, 0) << "a solid that lost nothing needs no work";
}

TEST(CommonVolumeOfAll, EndsWithItsWork) {
    volume::SemanticVolume volume = volume::test::emptyVolume({3, 3, 3}, {1, 1, 1});
    for (int n = 0; n < 3; ++n) addSolid(volume, std::to_string(n), {0.1 * n, 0, 0}, {2 + 0.1 * n, 1, 1});
    std::vector<SolidClip> clips;
    for (const MeshSolid& solid : meshSolids(volume))
        clips.push_back(clipSolid(solid, volume.vectors, {{0, 0, 0}, {3, 1, 1}}));
    const std::vector<plane::RoofTriangle>* const roofs[] = {&clips[0].roofs, &clips[1].roofs, &clips[2].roofs};
    std::uint64_t work = 100000;
    const auto volumeOf = commonVolumeOfAll(roofs, 0, work);
    ASSERT_TRUE(volumeOf);
    EXPECT_NEAR(*volumeOf, 1.8, 1e-5);
    EXPECT_LT(work, 100000u);
    work = 5;
    EXPECT_FALSE(commonVolumeOfAll(roofs, 0, work));
}

using Corners = std::vector<std::array<Vec3d, 3>>;

// A square tube around an axis: 0.2 m wide, with walls of 6 mm, 2 m long. Turned about z, then about x.
Corners tube(double turn, double tilt) {
    std::vector<Vec3d> corners;
    for (const double y : {-1.0, 1.0})
        for (const double half : {0.1, 0.094})
            for (const auto& [x, z] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
                const Vec3d p{x * half, y, z * half};
                const Vec3d q{p.x * std::cos(turn) - p.y * std::sin(turn), p.x * std::sin(turn) + p.y * std::cos(turn),
                              p.z};
                corners.push_back({q.x + 1.5, q.y * std::cos(tilt) - q.z * std::sin(tilt) + 1.5,
                                   q.y * std::sin(tilt) + q.z * std::cos(tilt) + 1.5});
            }
    Corners triangles;
    const auto addQuad = [&](int a, int b, int c, int d) {
        const auto at = [&](int n) { return corners[std::size_t(n)]; };
        triangles.push_back({at(a), at(c), at(b)});
        triangles.push_back({at(a), at(d), at(c)});
    };
    for (int n = 0; n < 4; ++n) {
        const int m = (n + 1) % 4;
        addQuad(n, m, 8 + m, 8 + n);            // outside
        addQuad(4 + m, 4 + n, 12 + n, 12 + m);  // inside
        addQuad(m, n, 4 + n, 4 + m);            // the ends
        addQuad(8 + n, 8 + m, 12 + m, 12 + n);
    }
    return triangles;
}

double volumeOfMesh(const Corners& triangles) {
    double sum = 0;
    for (const auto& [a, b, c] : triangles) sum += dot(a, cross(b, c)) / 6;
    return sum;
}

// Whether a point lies in a tube: how often the mesh is above it.
bool isIn(const Corners& triangles, Vec3d p) {
    int above = 0;
    for (const auto& [a, b, c] : triangles) {
        const auto sideOf = [&p](Vec3d q, Vec3d r) { return (r.x - q.x) * (p.y - q.y) - (r.y - q.y) * (p.x - q.x); };
        const double ab = sideOf(a, b), bc = sideOf(b, c), ca = sideOf(c, a);
        if (!((ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0))) continue;
        const double z = (a.z * bc + b.z * ca + c.z * ab) / (ab + bc + ca);
        if (z > p.z) above += ab > 0 ? 1 : -1;
    }
    return above != 0;
}

// Six tubes at one node: what is left of one without the others, by cells and by points.
TEST(ConvexCells, LeaveWhatOtherTubesDoNotHave) {
    std::vector<Corners> tubes;
    std::vector<std::vector<ConvexCell>> cells;
    std::uint64_t work = std::uint64_t{1} << 30U;
    for (int n = 0; n < 6; ++n) {
        tubes.push_back(tube(0.5 * n, 0.1 * n));
        EXPECT_NEAR(volumeOfMesh(tubes.back()), (0.2 * 0.2 - 0.188 * 0.188) * 2, 1e-9);
        auto found = convexCells(tubes.back(), volumeOfMesh(tubes.back()), work);
        ASSERT_TRUE(found);
        cells.push_back(std::move(*found));
    }
    std::vector<const std::vector<ConvexCell>*> others;
    for (std::size_t n = 1; n < cells.size(); ++n) others.push_back(&cells[n]);
    const auto lost = volumeWithin(cells[0], others, work);
    ASSERT_TRUE(lost);
    const auto twoLost = volumeWithin(cells[0], std::span(others).first(1), work);
    ASSERT_TRUE(twoLost);
    EXPECT_LT(*twoLost, *lost);
    double sum = 0;
    constexpr int kAlong = 500, kAcross = 100;
    for (const auto& cell : cells[0]) {
        ASSERT_GT(volumeOf(cell), 0);
        sum += volumeOf(cell);
    }
    EXPECT_NEAR(sum, volumeOfMesh(tubes[0]), 1e-9);
    double counted = 0;
    for (int j = 0; j < kAlong; ++j)
        for (int i = 0; i < kAcross; ++i)
            for (int k = 0; k < kAcross; ++k) {
                // The first tube lies along y; only its walls are asked.
                const Vec3d p{1.4 + 0.2 * (i + 0.5) / kAcross, 0.5 + 2.0 * (j + 0.5) / kAlong,
                              1.4 + 0.2 * (k + 0.5) / kAcross};
                if (std::max(std::abs(p.x - 1.5), std::abs(p.z - 1.5)) < 0.094) continue;
                const bool isLost =
                    std::any_of(tubes.begin() + 1, tubes.end(), [&p](const Corners& other) { return isIn(other, p); });
                if (isLost) counted += 2.0 / kAlong * 0.2 / kAcross * 0.2 / kAcross;
            }
    EXPECT_NEAR(*lost, counted, 0.01 * counted);
}

TEST(ConvexCells, GiveUpOnOpenMeshesAndWithoutWork) {
    Corners open = tube(0, 0);
    const double volume = volumeOfMesh(open);
    std::uint64_t none = 10;
    EXPECT_FALSE(convexCells(open, volume, none));
    open.resize(20);
    std::uint64_t work = 1000000;
    EXPECT_FALSE(convexCells(open, volume, work));
}

// Forty boxes share one place: more than inclusion and exclusion can do.
TEST(ExclusiveVolumes, OfManyBoxesAtOnePlaceAreExact) {
    volume::SemanticVolume volume = volume::test::emptyVolume({3, 3, 3}, {1, 1, 1});
    for (int n = 0; n < 40; ++n) addSolid(volume, std::to_string(100 + n), {0, 0, 0}, {1 + 0.01 * n, 1, 1});
    const auto measures = exclusiveMeasures(volume);
    EXPECT_NEAR(sumOf(measures), 1.39, 1e-4);
    for (const Measure& measure : measures) EXPECT_EQ(measure.countedVolume, 0);
}

TEST(FinestFeatures, AreThoseThatContainNoOther) {
    volume::SemanticVolume volume = volume::test::emptyVolume({4, 4, 4}, {1, 1, 1});
    volume::test::addGroup(volume, "building", "Building");                           // 0
    volume::test::addGroup(volume, "wall", "BuildingConstructiveElement", 0);         // 1
    volume::test::addObject(volume, "brick", "BuildingConstructiveElement", 1);       // 2
    volume::test::addObject(volume, "insulation", "BuildingConstructiveElement", 1);  // 3
    volume::test::addObject(volume, "room", "BuildingRoom", 0);                       // 4
    const Extents extents(volume.labels);
    using Labels = std::vector<std::uint32_t>;
    const std::uint32_t none = volume::kNoLabel;
    EXPECT_EQ(finestFeatures(extents, Labels{0, 1, 2, 3, 4}, 5), (Labels{0, 1, 2, 3, 4}));
    EXPECT_EQ(finestFeatures(extents, Labels{0, 1}, 5), (Labels{0, 1, 1, 1, 0})) << "the asked level";
    EXPECT_EQ(finestFeatures(extents, Labels{2}, 5), (Labels{none, none, 2, none, none}));
    EXPECT_EQ(finestFeatures(extents, Labels{}, 5), (Labels(5, none)));
}

}  // namespace
}  // namespace svt::analyze
