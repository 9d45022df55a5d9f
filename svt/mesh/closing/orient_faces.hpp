#pragma once
/// \file
/// Turns the faces of an open shell outwards, by their class and by rays.

#include <svt/mesh/mesh_set.hpp>
#include <svt/model/classes.hpp>

#include <cstdint>
#include <span>

namespace svt::mesh {

/// Turns patches of an open shell so that they face outwards. The faces of a patch are connected by edges with two uses
/// in opposite directions, so the orientation within a patch is consistent.
///
///       ^  ^  ^   escape          Rays from points of the patch to both sides, each with its reverse: the side
///        \ | /                    whose rays leave the shell is the front (Takayama, Jacobson, Kavan & Sorkine
///     o===patch===o   <-- turned  2014, "A Simple Method for Correcting Facet Orientations in Polygon Meshes
///        / | \                    Based on Ray Casting"). Where as many escape on both sides, in a void above all,
///     --+--+--+--     blocked     the side from where rays cross an even number of faces is the front.
///
/// The class of the faces (a GroundSurface faces down, a RoofSurface up) counts half as much as rays that all escape on
/// one side. So the underside of eaves, which also is a RoofSurface, still faces down. A patch stays unchanged without
/// a majority, if turning it would increase the length of open edges to its neighbours, or if it is less than a
/// thousandth of the shell.
/// \param orientations  expected orientation per triangle of the mesh; empty: unknown
/// \return number of reversed triangles
/// Cost: O((patches + log triangles) * kRays): at most 8 points and 16 pairs of rays per patch. Directions are fixed,
/// so the result is the same on every machine.
std::uint32_t orientFaces(ObjectMesh& mesh, std::span<const model::Orientation> orientations);

/// True if an open shell encloses something: behind at least half of its area, halfway to the next face with the
/// opposite orientation, the generalized winding number (Jacobson, Kavan & Sorkine 2013) is 1/2 or more.
/// \pre the faces are oriented outwards
/// Cost: at most 64 faces are tried: O(64 * triangles).
[[nodiscard]] bool enclosesVolume(const ObjectMesh& mesh);

}  // namespace svt::mesh
