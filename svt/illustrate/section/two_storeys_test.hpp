#pragma once
/// \file
/// A volume of two storeys without meshes, for tests of heights.

#include <svt/volume/semantic_volume.hpp>

namespace svt::illustrate {

/// Two storeys with a room each, 2 m high with a slab of 0.5 m below; samples every 0.25 m from 100, 200, 30 on.
inline volume::SemanticVolume twoStoreys() {
    volume::SemanticVolume volume;
    volume.grid = *volume::Grid::fromParts({5, 5, 21}, {0.25, 0.25, 0.25}, {100, 200, 30},
                                           {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
    const auto add = [&](const char* id, const char* className, const char* name, std::uint32_t parent, bool isObject) {
        volume::Label label;
        label.id = id;
        label.className = className;
        label.name = name;
        label.parent = parent;
        if (isObject) {
            label.first = volume.labels.scalarCount();
            label.count = 1;
        }
        volume.labels.labels.push_back(label);
    };
    add("b", "Building", "", volume::kNoLabel, false);
    add("s0", "Storey", "EG", 0, false);
    add("r0", "BuildingRoom", "", 1, true);
    add("f0", "BuildingConstructiveElement", "", 1, true);
    add("s1", "Storey", "1-OG", 0, false);
    add("r1", "BuildingRoom", "", 4, true);
    const std::uint32_t ends[] = {6, 4, 3, 4, 6, 6};
    for (std::size_t l = 0; l < 6; ++l) volume.labels.labels[l].subtreeEnd = ends[l];
    std::vector<volume::Scalar> dense(5 * 5 * 21, 0);
    for (std::size_t n = 0; n < dense.size(); ++n) {
        const std::size_t k = n / 25;
        dense[n] = k < 2 ? 2 : k < 10 ? 1 : k < 12 ? 0 : 3;
    }
    volume.columns = volume::ColumnVolume::fromDense({5, 5, 21}, dense);
    return volume;
}

}  // namespace svt::illustrate
