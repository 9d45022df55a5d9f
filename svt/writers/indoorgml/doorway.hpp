#pragma once
/// \file
/// Doors as cell spaces: the space through the wall that a door stands in, from the room before it to that behind it.
///
///      room a             room a
///     _______________    _______________
///     #### leaf #####    ####|     |####     the box around the leaf, stretched along its thin side to the rooms that
///     ####======#####    ####| box |####     are near enough, with nothing but air and the door between
///     ####      #####    ####|     |####
///     ---------------    ---------------
///      room b             room b

#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/indoorgml/cell_shape.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace svt::writers::indoor {

/// How far the faces of a door may stand back behind those of its wall, metres.
inline constexpr double kReveal = 0.8;

/// A convex part of a common face, counter-clockwise seen from the cell that comes first.
using FacePiece = std::vector<Vec3d>;

struct Doorway {
    CellShape shape;  ///< a box
    /// The rooms that its ends touch, with the common face; none where they touch along edges only.
    struct Contact {
        std::size_t room = 0;  ///< into the list of rooms
        std::vector<FacePiece> pieces;
    };
    std::vector<Contact> contacts;
    /// Per end whether a room is there.
    std::array<bool, 2> hasRoom{};
};

/// \param door   shape of the door
/// \param label  of the door
/// \param rooms  bodies of all rooms
/// \return empty if no room is at either end, or there is no space between them
/// Cost: O(triangles of the rooms near it), and some hundred samples.
[[nodiscard]] std::optional<Doorway> findDoorway(const volume::SemanticVolume& volume,
                                                 const std::vector<std::uint32_t>& labelOfScalar, const CellShape& door,
                                                 std::uint32_t label, const std::vector<const CellBody*>& rooms,
                                                 const std::vector<Box3d>& roomBounds);

/// The common faces of two bodies that touch, counter-clockwise seen from `a`, by plane: pieces of one list lie in one.
[[nodiscard]] std::vector<std::vector<FacePiece>> commonFaces(const CellBody& a, const CellBody& b);

/// m2.
[[nodiscard]] double areaOf(const std::vector<FacePiece>& pieces);

}  // namespace svt::writers::indoor
