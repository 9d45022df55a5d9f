#pragma once
/// \file
/// What the classes of CityGML and CityJSON mean to a volume: one name per class for all
/// formats, who wins where solids overlap, and which classes stand for bodies.

#include <cstdint>
#include <string>
#include <string_view>

namespace svt::model {

/// One name for all formats: the CityGML 3.0 local name where one exists. "Room" gives "BuildingRoom",
/// "IntBuildingInstallation" "BuildingInstallation", "BuildingStorey" "Storey"; an unknown name, a leading
/// '+' (CityJSON extension) included, stays as it is, but "+Window" and "+Door" are windows and doors.
/// Known old names are found without regard to ASCII case.
[[nodiscard]] std::string canonicalClassName(std::string_view sourceName);

/// Who wins a voxel that several objects claim: the finer component, that is the lower rank.
enum class ClassRank : std::uint8_t {
    Furniture,     ///< BuildingFurniture, CityFurniture, vegetation objects
    Filling,       ///< Door, Window and their surfaces
    Installation,  ///< BuildingInstallation, BridgeInstallation, ...
    Element,       ///< BuildingConstructiveElement and boundary surfaces (WallSurface, ...)
    Room,          ///< BuildingRoom, HollowSpace, BridgeRoom
    Unit,          ///< BuildingUnit
    Storey,        ///< Storey
    Building,      ///< BuildingPart, Building, Bridge, Tunnel
    Other          ///< terrain, land use, water, transportation, groups
};
[[nodiscard]] ClassRank classRank(std::string_view className) noexcept;

/// True where the class stands for a body with volume (Building, BuildingRoom, furniture, Door of CityGML 3.0):
/// an open shell of such a feature is closed. False for boundary surfaces, openings as surfaces, terrain.
[[nodiscard]] bool hasSolidMeaning(std::string_view className) noexcept;

/// True for the surfaces that bound a space: WallSurface, RoofSurface, ..., ClosureSurface.
[[nodiscard]] bool isBoundarySurface(std::string_view className) noexcept;

/// True for Door, Window, DoorSurface, WindowSurface.
[[nodiscard]] bool isFilling(std::string_view className) noexcept;

/// True for spaces that are air: BuildingRoom, BuildingUnit, Storey, HollowSpace, ....
[[nodiscard]] bool isSpace(std::string_view className) noexcept;

}  // namespace svt::model
