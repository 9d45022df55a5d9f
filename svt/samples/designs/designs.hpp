#pragma once
/// \file
/// The three designs. The returned plans are resolved: faces, volumes and neighbours are filled in.

#include <svt/samples/parts/plan.hpp>

#include <vector>

namespace svt::samples {

/// The furnished house: 11 x 9 m, two storeys and an attic under a gable roof of pitch 4/5. z = 0 is the ground floor.
[[nodiscard]] Plan housePlan();

/// Parameters that vary between the houses of a district.
struct VillageHouse {
    int widthStep = 0;  ///< 0..3: 9, 10, 11, 12 m along the ridge
    int depthStep = 0;  ///< 0..1: 8, 9 m
    int pitchStep = 0;  ///< 0..2: 3/5, 4/5, 1
    int storeys = 1;    ///< 1..2
    friend auto operator<=>(const VillageHouse&, const VillageHouse&) = default;
};

/// A house of the district: walls, slabs, roof, rooms, windows and a door, without furniture. z = 0 is the ground
/// floor. Walls are Material::PlasterWhite and roofs Material::RoofTiles; a document may replace these colors.
[[nodiscard]] Plan villageHousePlan(const VillageHouse& house);

/// Parameters of one storey of the tower.
struct TowerStorey {
    int flats = 4;           ///< 2..8
    bool isLowest = false;   ///< has the closed base slab
    bool isHighest = false;  ///< has the roof
};
inline constexpr Length kTowerStoreyHeight = 3060;

/// One storey of the tower, floor at z = 0. The slab above belongs to the next storey, except for the roof.
[[nodiscard]] Plan towerPlan(const TowerStorey& storey);

/// Outer length and depth of the tower without balconies.
[[nodiscard]] Point towerSize(int flats);

}  // namespace svt::samples
