#pragma once
/// \file
/// Solids that a profile sweeps, and the primitives of CSG, as closed polygons.

#include <svt/readers/ifc_shape/body.hpp>
#include <svt/readers/ifc_shape/profiles.hpp>

#include <vector>

namespace svt::readers::ifc {

inline constexpr int kMaxDiskSegments = 64;  ///< of the section of a bar

/// The prism between a region and its copy moved by `sweep`, which may point to either side of z = 0.
/// \return the closed faces; none if `sweep` lies in the plane of the region
[[nodiscard]] std::vector<model::Polygon> extrude(const Region& region, Vec3d sweep);

/// The body between a region and another one at the distance `sweep`. Side faces that are not flat become triangles.
/// \return none if rings or their points differ in number
[[nodiscard]] std::vector<model::Polygon> extrudeTapered(const Region& region, const Region& end, Vec3d sweep);

/// A region turned about an axis in its plane.
/// \param axis   z is the axis of the turn
/// \param angle  radians; a full turn or more has no ends
[[nodiscard]] std::vector<model::Polygon> revolve(const Region& region, const Transform& axis, double angle);

/// A pipe or bar of round section along a line, with mitred corners. Its polygonal section has the area of the circle.
/// \param line    at least two points; a closed one ends at its first
/// \param inner   radius of the hollow, 0: none
[[nodiscard]] std::vector<model::Polygon> sweepDisk(std::vector<Vec3d> line, double radius, double inner);

/// A region carried along a line, its plane across the line and its x axis as near to `reference` as that allows, with
/// mitred corners.
/// \param line  at least two points; a closed one ends at its first
/// \return the closed faces; none if the line has no length
[[nodiscard]] std::vector<model::Polygon> sweepAlong(const Region& region, std::vector<Vec3d> line, Vec3d reference);

/// The body through regions in space, from the first to the last. Side faces that are not flat become triangles.
/// \return none for fewer than two regions, or if rings or their points differ in number
[[nodiscard]] std::vector<model::Polygon> loft(const std::vector<Region>& sections);

/// Box with one corner at the origin.
[[nodiscard]] std::vector<model::Polygon> block(Vec3d size);
/// Square or rectangular pyramid on z = 0, one corner at the origin.
[[nodiscard]] std::vector<model::Polygon> pyramid(double x, double y, double height);
/// Cone or cylinder on z = 0 about the z axis. \param top  radius there; 0: an apex
[[nodiscard]] std::vector<model::Polygon> cone(double radius, double top, double height);
[[nodiscard]] std::vector<model::Polygon> sphere(double radius);

}  // namespace svt::readers::ifc
