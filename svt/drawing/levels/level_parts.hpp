#pragma once
/// \file
/// The parts of a building by which levels are found: rooms, slabs, walls.

#include <svt/drawing/storey_floors.hpp>
#include <svt/volume/label_table.hpp>

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace svt::drawing {

inline constexpr double kLowestRoom = 1.5;     ///< metres: lower spaces are voids
inline constexpr double kSmallestFloor = 1;    ///< m2
inline constexpr double kSameStorey = 1.2;     ///< metres: floors closer than this can be one level
inline constexpr double kFloorBuildUp = 0.3;   ///< metres: a declared level and the floor of rooms may differ by it
inline constexpr double kCutAboveFloor = 1.1;  ///< metres

/// A room, but not a unit or a storey.
[[nodiscard]] bool isRoomSpace(const volume::Label& label);
/// A room of at least 1.5 m and 1 m2.
[[nodiscard]] bool isRoomOfSize(const volume::Label& label, const LabelExtent& extent);
/// A slab by class or IFC type, or a floor that is a surface. Slabs of roofs do not count.
[[nodiscard]] bool isFloorSlab(const volume::Label& label);
/// A wall by class, IFC type or function.
[[nodiscard]] bool isWallPart(const volume::Label& label);
/// The values of the given attributes that are texts, in lower case, each after a blank.
[[nodiscard]] std::string lowerTexts(const volume::Label& label, std::initializer_list<std::string_view> names);
/// A number of an attribute; nothing if the label has no such attribute, or it is not a number.
[[nodiscard]] std::optional<double> numberOf(const volume::Label& label, std::string_view name);

}  // namespace svt::drawing
