#pragma once
/// \file
/// Section planes, parsed from text.

#include <svt/analyze/selection.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace svt::drawing {

/// World space; the side to which `normal` points is cut away.
struct SectionPlane {
    Vec3d normal{0, 0, 1};  ///< length 1
    Vec3d point{};          ///< on the plane
    double bound = 0;       ///< metres: how far it may be off along its normal, as a plane over the floor of voxels is
    friend bool operator==(const SectionPlane&, const SectionPlane&) = default;
};

/// Parses a plane through `volume`, one of
///     z=1.2  z>1.2      cut away above 1.2 m, measured along the grid's z axis from its lower corner; x and y likewise
///     z<1.2             cut away below
///     z=abs(112.3)      the same in coordinates of the model's CRS; x and y only where the grid is not turned
///     storey=EG+1.1     cut away above 1.1 m over the floor of that storey (by name or id; see Query for what is one);
///                       without a number, above 1 m; see storey_floors.hpp for the floor
///     A,B,C,D           cut away where A x + B y + C z + D > 0; world axes, metres from the grid's lower corner
/// \return the plane, or
///         - BadSection       the text is none of these, a number is not finite, the normal is zero, or the plane
///                            misses the volume (the message names the possible range)
///         - NothingSelected  no such storey, or none with voxels (names the nearest)
[[nodiscard]] Result<SectionPlane> parseSectionPlane(std::string_view text, const volume::SemanticVolume& volume);
/// The same with existing rows, which must be those of volume.labels.
[[nodiscard]] Result<SectionPlane> parseSectionPlane(std::string_view text, const volume::SemanticVolume& volume,
                                                     const analyze::LabelRows& rows);

/// The default plane of a plan: 1.1 m above the lowest level that findLevels() finds; or at half the volume's height, if
/// it finds none, or the volume ends below that.
[[nodiscard]] SectionPlane defaultSectionPlane(const volume::SemanticVolume& volume);

/// The plane of an elevation: upright before the model, 10 mm from its meshes or voxels. It faces `side`, or, in a turned
/// grid, that side of the grid which is nearest to it.
/// \param side  "north", "east", "south" or "west": where the eye is; y of world space points north
/// \return the plane, or BadSection if the side is none of these
[[nodiscard]] Result<SectionPlane> elevationPlane(std::string_view side, const volume::SemanticVolume& volume);

/// How far a plane that lies in faces of the model has to move to the side that is kept, so that a picture shows one side
/// of them everywhere and not now one, now the other. In faces is what is within 0.2 mm, or 1/170 of a voxel where that is
/// more, since faces are rounded to 1/256; it moves by 2.5 times that.
/// \return metres, > 0; 0 where it lies in no face, or the volume does not know the planes of its faces
/// Cost: O(planes of the volume).
[[nodiscard]] double hairOffFaces(const SectionPlane& plane, const volume::SemanticVolume& volume);
/// The plane, moved by that.
[[nodiscard]] SectionPlane keptOffFaces(SectionPlane plane, const volume::SemanticVolume& volume);

/// Whether the plane intersects the voxels of `grid`.
[[nodiscard]] bool meetsGrid(const SectionPlane& plane, const volume::Grid& grid);

}  // namespace svt::drawing
