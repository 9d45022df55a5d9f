#pragma once
/// \file
/// The floor area of each room: the one number for stamps in plans, schedules, tables and CSV.

#include <svt/volume/semantic_volume.hpp>

#include <optional>
#include <vector>

namespace svt::drawing {

/// m2 by label: the faces of a room's closed mesh that look down, seen from above. Furniture, and other parts that
/// claim space of the room, reduce nothing. Empty for features that are not rooms, without closed mesh, or lower than
/// 1.5 m.
/// Cost: O(triangles).
[[nodiscard]] std::vector<std::optional<double>> roomFloorAreas(const volume::SemanticVolume& volume);

/// The floor area that the file states for a room, m2: the first of the quantities NetFloorArea, FloorArea, Area and
/// GrossFloorArea of any property set. Nothing without one, or with a value that is not positive.
[[nodiscard]] std::optional<double> statedFloorArea(const volume::Label& label);

}  // namespace svt::drawing
