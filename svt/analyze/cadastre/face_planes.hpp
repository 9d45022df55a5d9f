#pragma once
/// \file
/// The flat faces of legal spaces: triangles sorted by planes, and the polygons in which they bound spaces.

#include <svt/analyze/cadastre/plane_overlay.hpp>
#include <svt/analyze/legal_spaces.hpp>

#include <cstdint>
#include <vector>

namespace svt::analyze {

/// A triangle of the body of a space.
struct SpaceFacet {
    SpaceTriangle corners;
    std::uint32_t space = 0;
    bool isReversed = false;  ///< its normal points against that of the plane
};

/// A plane with the facets that lie in it.
struct FacePlane {
    OverlayAxes axes;
    double height = 0;  ///< along the normal
    std::vector<SpaceFacet> facets;
};

/// Sorts all triangles of the bodies by planes, the largest first.
/// \param flatness  largest distance of a corner from its plane
/// Cost: O(triangles * planes).
[[nodiscard]] std::vector<FacePlane> facePlanes(const std::vector<LegalSpace>& spaces, double flatness);

/// A polygon of a plane, and the spaces that it bounds.
struct BoundingRegion {
    std::vector<std::uint32_t> below;  ///< spaces on the minus side of the plane, ascending
    std::vector<std::uint32_t> above;  ///< spaces on the plus side
    std::vector<OverlayPolygon> polygons;
};

/// The regions of a plane. A polygon with the same space on both sides is inside of it and left out.
/// \param extent  maximum distance of a coordinate from 0
/// \return the regions, or nothing if the edges do not settle
[[nodiscard]] std::optional<std::vector<BoundingRegion>> regionsOf(const FacePlane& plane, double extent, double snap);

}  // namespace svt::analyze
