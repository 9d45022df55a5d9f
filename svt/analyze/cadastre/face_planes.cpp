#include <svt/analyze/cadastre/face_planes.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace svt::analyze {
namespace {

constexpr double kMostTurned = 0.985;  // cosine of 10 degrees: narrow triangles have inexact normals

// The same normal for both sides of a plane: its largest component is positive.
Vec3d oneSided(Vec3d normal) noexcept {
    const Vec3d size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const double largest = size.z >= size.x && size.z >= size.y ? normal.z : size.x >= size.y ? normal.x : normal.y;
    return largest < 0 ? -normal : normal;
}

struct SizedFacet {
    SpaceFacet facet;
    Vec3d normal;
    double area = 0;
};

std::vector<SizedFacet> facetsOf(const std::vector<LegalSpace>& spaces) {
    std::vector<SizedFacet> facets;
    for (std::uint32_t s = 0; s < spaces.size(); ++s)
        for (const auto& solid : spaces[s].solids)
            for (const SpaceTriangle& t : solid) {
                const Vec3d twice = cross(t[1] - t[0], t[2] - t[0]);
                const double area = 0.5 * length(twice);
                if (area > 1e-9) facets.push_back({{t, s, false}, twice / (2 * area), area});
            }
    std::stable_sort(facets.begin(), facets.end(),
                     [](const SizedFacet& a, const SizedFacet& b) { return a.area > b.area; });
    return facets;
}

}  // namespace

std::vector<FacePlane> facePlanes(const std::vector<LegalSpace>& spaces, double flatness) {
    std::vector<FacePlane> planes;
    for (SizedFacet& sized : facetsOf(spaces)) {
        const SpaceTriangle& corners = sized.facet.corners;
        const auto holds = [&](const FacePlane& plane) {
            if (std::abs(dot(plane.axes.normal, sized.normal)) < kMostTurned) return false;
            return std::all_of(corners.begin(), corners.end(), [&](Vec3d corner) {
                return std::abs(dot(plane.axes.normal, corner) - plane.height) <= flatness;
            });
        };
        auto plane = std::find_if(planes.begin(), planes.end(), holds);
        if (plane == planes.end()) {
            const Vec3d normal = oneSided(sized.normal);
            planes.push_back({OverlayAxes::across(normal), dot(normal, corners[0]), {}});
            plane = std::prev(planes.end());
        }
        sized.facet.isReversed = dot(plane->axes.normal, sized.normal) < 0;
        plane->facets.push_back(sized.facet);
    }
    return planes;
}

std::optional<std::vector<BoundingRegion>> regionsOf(const FacePlane& plane, double extent, double snap) {
    PlaneOverlay overlay(extent, snap);
    for (const SpaceFacet& facet : plane.facets) {
        OverlayRing ring;
        for (const Vec3d& corner : facet.corners) ring.push_back(plane.axes.flat(corner));
        if (facet.isReversed) std::swap(ring[1], ring[2]);
        overlay.add(ring, 2 * facet.space + (facet.isReversed ? 1 : 0));
    }
    auto found = overlay.run();
    if (!found) return std::nullopt;
    std::vector<BoundingRegion> regions;
    for (OverlayRegion& region : *found) {
        BoundingRegion bounding;
        for (const std::uint32_t claim : region.claims)
            (claim % 2 == 0 ? bounding.below : bounding.above).push_back(claim / 2);
        std::vector<std::uint32_t> inner;
        std::set_intersection(bounding.below.begin(), bounding.below.end(), bounding.above.begin(),
                              bounding.above.end(), std::back_inserter(inner));
        const auto isInner = [&](std::uint32_t space) { return std::binary_search(inner.begin(), inner.end(), space); };
        std::erase_if(bounding.below, isInner);
        std::erase_if(bounding.above, isInner);
        if (bounding.below.empty() && bounding.above.empty()) continue;
        bounding.polygons = std::move(region.polygons);
        regions.push_back(std::move(bounding));
    }
    return regions;
}

}  // namespace svt::analyze
