#pragma once
/// \file
/// Places stamps of rooms in a plan: within the room and clear of lines; small rooms have theirs outside, with a leader.

#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/marks/free_space.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace svt::writers {

struct RoomStamp {
    std::uint32_t label = 0;
    std::vector<std::string> lines;  ///< from above; the first one identifies the room
};

struct PlacedStamps {
    MarkShapes shapes;
    std::vector<std::size_t> shortened;     ///< indices of stamps with only their first line
    std::vector<std::size_t> withoutPlace;  ///< indices of stamps without a place
};

/// Tries these places for each stamp, in this order, and takes the place in `space`:
///
///     1. in its room, clear of lines, in 2.5, 2 and 1.8 mm, then in two lines; lines above the cut do not count
///     2. in its room, over up to six lines of furniture, which the stamp interrupts
///     3. outside of all rooms, with a leader that crosses no other room
///     4. only the first line: in the room, or outside as before
///     5. outside, with a leader that crosses other rooms by the shortest way
///     6. only the first line, likewise
/// \param millimetres  on paper per metre
/// \param allowed      limits of places outside of rooms
[[nodiscard]] PlacedStamps placeStamps(const drawing::SectionDrawing& drawing, std::span<const RoomStamp> stamps,
                                       double millimetres, const MarkBox& allowed, FreeSpace& space);

}  // namespace svt::writers
