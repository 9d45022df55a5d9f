#pragma once
/// \file
/// Dimensions of a plan or an upright section, as architects draw them. Chains run around a plan: the parts of the
/// building that are visible from each side.
///
///     +==[ ]====+=====[     ]==+        walls and openings of the face that is seen
///     |         |              |
///     |  room   |     room     |
///
///     |--|-|----|-----|-----|--|        row 0: alternating walls and openings, and steps of the face
///     |-|-----|---|----------|-|        row 1: walls and rooms behind the face
///     |------------------------|        row 2: overall

#include <svt/drawing/building_levels.hpp>
#include <svt/drawing/dimension/border_strips.hpp>
#include <svt/drawing/dimension/part_roles.hpp>
#include <svt/drawing/drawing_tables.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace svt::drawing {

/// Adds chains to a plan or an upright section, and to a plan the dimensions of rooms and the heights of openings.
/// \param drawing  with borders, lines and doors
/// \param options  unit and levels
/// \param tables   of the volume
/// Cost: that of findPlanChains(), findHeightChains(), findRoomDimensions() and findOpeningHeights(), and without levels
/// that of findLevels().
void addDimensions(SectionDrawing& drawing, const volume::SemanticVolume& volume, const SectionOptions& options,
                   const DrawingTables& tables);

/// Finds the chains of a plan.
///
/// A side is viewed along lines perpendicular to it. The first wall or filling on each line is the face. A casing or a
/// shutter before a wall does not count. A stop is a place where walls and fillings alternate, or where the face steps
/// by 50 mm. Behind a face up to 1 m thick follow the rooms, or the air between walls if no rooms are drawn. Only the
/// roles Space, Opening and Hull count; overall lengths are those of the hull. If less than 60 % of the length of walls
/// runs along u or v, a side has only its overall length. If as much runs along other axes, within a degree, the
/// building is turned and has no chains. Oblique parts of a face have no stops. Parts below 15 mm,
/// chains of more than 80 parts, and chains that repeat the next one are omitted.
/// \param roles  of rolesIn()
/// Cost: O(borders * stops that one spans); beyond 50 million of these, only the overall length is given.
[[nodiscard]] std::vector<DimensionChain> findPlanChains(const SectionDrawing& drawing,
                                                         const std::vector<PartRole>& roles);

/// Finds the chains of an upright section.
///
///     left:   openings with their parapets and lintels; clear heights of the largest room per level, and the slabs
///             between them; heights of storeys; overall height of the hull
///     right:  openings
///
/// Only sides with openings have a chain of openings.
[[nodiscard]] std::vector<DimensionChain> findHeightChains(const SectionDrawing& drawing,
                                                           const volume::SemanticVolume& volume,
                                                           const std::vector<PartRole>& roles,
                                                           std::span<const BuildingLevel> levels);

/// Finds the clear width and depth of each room that a plan cuts: those that the largest part of the room has, between
/// walls and other rooms. Furniture does not count. Rooms that are oblique, or narrower than 0.5 m, are omitted.
/// Cost: O(borders + rooms * borders at their heights).
[[nodiscard]] std::vector<RoomDimension> findRoomDimensions(const SectionDrawing& drawing,
                                                            const volume::SemanticVolume& volume);

/// The floor and the ceiling that the largest part of a room has in an upright section, v in metres. Under a slope, the
/// lowest and the highest point.
/// \param strips  of the section
/// \param room    a label, and one of its polygons
/// Cost: O(borders at the heights of the room).
[[nodiscard]] std::pair<double, double> findClearHeight(const BorderStrips& strips,
                                                        const volume::SemanticVolume& volume,
                                                        const SectionPolygon& polygon, std::uint32_t room);

/// Finds the lower and upper edges of the openings in walls around the windows and doors that a plan cuts. They are the
/// faces of the hull below and above the middle of the window, otherwise the ends of the window itself.
/// \param tables  of the volume
/// Cost: O(openings + runs of triangles + triangles of the runs near the plane that contain an opening in u). An opening
/// without hull within 8 m above and below searches all triangles.
[[nodiscard]] std::vector<OpeningHeights> findOpeningHeights(const SectionDrawing& drawing,
                                                             const volume::SemanticVolume& volume,
                                                             const std::vector<PartRole>& roles,
                                                             std::span<const BuildingLevel> levels,
                                                             const DrawingTables& tables);

}  // namespace svt::drawing
