#pragma once
/// \file
/// Turns the faces of an open shell outwards: by what they mean, and by what they see.

#include <svt/mesh/mesh_set.hpp>
#include <svt/model/classes.hpp>

#include <cstdint>
#include <span>

namespace svt::mesh {

/// Turns patches of an open shell so that they look outwards. A patch is what hangs together by edges with two uses
/// that run in opposite directions, so it looks one way already.
///
///       ^  ^  ^   escape          Rays from points of the patch to both sides, each with its reverse: the side
///        \ | /                    whose rays leave the shell is the front (Takayama, Jacobson, Kavan & Sorkine
///     o===patch===o   <-- turned  2014, "A Simple Method for Correcting Facet Orientations in Polygon Meshes
///        / | \                    Based on Ray Casting"). Where as many escape on both sides, in a void above all,
///     --+--+--+--     blocked     the side from where rays cross an even number of faces is the front.
///
/// What the faces mean counts half as much as rays that all escape on one side: a GroundSurface looks down, a
/// RoofSurface up. So the underside of an eaves, called RoofSurface as well, still looks down. Without a majority a
/// patch stays as it is, and so does one that would agree less with its neighbours, by the length of open edges, or that is
/// less than a thousandth of the shell.
/// \param facings  per triangle of the mesh: which way it should look; empty: nothing is known
/// \return count of reversed triangles
/// Cost: O((patches + log triangles) * kRays): at most 8 points and 16 pairs of rays for each patch. Directions are
/// fixed, so the result is the same on every machine.
std::uint32_t orientFaces(ObjectMesh& mesh, std::span<const model::Facing> facings);

/// True if an open shell encloses something: behind at least half of its area, halfway to the next face that looks the
/// other way, the generalized winding number (Jacobson, Kavan & Sorkine 2013) is 1/2 or more.
/// \pre the faces look outwards
/// Cost: at most 64 faces are tried: O(64 * triangles).
[[nodiscard]] bool enclosesVolume(const ObjectMesh& mesh);

}  // namespace svt::mesh
