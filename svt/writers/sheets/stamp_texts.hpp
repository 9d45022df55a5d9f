#pragma once
/// \file
/// The lines of room stamps: number and name, area, height, floor finish, height of the finished floor.

#include <svt/writers/marks/room_stamps.hpp>
#include <svt/writers/sheets/sheet_details.hpp>

#include <string>
#include <vector>

namespace svt::writers {

/// The stamps of all spaces that a plan or section cuts. Sections have only names. Areas and heights are those of the
/// table of rooms; a room whose height varies has "h ≤" before its greatest one.
[[nodiscard]] std::vector<RoomStamp> roomStamps(const ViewContext& context);

/// The floor finish of a room: a property of it with such a name, or the material of a covering that it contains; empty:
/// not stated.
[[nodiscard]] std::string floorFinish(const volume::LabelTable& table, std::uint32_t room);

}  // namespace svt::writers
