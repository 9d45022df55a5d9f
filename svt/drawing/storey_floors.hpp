#pragma once
/// \file
/// Floors of rooms and storeys: the only source for plans, sections, sheets and floor areas.
///
/// They come from the meshes that a volume stores and from the elevations that storeys declare, so they do not depend
/// on the grid. Without meshes, they come from voxels and may be off by one voxel. Each height has its error bound.

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

/// The extent of a label itself (without its children) along the grid's axes, metres from the grid's lower corner.
struct LabelExtent {
    Box3d box;             ///< empty if the label has neither a mesh nor voxels
    double floor = 0;      ///< spaces: the height of most of the floor; others, and on slopes: box.min.z
    double floorArea = 0;  ///< m2 at that height; for voxels and slopes, of the box seen from above
    double bound = 0;      ///< error bound of all heights: 0 from meshes, one voxel from voxels
};

/// The extents of all labels, by index. The floor of a space is the height at which its downward faces have the most
/// area, so the recess of a hatch or a shaft does not count as its floor.
/// Cost: O(triangles + n log n for the n triangles of spaces), and that of analyze::labelBoxes().
[[nodiscard]] std::vector<LabelExtent> labelExtents(const volume::SemanticVolume& volume);

/// The floor with the largest area of rooms, among the floors from `low` up to below `high`. Floors within 1 cm count
/// as one.
struct FloorHeight {
    double at = 0;  ///< metres above the grid's lower corner
    double area = 0;
    double bound = 0;
};
/// \param floors  from the lowest
[[nodiscard]] std::optional<FloorHeight> mainFloor(std::span<const FloorHeight> floors, double low, double high);
/// The floors of all rooms with a height of at least 1.5 m and an area of at least 1 m2, from the lowest.
[[nodiscard]] std::vector<FloorHeight> roomFloors(const volume::SemanticVolume& volume,
                                                  std::span<const LabelExtent> extents);

/// The storey of each label: the nearest one through parents and groups, kNoLabel without one. A storey is its own.
/// Containment decides, not height: a roof belongs to its storey even if its eaves hang below that storey's floor.
/// Cost: O(labels), times the number of groups above a label.
[[nodiscard]] std::vector<std::uint32_t> storeysOfLabels(const volume::LabelTable& table);

/// The source of a storey's floor, in order of precedence.
enum class FloorSource : std::uint8_t {
    Declared,  ///< the level that the file states, and that most rooms or slabs confirm
    Rooms,     ///< floor of most of its rooms
    Slabs,     ///< top of most of its slabs
    Walls,     ///< foot of most of its walls
    Lowest     ///< its lowest point
};

/// A storey, and its heights in metres above the grid's lower corner.
struct StoreyHeights {
    std::uint32_t label = 0;
    double floor = 0;
    double low = 0, top = 0;  ///< of its rooms and other spaces; without spaces, of all its features
    double bound = 0;         ///< error bound of `floor`: 0 from meshes and declared levels, one voxel from voxels
    FloorSource source = FloorSource::Lowest;
    std::optional<double> declared;  ///< the level that the file states, even if it is not used
    /// Floor of most of its rooms. Without rooms, the top of most of its slabs near the declared level.
    std::optional<double> measured;
    double roomArea = 0;       ///< m2 of the floors of its rooms
    std::size_t features = 0;  ///< number of features with meshes or voxels on the storey

    /// Whether the file states a level that its rooms, slabs or other parts contradict; then `floor` is theirs.
    [[nodiscard]] bool disagrees() const noexcept { return declared && source != FloorSource::Declared; }
};

/// Heights of a storey by name or id. Its features are those that storeysOfLabels() gives it.
///
/// The level that the file states is the attribute `modelElevation` (IFC). The floor is that level if it is at most
/// 0.3 m away from the floor of most rooms; this allows for the floor construction. Otherwise it is the floor of most
/// rooms. Without rooms, the top of most slabs up to 1.2 m above or below the level replaces it if they are more than
/// 0.3 m apart. The level does not count if the features of the storey do not reach it.
///
/// Storeys without such a level take the first of:
///     1. the floor of most of its rooms, otherwise of its other spaces
///     2. the floor of most rooms of the model that begin up to 1.2 m above the lowest point of the storey
///     3. the attribute `elevation` (metres in the CRS), if it lies within the storey's extent and is not one of IFC
///     4. the top of most of its lowest slabs
///     5. the foot of most of its walls
///     6. the lowest point of its features
/// \return the heights, or NothingSelected if there is no such storey, or it has neither meshes nor voxels
[[nodiscard]] Result<StoreyHeights> storeyHeights(const std::string& storey, const volume::SemanticVolume& volume);
/// The same with existing rows, which must be those of volume.labels.
[[nodiscard]] Result<StoreyHeights> storeyHeights(const std::string& storey, const volume::SemanticVolume& volume,
                                                  const analyze::LabelRows& rows);

/// The lower and upper end of the voxels of a storey's spaces, metres above the grid's lower corner: the part of the
/// storey that a picture shows. Ceilings and other surfaces that bound the spaces are outside. So are parts that lie
/// more than 0.3 m below its floor: pits of lifts, foundations.
/// \return the heights, or NothingSelected if there is no such storey, or it has no voxels
[[nodiscard]] Result<std::pair<double, double>> storeyVoxels(const std::string& storey,
                                                             const volume::SemanticVolume& volume,
                                                             const analyze::LabelRows& rows);

/// All storeys with meshes or voxels, with the heights of storeyHeights(). Ordered by height from the lowest, then by
/// label.
[[nodiscard]] std::vector<StoreyHeights> findStoreys(const volume::SemanticVolume& volume);

}  // namespace svt::drawing
