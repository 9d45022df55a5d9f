#pragma once
/// \file
/// The neighbours of the faces of objects: outside air, inside air, or other objects.
///
/// Each face is divided exactly by the closed meshes that lie in front of it, up to a tenth of a millimetre. So contacts
/// and the borders of free parts do not depend on voxels. Points that are spread evenly over a free part look for the air
/// in voxels: outside air, or inside air. Where a gap of up to 10 mm, a body without a closed mesh, or both kinds of air
/// are in front of one part, the points divide it. TouchingArea::countedArea has these areas.

#include <svt/quantities/quantities.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace svt::quantities {

/// Where a face looks. North is +y of the coordinate reference system. Faces within 45 degrees of up or down are top or
/// bottom, whatever their azimuth.
enum class Facing : std::uint8_t { N, NE, E, SE, S, SW, W, NW, Top, Bottom };
inline constexpr std::array<std::string_view, 10> kFacingNames{"n",  "ne", "e",  "se",  "s",
                                                               "sw", "w",  "nw", "top", "bottom"};
[[nodiscard]] Facing facingOf(Vec3d normal) noexcept;

/// A part of the faces of an object.
struct TouchingArea {
    std::uint32_t label = volume::kNoLabel;  ///< the object that it touches; kNoLabel: air
    bool isOutside = false;                  ///< the air is connected to the border of the grid
    Facing facing = Facing::N;
    double area = 0;         ///< m2
    double countedArea = 0;  ///< m2 of `area` whose division comes from points and voxels; the rest comes from meshes
};

/// The faces of each object by their neighbours, ordered by label and facing. Sheets without volume, such as the
/// surfaces of a room, are passed through.
/// Faces whose surroundings are the object itself touch nothing, and have no entry. An object without a mesh has no entries.
/// \param objects  of measureObjects()
/// \param threads  0: all cores; the result does not depend on it
/// Cost: O(area in voxels), at most 20,000 points for each part of a face, and for each face O(n log n) in the edges of
/// sections of meshes whose boxes it meets.
[[nodiscard]] std::vector<std::vector<TouchingArea>> findTouchingAreas(const volume::SemanticVolume& volume,
                                                                       std::span<const ObjectQuantities> objects,
                                                                       int threads = 0);

}  // namespace svt::quantities
