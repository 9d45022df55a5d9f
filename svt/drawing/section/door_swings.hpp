#pragma once
/// \file
/// Doors in plans: leaves and the arcs that they swing through, if the model describes how they open.

#include <svt/drawing/section_drawing.hpp>

#include <vector>

namespace svt::drawing {

/// Symbols of the doors that a horizontal plane cuts. Reads two attributes per component: `operationType`, an
/// IfcDoorTypeOperationEnum (SINGLE_SWING_LEFT, DOUBLE_DOOR_SINGLE_SWING, SLIDING_TO_LEFT, ...), and `opensTowards`,
/// the direction of the y axis of its placement in degrees clockwise from north. Hinges are left or right when looking
/// in that direction, and leaves open to that side. The width is that of the cut door, including its frame. Leaves
/// start at the face of the cut door on the side to which they open.
/// \return the symbols by label; none for vertical planes, for other operations, and for doors that are
///         deeper than wide in that direction, because such a placement cannot belong to the door
[[nodiscard]] std::vector<DoorSwing> findDoorSwings(const SectionDrawing& drawing,
                                                    const volume::SemanticVolume& volume);

}  // namespace svt::drawing
