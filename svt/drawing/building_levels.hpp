#pragma once
/// \file
/// Levels of a building: the heights of its plans, sections, areas and level marks.

#include <svt/core/diagnostics.hpp>
#include <svt/drawing/storey_floors.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace svt::drawing {

/// A level of the building: one storey, or storeys of several buildings at about the same height.
struct BuildingLevel {
    std::string name;  ///< name of the storey; empty if the model has no storeys
    double floor = 0;  ///< metres above the grid's lower corner
    double bound = 0;  ///< error bound of `floor`, metres: 0 from meshes and declared levels, see storey_floors.hpp
    std::vector<std::uint32_t> storeys{};  ///< labels of its storeys, the first gives name and floor; empty: no storeys
    /// The floor of most of its rooms, if it differs from `floor` by more than a centimetre or, without meshes, a voxel:
    /// the finished floor above a declared raw slab.
    std::optional<double> roomFloor{};
    bool hasRooms = false;  ///< rooms of at least 1.5 m and 1 m2
    bool isGround = false;  ///< its floor is the zero level of drawings; one level of a model has it
};

/// The levels of the model, from the lowest: its storeys, as returned by findStoreys(). Storeys of different buildings
/// form one level if their floors are less than 1.2 m apart. So do storeys of one building if one of them has no rooms,
/// such as a roof. The storey with most room area gives name and floor; without rooms, one whose name has no word for
/// foundations. Rooms that the plan of their storey does not cut have a level of their own with the name of the storey,
/// if they have at least a fifth of its area.
///
/// Without storeys, levels are floors of rooms that are at least 1.5 m high: first the floor with most area, then those
/// of rooms that are 1.2 m or more away from it. A room that the plan of a level cuts, and that has less than a fifth of
/// its area, belongs to that level: a pit, a shaft. Without rooms, levels are the tops of slabs and floors of 4 m2 or
/// more, except roofs.
///
/// The ground floor is the first of these that the model has:
///     1. a level with a word for it in its name
///     2. the level that declares the `elevation` (IFC) nearest to 0, up to 1 m
///     3. the level above `storeysBelowGround` others
///     4. the lowest level with rooms whose name has no word for basements or foundations
///     5. the lowest level
[[nodiscard]] std::vector<BuildingLevel> findLevels(const volume::SemanticVolume& volume);

/// The floor of the ground floor, metres above the grid's lower corner: the zero level of drawings. 0 without levels.
[[nodiscard]] double zeroLevel(std::span<const BuildingLevel> levels) noexcept;

/// The level of each label, as an index into `levels`: that of its storey; of several, the highest that is at most 0.3 m
/// above the label's floor. A label without storey belongs to the highest
/// level at most 0.3 m above its floor. The next level takes it if the label begins nearer to that one and reaches its
/// plan.
/// \return one index per label; 0 for labels below all levels and for labels without extent
[[nodiscard]] std::vector<std::size_t> levelsOfLabels(const volume::SemanticVolume& volume,
                                                      std::span<const BuildingLevel> levels,
                                                      std::span<const LabelExtent> extents);

/// Reports storeys whose declared level contradicts their rooms, slabs or other parts, with both heights, and storeys
/// whose rooms stand on several floors (StoreyLevelDiffers).
void reportStoreys(const volume::SemanticVolume& volume, Diagnostics& log);

}  // namespace svt::drawing
