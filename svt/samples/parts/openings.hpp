#pragma once
/// \file
/// Windows and doors: the hole in the wall, the filling, and the reveal that becomes part of the room.

#include <svt/samples/parts/plan.hpp>

#include <string>

namespace svt::samples {

/// A rectangular hole through a wall.
///
///     outside | wall | room           depth runs from 0 at the wall's first face (outside, or room A)
///             0    thickness          to `thickness` at the second (inside, or room B)
struct Opening {
    enum class Normal : std::uint8_t { PlusX, MinusX, PlusY, MinusY };  ///< direction of growing depth
    Normal normal = Normal::PlusX;
    Length base = 0;  ///< x or y at depth 0
    Length thickness = 0;
    Length along0 = 0, along1 = 0;  ///< y or x range
    Length z0 = 0, z1 = 0;

    /// The box from depth `d0` to `d1`, inset by `sides` left and right, `bottom` and `top`.
    [[nodiscard]] Piece piece(Length d0, Length d1, Length sides = 0, Length bottom = 0, Length top = 0) const;
    /// The box from depth `d0` to `d1` over the range [a0, a1] x [b0, b1] of along and z.
    [[nodiscard]] Piece part(Length d0, Length d1, Length a0, Length a1, Length b0, Length b1) const;
};

/// Cuts the hole into `wall` and places a window of `columns` x `rows` panes in it, 120 mm behind the outer face:
/// solid 0 is the frame with its bars, the others are the panes. The inner reveal becomes part of `room`.
/// \return the window
int addWindow(Plan& plan, int wall, int room, const Opening& opening, int columns, int rows, std::string id,
              std::string name);

/// Cuts the hole into `wall` and places a door in it: solid 0 is the frame (as deep as the wall), solid 1 the leaf,
/// flush with depth 0. The rest of the doorway becomes part of `room`, on the far side.
/// \return the door
int addDoor(Plan& plan, int wall, int room, const Opening& opening, std::string id, std::string name);

/// Cuts an open passage into `wall` that becomes part of `room`.
void addPassage(Plan& plan, int wall, int room, const Opening& opening);

}  // namespace svt::samples
