#pragma once
/// \file
/// The two faces of a curved wall: concentric polygons of upright facets, and the wall unrolled to a plane.

#include <svt/quantities/measure/plate.hpp>
#include <svt/quantities/measure/silhouette.hpp>

#include <optional>
#include <span>
#include <vector>

namespace svt::quantities {

/// A curved wall, unrolled: u is the length of the arc at half the thickness, v is up.
struct UnrolledRing {
    double outer = 0, inner = 0;     ///< radii of the corners of the facets, metres
    double lowest = 0, highest = 0;  ///< radii of all corners
    bool isClosed = false;           ///< all around: the cut at u = 0 is not an edge
    /// Smallest and largest ratio of a sector and its round form: sin(f) / f for a facet of angle f.
    double leastFill = 1, mostFill = 1;
    std::vector<FlatTriangle> triangles;

    [[nodiscard]] double thickness() const noexcept { return outer - inner; }
};

inline constexpr double kWidestFacet = 0.36;  // radians: wider facets are sides of a polygon, not of a curve

/// The wall between two circles of facets, each at least half of the faces that are seen from its side. Facets are upright,
/// at least three on each side, and narrower than kWidestFacet.
/// \param triangles  of a closed mesh; coordinates near 0
/// \return one wall; for closed ones several, with other cuts, because a void at the cut is not seen; none for other
///         shapes
/// Cost: O(t * p) for t triangles and p <= 512 upright planes.
[[nodiscard]] std::vector<UnrolledRing> unrollRing(std::span<const Corners> triangles);

}  // namespace svt::quantities
