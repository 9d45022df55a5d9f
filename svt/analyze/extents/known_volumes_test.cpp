#include <svt/analyze/known_volumes.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

namespace svt::analyze {
namespace {

using volume::Filling;
using volume::kNoLabel;

// Two parts of a building of 1 m voxels: one closed, one filled by winding numbers. A house with a room and a shelf.
volume::SemanticVolume town() {
    volume::SemanticVolume volume = volume::test::emptyVolume({20, 10, 4}, {1, 1, 1});
    const auto add = [&](const char* id, const char* className, std::uint32_t parent, Filling filling, double solid) {
        volume::Label& label = filling == Filling::None ? volume::test::addGroup(volume, id, className, parent)
                                                        : volume::test::addObject(volume, id, className, parent);
        label.filling = filling;
        label.volume = solid;
    };
    add("school", "Building", kNoLabel, Filling::None, 0);      // 0
    add("hall", "BuildingPart", 0, Filling::Solid, 63.7);       // 1
    add("wing", "BuildingPart", 0, Filling::Winding, 0);        // 2
    add("house", "Building", kNoLabel, Filling::Solid, 100.5);  // 3
    add("room", "BuildingRoom", 3, Filling::Solid, 30.25);      // 4
    add("shelf", "BuildingFurniture", 4, Filling::Solid, 2);    // 5
    add("wall", "WallSurface", 3, Filling::Surface, 0);         // 6
    volume::test::paintBoxes(volume, {{1, {0, 0, 0}, {4, 4, 4}},
                                      {2, {4, 0, 0}, {8, 4, 2}},
                                      {3, {10, 0, 0}, {15, 5, 4}},
                                      {4, {11, 1, 0}, {14, 4, 3}},
                                      {5, {11, 1, 0}, {12, 3, 1}},
                                      {6, {10, 0, 0}, {11, 5, 4}}});
    volume.labels.overlaps = {{4, 3, 25, true}, {5, 3, 2, true}, {5, 4, 2, true}};
    volume.labels.labels[2].area = 64;
    volume.labels.labels[2].uncertainVoxels = 3;
    return volume;
}

KnownVolume volumeOf(const volume::SemanticVolume& volume, std::uint32_t label) {
    const Extents extents(volume.labels);
    return KnownVolumes(volume.labels, volume.grid, extents).of(label);
}

TEST(KnownVolumes, OfClosedSolidsAreExactWhateverIsInside) {
    const volume::SemanticVolume volume = town();
    for (const auto& [label, expected] : {std::pair(3u, 100.5), std::pair(4u, 30.25), std::pair(1u, 63.7)}) {
        const KnownVolume known = volumeOf(volume, label);
        EXPECT_DOUBLE_EQ(known.volume.value_or(0), expected) << label;
        EXPECT_EQ(known.bound, 0.0);
        EXPECT_EQ(known.source, VolumeSource::Meshes);
    }
    EXPECT_FALSE(volumeOf(volume, 6).volume) << "a sheet";
    EXPECT_EQ(volumeOf(volume, 6).source, VolumeSource::None);
}

// The overlaps of open shells are not counted, but furniture lies in its room.
TEST(KnownVolumes, OfRoomsWithOpenFurnitureAreExact) {
    volume::SemanticVolume volume = town();
    volume.labels.labels[5].filling = Filling::Winding;
    volume.labels.labels[5].volume = 0;
    volume.labels.overlaps = {{4, 3, 25, true}};
    EXPECT_DOUBLE_EQ(volumeOf(volume, 4).volume.value_or(0), 30.25);
    EXPECT_DOUBLE_EQ(volumeOf(volume, 3).volume.value_or(0), 100.5);
    EXPECT_EQ(volumeOf(volume, 3).source, VolumeSource::Meshes);
    EXPECT_EQ(volumeOf(volume, 5).source, VolumeSource::Voxels);
}

TEST(KnownVolumes, OfOpenShellsAreCountedWithABound) {
    volume::SemanticVolume volume = town();
    const KnownVolume wing = volumeOf(volume, 2);
    EXPECT_DOUBLE_EQ(wing.volume.value_or(0), 32);
    EXPECT_DOUBLE_EQ(wing.bound.value_or(0), 64 * 0.5 + 3) << "half a voxel along its surface, and uncertain voxels";
    EXPECT_EQ(volumeSourceName(wing.source), "voxels");
    const KnownVolume school = volumeOf(volume, 0);
    EXPECT_DOUBLE_EQ(school.volume.value_or(0), 63.7 + 32);
    EXPECT_DOUBLE_EQ(school.bound.value_or(0), 35);
    EXPECT_EQ(volumeSourceName(school.source), "meshes and voxels");
    volume.labels.labels[2].area = 0;  // a file of an older version
    EXPECT_FALSE(volumeOf(volume, 2).bound);
}

TEST(KnownVolumes, OfPartsThatShareSpaceAreCounted) {
    volume::SemanticVolume volume = town();
    volume.labels.labels[2].filling = Filling::Solid;
    volume.labels.labels[2].volume = 40;
    EXPECT_DOUBLE_EQ(volumeOf(volume, 0).volume.value_or(0), 103.7);
    volume.labels.overlaps = {{1, 2, 8, false}};
    const KnownVolume known = volumeOf(volume, 0);
    EXPECT_DOUBLE_EQ(known.volume.value_or(0), 63.7 + 32) << "the part that lost voxels is counted";
    EXPECT_EQ(known.source, VolumeSource::Both);
}

// A flat whose rooms and walls took all voxels but two.
TEST(KnownVolumes, BoundsCoverOnlyWhatIsCounted) {
    volume::SemanticVolume volume = volume::test::emptyVolume({20, 10, 4}, {1, 1, 0.5});
    const auto add = [&](const char* id, const char* className, std::uint32_t parent, double solid, double area) {
        volume::Label& label = volume::test::addObject(volume, id, className, parent);
        label.filling = Filling::Solid;
        label.volume = solid;
        label.area = area;
    };
    add("flat", "BuildingUnit", kNoLabel, 64, 112);
    add("room", "BuildingRoom", 0, 63, 110);
    add("wall", "BuildingConstructiveElement", 0, 7.5, 50);
    volume::test::paintBoxes(
        volume,
        {{1, {0, 0, 0}, {8, 4, 4}}, {2, {0, 0, 0}, {8, 4, 4}}, {1, {0, 0, 0}, {2, 1, 1}}, {3, {8, 0, 0}, {12, 4, 4}}});
    volume.labels.overlaps = {{1, 0, 126, true}, {2, 0, 4, true}};
    const KnownVolume flat = volumeOf(volume, 0);
    EXPECT_EQ(flat.source, VolumeSource::Both);
    EXPECT_DOUBLE_EQ(flat.volume.value_or(0), 63 + 7.5 + 2 * 0.5);
    EXPECT_DOUBLE_EQ(flat.bound.value_or(0), 2 * 4 * 0.5) << "half a voxel along the surface of two voxels";
}

TEST(KnownVolumes, AreThoseOfQueries) {
    const volume::SemanticVolume volume = town();
    EXPECT_EQ(*selectLabels(volume, "class=Building and volume>95"), (std::vector<std::uint32_t>{0, 3}));
    EXPECT_EQ(*selectLabels(volume, "id=wing and volume>31"), (std::vector<std::uint32_t>{2}));
    std::vector<std::string> nothing;
    for (const char* query : {"id=wall and volume=0", "id=wall and volume!=7", "id=wall and volume<1"})
        EXPECT_TRUE(selectLabels(LabelRows(volume, &nothing), query)->empty()) << query;
    // Without a grid, voxels have no volume: only solids have one.
    EXPECT_TRUE(selectLabels(LabelRows(volume.labels, &nothing), "id=wing and volume>=0")->empty());
    EXPECT_EQ(*selectLabels(volume.labels, "id=hall and Volume>63"), (std::vector<std::uint32_t>{1}));
}

}  // namespace
}  // namespace svt::analyze
