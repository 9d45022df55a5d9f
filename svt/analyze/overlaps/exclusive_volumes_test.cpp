/// Volumes that add up to the union of solids, compared with counts of unit cubes, and sums of features that contain each
/// other.

#include <svt/analyze/exclusive_volumes.hpp>
#include <svt/analyze/overlaps/common_volume_of_all.hpp>
#include <svt/analyze/overlaps/solid_clips.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <set>
#include <string>
#include <tuple>

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
    const std::vector<RoofTriangle>* const roofs[] = {&clips[0].roofs, &clips[1].roofs, &clips[2].roofs};
    std::uint64_t work = 100000;
    const auto volumeOf = commonVolumeOfAll(roofs, 0, work);
    ASSERT_TRUE(volumeOf);
    EXPECT_NEAR(*volumeOf, 1.8, 1e-5);
    EXPECT_LT(work, 100000u);
    work = 5;
    EXPECT_FALSE(commonVolumeOfAll(roofs, 0, work));
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
