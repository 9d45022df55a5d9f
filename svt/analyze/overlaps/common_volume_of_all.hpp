#pragma once
/// \file
/// The volume that several closed meshes have in common: the sum of common_volume.hpp over tuples of triangles.
///
/// Over the polygon in which the projections of n triangles overlap, the integral of the lowest plane is continuous in
/// the points, too:
///
///     lowest(z1 .. zn) - base  =  (lowest(z1 .. zn-1) - base)  -  (lowest(z1 .. zn-1) - zn, where all of these are above zn)

#include <svt/plane/common_volume.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace svt::analyze {

/// The common volume of one or more closed meshes, m3.
/// \param meshes  each in order of minX; see plane::commonVolume() for the triangles that can be left out
/// \param ground  a height below all triangles, close to them to limit rounding
/// \param work    maximum number of compared triangles; the function reduces it
/// \return the volume, or nothing if the work does not suffice
[[nodiscard]] std::optional<double> commonVolumeOfAll(std::span<const std::vector<plane::RoofTriangle>* const> meshes,
                                                      double ground, std::uint64_t& work);

}  // namespace svt::analyze
