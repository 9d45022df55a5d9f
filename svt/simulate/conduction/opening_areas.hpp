#pragma once
/// \file
/// The areas of windows and doors between zones.

#include <svt/simulate/conduction/air_map.hpp>

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace svt::simulate {

struct OpeningPlace {
    Vec3i min{}, max{};  ///< voxels [min, max) around it; empty without voxels
    /// m2 between two zones a < b: from the rows of voxels along the three axes that lead from a through the opening to b.
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> areas;
};

/// The place of each opening. Where a row leads through several openings, such as a window and the surface of its pane, the
/// first one with a body counts, else the first one.
/// \param hasBody  of each opening: not only a surface
/// Cost: O(runs of all columns), and O(voxels of the boxes * log runs).
[[nodiscard]] std::vector<OpeningPlace> findOpeningPlaces(const AirMap& map, Vec3d spacing,
                                                          const std::vector<char>& hasBody);

}  // namespace svt::simulate
