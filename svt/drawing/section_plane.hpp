#pragma once
/// \file
/// Section planes, parsed from text.

#include <svt/analyze/selection.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace svt::drawing {

/// World space; the side to which `normal` points is cut away.
struct SectionPlane {
    Vec3d normal{0, 0, 1};  ///< length 1
    Vec3d point{};          ///< on the plane
    double bound = 0;       ///< error bound along its normal, metres; > 0 for a plane above a floor of voxels
    friend bool operator==(const SectionPlane&, const SectionPlane&) = default;
};

/// Parses a plane through `volume`. The text is one of:
///     z=1.2  z>1.2      cut away above 1.2 m, along the grid's z axis from its lower corner; x and y likewise.
///     z<1.2             cut away below.
///     z=abs(112.3)      the same in coordinates of the model's CRS; x and y only if the grid is not rotated.
///     storey=EG+1.1     cut away 1.1 m above the floor of the storey with this name or id (see Query).
///                       Without a number: 1 m. For the floor, see storey_floors.hpp.
///     A,B,C,D           cut away where A x + B y + C z + D > 0; world axes, metres from the grid's lower corner.
/// \return the plane, or
///         - BadSection       the text has no such form, a number is not finite, the normal is zero, or the
///                            plane misses the volume (the message states the possible range).
///         - NothingSelected  no such storey, or none with voxels (the message suggests the nearest name).
[[nodiscard]] Result<SectionPlane> parseSectionPlane(std::string_view text, const volume::SemanticVolume& volume);
/// The same with existing rows, which must be those of volume.labels.
[[nodiscard]] Result<SectionPlane> parseSectionPlane(std::string_view text, const volume::SemanticVolume& volume,
                                                     const analyze::LabelRows& rows);

/// The default plane of a plan: 1.1 m above the ground floor of findLevels(). Without levels, or if the volume ends
/// below that height, half the height of the volume.
[[nodiscard]] SectionPlane defaultSectionPlane(const volume::SemanticVolume& volume);

/// The plane of an elevation: vertical, 10 mm in front of the meshes or voxels of the model. It faces the side of the
/// grid that is nearest to `side`.
/// \param side  one of compassNames(): the position of the eye, relative to true north (see north.hpp)
/// \return the plane, or BadSection for any other side
[[nodiscard]] Result<SectionPlane> elevationPlane(std::string_view side, const volume::SemanticVolume& volume);

/// The names of the four sides of the grid for elevationPlane(), clockwise from the one nearest to true north. They are
/// north, east, south and west, or north-east, south-east, south-west and north-west.
[[nodiscard]] std::array<std::string_view, 4> elevationSides(const volume::SemanticVolume& volume);

/// Distance that a plane in faces of the model must move to the kept side, so that a picture consistently shows one
/// side of these faces. A plane lies in a face if their distance is up to 0.2 mm, or 1/170 of a voxel if that is more,
/// because faces are rounded to 1/256. The plane moves by 2.5 times that limit.
/// \return metres, > 0; 0 if it lies in no face, or the volume does not store the planes of its faces
/// Cost: O(planes of the volume).
[[nodiscard]] double hairOffFaces(const SectionPlane& plane, const volume::SemanticVolume& volume);
/// The plane, moved by hairOffFaces().
[[nodiscard]] SectionPlane keptOffFaces(SectionPlane plane, const volume::SemanticVolume& volume);

/// Whether the plane intersects the voxels of `grid`.
[[nodiscard]] bool meetsGrid(const SectionPlane& plane, const volume::Grid& grid);

}  // namespace svt::drawing
