#pragma once
/// \file
/// The turn about the vertical that makes one shape of another one.

#include <svt/compare/shape/surface_distance.hpp>

#include <optional>

namespace svt::compare {

/// The turn of shape `a` about its centre that gives shape `b`, wherever its centre is. Upright faces of equal area give the
/// possible angles; a shape without them has those of its second moments. Each is tried at points of both shapes.
/// \param most  metres that the turned faces may be off
/// \return degrees in (-180, 180], counter-clockwise seen from above: the angle of the smallest size, a positive one before a
///         negative one. Empty: the shapes are not congruent, or they are turned about another axis
/// Cost: O(n log n) in triangles for each of up to 16 angles; O(1) for most shapes that are not congruent.
[[nodiscard]] std::optional<double> rotationBetween(const Shape& a, const FaceTree& treeOfA, const Shape& b,
                                                    const FaceTree& treeOfB, double most);

}  // namespace svt::compare
