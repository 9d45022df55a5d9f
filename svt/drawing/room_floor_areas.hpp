#pragma once
/// \file
/// The floor area of each room: the one number for stamps in plans, schedules, tables and CSV. Also the space that rooms
/// share.

#include <svt/volume/semantic_volume.hpp>

#include <optional>
#include <vector>

namespace svt::drawing {

/// m2 by label: the faces of a room's closed mesh that look down, seen from above; faces above each other count once. Furniture, and other parts that
/// claim space of the room, reduce nothing. Empty for features that are not rooms, without closed mesh, or lower than
/// 1.5 m.
/// Cost: O(triangles).
[[nodiscard]] std::vector<std::optional<double>> roomFloorAreas(const volume::SemanticVolume& volume);

/// The part of a room that no smaller room claims. The first of two equal rooms counts as the smaller one.
struct RoomShare {
    double own = 1;  ///< this part of the room's volume, 0 to 1
    /// Whether `own` is at most a half. Such rooms are zones: a flat, or a gross area, that the file stores as a room. Plans
    /// and sums omit them.
    bool isZone = false;
    bool isShared = false;  ///< a smaller room claims more than 0.01 % of the volume
};

/// How rooms share space, by label. Labels that are not rooms, or have no volume, share nothing.
/// Cost: that of analyze::exclusiveMeasures() for the rooms.
[[nodiscard]] std::vector<RoomShare> roomShares(const volume::SemanticVolume& volume);

/// The floor area that the file states for a room, m2: the first of the quantities NetFloorArea, FloorArea, Area and
/// GrossFloorArea of any property set. Nothing without one, or with a value that is not positive.
[[nodiscard]] std::optional<double> statedFloorArea(const volume::Label& label);

}  // namespace svt::drawing
