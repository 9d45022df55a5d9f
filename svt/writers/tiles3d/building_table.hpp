#pragma once
/// \file
/// The table of a tile whose features are buildings, for cities and for single volumes.

#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/tiles3d/property_table.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace svt::writers {

/// Data of a building for a row of the table.
struct BuildingRow {
    volume::Label label;
    double volume = 0;  ///< m3; 0: unknown
    double lowest = INFINITY, highest = -INFINITY;
};

/// Adds the columns, and returns EXT_structural_metadata: id, name, class, volume, height, lowest and attributes.
/// The table omits the column of names if each name is empty or equals the id.
[[nodiscard]] nlohmann::ordered_json buildingTable(const std::vector<BuildingRow>& buildings, bool hasAttributes,
                                                   GltfBuffer& buffer);

/// The building of each label: its outermost ancestor that is a building, or the root of its tree if there is none.
[[nodiscard]] std::vector<std::uint32_t> buildingOfLabels(const volume::LabelTable& table);

}  // namespace svt::writers
