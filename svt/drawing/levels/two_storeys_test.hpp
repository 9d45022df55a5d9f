#pragma once
/// \file
/// A volume of two storeys without meshes, for tests of heights.

#include <svt/volume/sample_volume_test.hpp>

namespace svt::drawing {

/// Two storeys with a room each, 2 m high with a slab of 0.5 m below; samples every 0.25 m from 100, 200, 30 on.
inline volume::SemanticVolume twoStoreys() {
    volume::SemanticVolume volume = volume::test::emptyVolume({5, 5, 21}, {0.25, 0.25, 0.25}, {100, 200, 30});
    volume::test::addGroup(volume, "b", "Building");
    volume::test::addGroup(volume, "s0", "Storey", 0).name = "EG";
    volume::test::addObject(volume, "r0", "BuildingRoom", 1);
    volume::test::addObject(volume, "f0", "BuildingConstructiveElement", 1);
    volume::test::addGroup(volume, "s1", "Storey", 0).name = "1-OG";
    volume::test::addObject(volume, "r1", "BuildingRoom", 4);
    volume::test::paint(volume, [](int, int, int k) { return k < 2 ? 2 : k < 10 ? 1 : k < 12 ? 0 : 3; });
    return volume;
}

}  // namespace svt::drawing
