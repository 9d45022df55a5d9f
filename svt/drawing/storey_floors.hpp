#pragma once
/// \file
/// Floors of rooms and storeys: the one place where plans, sections, sheets and floor areas have them from.
///
/// They come from the meshes that a volume keeps and from the elevations that storeys declare, so they do not depend on the
/// grid. Without meshes the voxels tell them, to one voxel; each height says so by its bound.

#include <svt/analyze/selection.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace svt::drawing {

/// Where a label itself lies along the grid's axes, metres from the grid's lower corner.
struct LabelExtent {
    Box3d box;             ///< empty where the label has neither a mesh nor voxels
    double floor = 0;      ///< of a space: the height of most of its floor; of others, and on slopes, box.min.z
    double floorArea = 0;  ///< m2 at that height; of voxels and slopes that of the box seen from above
    double bound = 0;      ///< of all heights here: 0 of meshes, one voxel of voxels
};

/// The extents of all labels; entry l is label l. A space stands on the height at which most of the area of its faces lies
/// that look down, so the recess of a hatch or a shaft is not its floor.
/// Cost: O(triangles, n log n of those of spaces), and that of analyze::labelBoxes().
[[nodiscard]] std::vector<LabelExtent> labelExtents(const volume::SemanticVolume& volume);

/// The floor on which the most area of rooms stands, of floors from `low` up to below `high`; those within 1 cm are one.
struct FloorHeight {
    double at = 0;  ///< metres above the grid's lower corner
    double area = 0;
    double bound = 0;
};
/// \param floors  the lowest first
[[nodiscard]] std::optional<FloorHeight> mainFloor(std::span<const FloorHeight> floors, double low, double high);
/// The floors of all rooms that are 1.5 m high or more, and 1 m2 large or more, the lowest first.
[[nodiscard]] std::vector<FloorHeight> roomFloors(const volume::SemanticVolume& volume,
                                                  std::span<const LabelExtent> extents);

/// A storey, and its heights in metres above the grid's lower corner.
struct StoreyHeights {
    std::uint32_t label = 0;
    double floor = 0;         ///< on which most of its rooms stand
    double low = 0, top = 0;  ///< of its rooms and other spaces; without any, of all that is on it
    double bound = 0;  ///< by which `floor` may be off: 0 from meshes and declared elevations, one voxel from voxels
};

/// Heights of a storey by name or id. The floor is the first that there is of
///     1. the floor of most of its rooms, else of its other spaces
///     2. the floor of most rooms of the model that begin up to 1.2 m above the lowest point of the storey
///     3. the storey's attribute `elevation` (metres in the CRS), if it lies within the storey's extent
///     4. the lowest point of what is on the storey
/// \return the heights, or NothingSelected if there is no such storey, or it has neither meshes nor voxels
[[nodiscard]] Result<StoreyHeights> storeyHeights(const std::string& storey, const volume::SemanticVolume& volume);
/// The same with existing rows, which must be those of volume.labels.
[[nodiscard]] Result<StoreyHeights> storeyHeights(const std::string& storey, const volume::SemanticVolume& volume,
                                                  const analyze::LabelRows& rows);

/// Where the voxels of a storey's spaces begin and end, metres above the grid's lower corner: the part that a picture shows of
/// the storey. The voxels of ceilings and other surfaces that bound the spaces are outside.
/// \return the heights, or NothingSelected if there is no such storey, or it has no voxels
[[nodiscard]] Result<std::pair<double, double>> storeyVoxels(const std::string& storey,
                                                             const volume::SemanticVolume& volume,
                                                             const analyze::LabelRows& rows);

/// All storeys with meshes or voxels, with their heights as storeyHeights() gives them; the lowest first, those of equal
/// height by label.
[[nodiscard]] std::vector<StoreyHeights> findStoreys(const volume::SemanticVolume& volume);

}  // namespace svt::drawing
