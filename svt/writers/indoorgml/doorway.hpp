#pragma once
/// \file
/// Doors as cell spaces: the space through the wall of a door, from the room in front of it to the room behind it.
///
///      room a             room a
///     _______________    _______________
///     #### leaf #####    ####|     |####     the box around the leaf, stretched along its thin side to the rooms that
///     ####======#####    ####| box |####     are near enough, with only air and the door between
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

/// Largest distance from the faces of a door to those of its wall, metres.
inline constexpr double kReveal = 0.8;

/// A convex part of a common face, counter-clockwise seen from the cell that comes first.
using FacePiece = std::vector<Vec3d>;

struct Doorway {
    CellShape shape;  ///< a box
    /// The rooms that its ends touch, with the common face; none if they touch only along edges.
    struct Contact {
        std::size_t room = 0;  ///< index into the list of rooms
        std::vector<FacePiece> pieces;
    };
    std::vector<Contact> contacts;
    /// Per end, whether it touches a room.
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
