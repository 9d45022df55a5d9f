#pragma once
/// \file
/// The meaning of CityGML and CityJSON classes for voxelization: one name per class across all
/// formats, priority where solids overlap, and which classes represent solids.

#include <cstdint>
#include <string>
#include <string_view>

namespace svt::model {

/// One name for all formats: the CityGML 3.0 local name where one exists. "Room" becomes "BuildingRoom",
/// "IntBuildingInstallation" "BuildingInstallation", "BuildingStorey" "Storey". An unknown name, including one with a
/// leading '+' (CityJSON extension), is kept, except that "+Window" and "+Door" become "Window" and "Door". Known old
/// names are matched ignoring ASCII case.
[[nodiscard]] std::string canonicalClassName(std::string_view sourceName);

/// Priority where several objects claim a voxel: the finer component, that is, the lower rank, gets it.
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

/// Whether objects of a class have an inside that is filled. A shell that is closed in the file is always filled.
enum class Inside : std::uint8_t {
    Always,    ///< a body or a space: an open shell counts as incomplete and is closed
    Declared,  ///< only where the geometry is a solid: trees of crossed images, bridge decks, generic objects
    Never      ///< terrain, roads, land use, boundary surfaces: a sheet
};

/// The inside of a class. Unknown classes are bodies (geometry that encloses nothing becomes a sheet in any case).
///
///     Always    Building, BuildingPart, rooms, units, storeys, constructive elements, installations, furniture,
///               tunnels
///     Declared  Door, Window, SolitaryVegetationObject, PlantCover, CityFurniture, GenericOccupiedSpace,
///               GenericUnoccupiedSpace, GenericLogicalSpace, Bridge, BridgePart, BridgeInstallation, WaterBody,
///               OtherConstruction
///     Never     boundary surfaces, DoorSurface, WindowSurface, relief, LandUse, CityObjectGroup, transportation
[[nodiscard]] Inside insideOf(std::string_view className) noexcept;

/// True if objects of the class can be bodies with a volume (Building, BuildingRoom, furniture, Door of CityGML 3.0):
/// insideOf() is not Never.
[[nodiscard]] bool hasSolidMeaning(std::string_view className) noexcept;

/// True for surfaces that bound a space: WallSurface, RoofSurface, ..., ClosureSurface.
[[nodiscard]] bool isBoundarySurface(std::string_view className) noexcept;

/// Orientation of a boundary surface: the direction of its faces, out of the shell that it bounds.
enum class Orientation : std::uint8_t {
    Any,  ///< walls, closure surfaces, and classes without a typical orientation
    Up,
    Down
};

/// Orientation of a boundary surface in the shell that it bounds: GroundSurface and OuterCeilingSurface face down,
/// RoofSurface and OuterFloorSurface up.
/// \param boundsSpace  true if the shell bounds a room or another space: then FloorSurface faces down and
///                     CeilingSurface up; in a shell of material they can be either face of a slab
[[nodiscard]] Orientation orientationOf(std::string_view surfaceClass, bool boundsSpace) noexcept;

/// The class of the phases of an object: "WindowPhase" for those of a Window, see phases.hpp. A phase has the priority of
/// its object and, as a door, an inside only where its geometry is a solid.
[[nodiscard]] std::string phaseClassOf(std::string_view className);
[[nodiscard]] bool isPhase(std::string_view className) noexcept;

/// True for Door, Window, DoorSurface, WindowSurface.
[[nodiscard]] bool isFilling(std::string_view className) noexcept;

/// True for spaces filled with air: BuildingRoom, BuildingUnit, Storey, HollowSpace, ....
[[nodiscard]] bool isSpace(std::string_view className) noexcept;

}  // namespace svt::model
