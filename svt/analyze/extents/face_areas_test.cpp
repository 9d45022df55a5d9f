#include <svt/analyze/face_areas.hpp>

#include <svt/analyze/extents.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

namespace svt::analyze {
namespace {

using volume::kNoLabel;

// A window has a body in its wall and a surface in the room.
TEST(FaceAreas, WindowsOfRoomsCountWhereTheExtentHasNoOthers) {
    volume::SemanticVolume volume = volume::test::emptyVolume({8, 8, 8}, {1, 1, 1});
    const auto add = [&](const char* id, const char* className, std::uint32_t parent) {
        volume::test::addObject(volume, id, className, parent);
    };
    add("house", "Building", kNoLabel);             // 0
    add("wall", "BuildingConstructiveElement", 0);  // 1
    add("window", "Window", 1);                     // 2
    add("room", "BuildingRoom", 0);                 // 3
    add("inner face", "InteriorWallSurface", 3);    // 4
    add("pane", "WindowSurface", 4);                // 5
    add("door", "DoorSurface", 4);                  // 6
    const std::vector<std::optional<double>> areas{100, 50, 6, 80, 12, 2, 1.5};
    const auto of = [&](std::uint32_t label) {
        return faceAreas(volume.labels, Extents(volume.labels).of(label), areas);
    };
    const auto window = static_cast<std::size_t>(FaceKind::Window), door = static_cast<std::size_t>(FaceKind::Door);
    EXPECT_EQ(of(0)[window], 6.0);
    EXPECT_EQ(of(0)[door], 1.5) << "no other door";
    EXPECT_EQ(of(3)[window], 2.0);
    EXPECT_EQ(of(4)[window], 2.0);
    EXPECT_EQ(of(1)[window], 6.0);
    EXPECT_FALSE(of(1)[door]);
}

}  // namespace
}  // namespace svt::analyze
