#include <svt/city/join/join_volumes.hpp>

#include <svt/analyze/known_volumes.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

namespace svt::city {
namespace {

using volume::Filling;
using volume::Overlap;

// A tile with a house of 4 x 4 x 4 m around a room of 2 x 2 x 2 m, at x metres.
volume::SemanticVolume tileAt(double x) {
    volume::SemanticVolume tile = volume::test::emptyVolume({6, 6, 6}, {1, 1, 1}, {x, 0, 0});
    volume::Label& house = volume::test::addObject(tile, "house " + std::to_string(int(x)), "Building");
    house.filling = Filling::Solid;
    house.volume = 64;
    volume::Label& room = volume::test::addObject(tile, "room " + std::to_string(int(x)), "BuildingRoom", 0);
    room.filling = Filling::Solid;
    room.volume = 8;
    volume::test::paintBoxes(tile, {{1, {1, 1, 1}, {5, 5, 5}}, {2, {2, 2, 2}, {4, 4, 4}}});
    tile.labels.overlaps = {{1, 0, 8, true}};
    return tile;
}

TEST(JoinVolumes, KeepsOverlapsOfItsParts) {
    const std::vector<volume::SemanticVolume> tiles{tileAt(0), tileAt(6)};
    const auto joined = joinVolumes(tiles);
    ASSERT_TRUE(joined) << joined.error().toString();
    EXPECT_EQ(joined->labels.overlaps, (std::vector<Overlap>{{1, 0, 8, true}, {3, 2, 8, true}}));
    const analyze::Extents extents(joined->labels);
    const analyze::KnownVolumes volumes(joined->labels, joined->grid, extents);
    EXPECT_EQ(volumes.of(0).volume, 64.0) << "the room does not count twice";
    EXPECT_EQ(volumes.of(2).volume, 64.0);
}

TEST(JoinVolumes, FindsSamplesThatTwoPartsFill) {
    // The houses share 1 x 4 x 4 samples. The first tile gets them.
    const std::vector<volume::SemanticVolume> tiles{tileAt(0), tileAt(3)};
    const auto joined = joinVolumes(tiles);
    ASSERT_TRUE(joined);
    EXPECT_EQ(joined->labels.overlaps, (std::vector<Overlap>{{0, 2, 16, false}, {1, 0, 8, true}, {3, 2, 8, true}}));
    EXPECT_EQ(joined->labels.labels[2].voxels, 64u - 8 - 16);
}

}  // namespace
}  // namespace svt::city
