#pragma once
/// \file
/// Areas and volumes of rooms, storeys and components, as in architects' tables: floor areas according to DIN 277-1 if
/// the model has enough data, and sums of the components.
///
///     BGF  gross floor area          enclosed by a plan: the sum of everything that is cut 0.15 m above the floor,
///                                    and the openings of doors and windows in the walls that are cut there.
///     NRF  net room area             sum of the rooms.
///     KGF  area of construction      BGF - NRF.
///     NUF, TF, VF                    net room area for use, technical rooms, circulation; by the name of a room.

#include <svt/core/result.hpp>
#include <svt/drawing/building_levels.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::drawing {

/// Use of a room according to DIN 277-1.
enum class RoomUse : std::uint8_t { Unknown, Use, Technical, Traffic };
/// "NUF", "TF", "VF"; empty if the use is unknown.
[[nodiscard]] std::string_view roomUseName(RoomUse use) noexcept;

/// Derives the use from German or English words in the name, function, usage, class or type of a room.
[[nodiscard]] RoomUse roomUseOf(const volume::Label& label);

struct RoomArea {
    std::uint32_t label = 0;
    std::string number, name;  ///< number: attribute `number`, or empty
    std::size_t level = 0;     ///< index into the given levels
    RoomUse use = RoomUse::Unknown;
    /// m2, see roomFloorAreas(); from a section of its voxels if `isExact` is false; 0: unknown.
    double area = 0;
    std::optional<double> stated{};  ///< m2: the area that the file states, see statedFloorArea()
    double height = 0;               ///< metres, from its lowest to its highest point
    double volume = 0;               ///< m3; 0: unknown
    double countedArea = 0;          ///< m2 in sums: `area` without the floors of smaller rooms in it; 0: a zone
    double countedVolume = 0;        ///< m3 in sums
    double unclaimedArea = 0;  ///< m2 of a zone that no smaller room claims, by its share of the volume; in no sum
    bool isExact = false;      ///< from a closed mesh; otherwise from a section of its voxels
    bool isZone = false;       ///< not a room, see RoomShare
    bool isShared = false;     ///< smaller rooms claim a part of it, see RoomShare
};

/// Sums of a level, m2. Space that rooms share counts once, for the smallest one.
struct LevelArea {
    double gross = 0, net = 0, construction = 0;
    double use = 0, technical = 0, traffic = 0, unknown = 0;  ///< parts of `net`
    double grossBound = 0;  ///< error bound of `gross`, without that of the floor: sum of SectionComponent::areaBound
    std::size_t rooms = 0;  ///< without zones
    bool isExact = false;   ///< floor, gross area and all rooms are from meshes
    /// Whether the level has rooms. Others, such as foundations and roofs, do not count as floors.
    bool isFloor = false;
    /// Whether construction is cut. Otherwise the model has only rooms, and `gross` and `construction` are unknown.
    bool isGrossKnown = false;

    /// Whether the rooms have more area than the plan encloses, so that `construction` is unknown.
    [[nodiscard]] bool netExceedsGross() const noexcept;
};

/// All components of one class and IFC type, with their parts that have a style of their own, such as panes.
struct ComponentSum {
    /// `type` is the attribute `ifcType`, otherwise the word in `function` of a constructive element or an installation,
    /// otherwise empty.
    std::string className, type;
    std::size_t count = 0;
    double area = 0;    ///< m2: sum of projections along the normal of each one's largest face; 0 without meshes
    double volume = 0;  ///< m3: of solids
};

struct FloorAreas {
    std::vector<RoomArea> rooms;    ///< by level, number, name
    std::vector<LevelArea> levels;  ///< one per given level
    std::vector<ComponentSum>
        components;  ///< by class and type; without spaces, notes and features that have no voxels
    [[nodiscard]] LevelArea total() const noexcept;  ///< of levels that are floors
};

class DrawingTables;  // drawing_tables.hpp

/// Measures the floors. Space that several rooms claim counts once, see RoomShare. Rooms lower than 1.5 m are voids and do not count; nor do spaces that are named after a roof,
/// such as "Roof". For the level of a room, see levelsOfLabels().
/// Storeys and units do not count as rooms.
/// \param levels   of findLevels()
/// \param threads  0: all cores; the result does not depend on it
/// \param tables   of the volume, or null: they are made
/// \return the areas, or an error of drawSection()
/// Cost: O(triangles), and one section per level.
[[nodiscard]] Result<FloorAreas> measureFloorAreas(const volume::SemanticVolume& volume,
                                                   const std::vector<BuildingLevel>& levels, int threads = 0,
                                                   const DrawingTables* tables = nullptr);

/// Reports levels whose rooms have more area than their plan encloses (NetExceedsGross), and levels with zones or
/// rooms that share space (RoomsShareSpace).
void reportAreas(const FloorAreas& areas, const std::vector<BuildingLevel>& levels,
                 const volume::SemanticVolume& volume, Diagnostics& log);

}  // namespace svt::drawing
