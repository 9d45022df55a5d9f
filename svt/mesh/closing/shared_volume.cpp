#include <svt/mesh/closing/shared_volume.hpp>

#include <svt/mesh/polygons/edges.hpp>
#include <svt/plane/common_volume.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace svt::mesh {
namespace {

constexpr std::uint64_t kMostComparisons = 20'000'000;

struct Solid {
    std::size_t number = 0;
    Box3d box;
    std::vector<plane::RoofTriangle> roofs;  // empty: not made yet
    double area = 0, volume = 0;
};

Box3d boxOf(const MeshSource& solid, const LocalPolygons& polygons) {
    Box3d box;
    for (const model::SurfaceUse& use : solid.uses)
        for (const auto& corners : polygons.trianglesOf(use.polygon))
            for (const std::uint32_t corner : corners) box.add(polygons.points[corner]);
    return box;
}

bool shareSpace(const Box3d& a, const Box3d& b) noexcept {
    for (int axis = 0; axis < 3; ++axis)
        if (std::min(a.max[axis], b.max[axis]) - std::max(a.min[axis], b.min[axis]) <= kLeastOverlap) return false;
    return true;
}

// The pairs of solids whose boxes overlap: a sweep along x.
std::vector<std::pair<std::size_t, std::size_t>> nearPairs(std::vector<Solid>& solids) {
    std::sort(solids.begin(), solids.end(), [](const Solid& a, const Solid& b) {
        return std::pair(a.box.min.x, a.number) < std::pair(b.box.min.x, b.number);
    });
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    std::vector<std::size_t> open;
    for (std::size_t n = 0; n < solids.size(); ++n) {
        std::erase_if(open, [&](std::size_t other) { return solids[other].box.max.x <= solids[n].box.min.x; });
        for (const std::size_t other : open)
            if (shareSpace(solids[other].box, solids[n].box)) pairs.emplace_back(other, n);
        open.push_back(n);
    }
    return pairs;
}

// \return false if the solid is not closed
bool addFaces(const MeshSource& source, const ShellInput& input, Solid& solid) {
    const ObjectMesh mesh = gatherShell(source, input).mesh;
    if (!findOpenEdges(mesh.triangles).empty()) return false;
    solid.volume = signedVolume(mesh.vertices, mesh.triangles);
    const double sign = solid.volume < 0 ? -1 : 1;
    solid.volume = std::abs(solid.volume);
    for (const Triangle& t : mesh.triangles) {
        const std::array<Vec3d, 3> corners{mesh.vertices[t.corners[0]], mesh.vertices[t.corners[1]],
                                           mesh.vertices[t.corners[2]]};
        solid.area += length(cross(corners[1] - corners[0], corners[2] - corners[0])) / 2;
        plane::RoofTriangle roof;
        if (!plane::makeRoofTriangle(corners, roof)) continue;
        roof.sign *= sign;
        solid.roofs.push_back(roof);
    }
    std::sort(solid.roofs.begin(), solid.roofs.end(),
              [](const plane::RoofTriangle& a, const plane::RoofTriangle& b) { return a.minX < b.minX; });
    return true;
}

}  // namespace

SharedVolume findSharedVolume(const std::vector<MeshSource>& sources, const ShellInput& input) {
    SharedVolume result;
    if (sources.size() < 2) return result;
    std::vector<Solid> solids(sources.size());
    for (std::size_t n = 0; n < solids.size(); ++n) {
        solids[n].number = n;
        solids[n].box = boxOf(sources[n], input.polygons);
    }
    const auto pairs = nearPairs(solids);
    if (pairs.empty()) return result;
    for (Solid& solid : solids) {
        if (!addFaces(sources[solid.number], input, solid)) return {};
        result.sum += solid.volume;
    }
    std::vector<std::set<std::size_t>> overlapping(solids.size());
    std::uint64_t work = 0;
    for (const auto& [a, b] : pairs) {
        const Solid &one = solids[a], &other = solids[b];
        work += plane::comparisons(one.roofs, other.roofs);
        if (work > kMostComparisons) {
            result.isKnown = false;
            return result;
        }
        const double ground = std::min(one.box.min.z, other.box.min.z) - 1;
        const double common = plane::commonVolume(one.roofs, other.roofs, ground);
        if (!(common > kLeastOverlap * std::min(one.area, other.area))) continue;
        result.shared += common;
        for (const std::size_t third : overlapping[a])
            if (overlapping[b].contains(third)) result.isKnown = false;
        overlapping[a].insert(b);
        overlapping[b].insert(a);
    }
    return result;
}

}  // namespace svt::mesh
