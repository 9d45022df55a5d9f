#include <svt/core/hash.hpp>
#include <svt/voxelize/face_planes.hpp>
#include <svt/voxelize/lattice/index_mesh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <unordered_map>

namespace svt::voxelize {
namespace {

constexpr double kSmallestFace = 1, kSmallestArea = 32;  // square voxels: of one triangle, and in total on a plane
constexpr double kNearby = 0.02;                         // maximum distance of face corners from their plane, voxels

// A triangle in voxel space.
struct Facet {
    std::array<Vec3d, 3> corners;
    Vec3d normal{};
    double area = 0;
    std::uint32_t plane = mesh::kNoPlane;
};

struct PlaneGroup {
    volume::BrickPlane plane;
    Box3d box;
    double area = 0;
};

// Samples are offset from whole index coordinates by 1/kQuanta, see voxelize.hpp.
Vec3d voxelSpace(Vec3d index) noexcept {
    constexpr double kShift = 0.5 - 1.0 / double(kQuanta);
    return index + Vec3d{kShift, kShift, kShift};
}

double heightOver(const volume::BrickPlane& plane, Vec3d point) noexcept {
    return dot(plane.normal, point) + plane.offset;
}

volume::BrickPlane planeThrough(Vec3d normal, Vec3d point) noexcept {
    // Choose one of the two directions, so that both sides of a wall can share a plane. Components that are rounding
    // noise, such as z of a vertical wall, must not decide.
    constexpr double kNoise = 1e-6;
    const double lead = std::abs(normal.z) > kNoise ? normal.z : std::abs(normal.y) > kNoise ? normal.y : normal.x;
    const bool isBack = lead < 0;
    volume::BrickPlane plane;
    plane.normal = isBack ? normal * -1.0 : normal;
    plane.offset = -dot(plane.normal, point);
    return plane;
}

// A triangle of an object in voxel space; nullopt if it is too small.
std::optional<Facet> facetOf(const mesh::ObjectMesh& object, const mesh::Triangle& triangle,
                             const IndexFromLocal& indexFromLocal) {
    Facet facet;
    for (std::size_t c = 0; c < 3; ++c)
        facet.corners[c] = voxelSpace(indexFromLocal.point(object.vertices[triangle.corners[c]]));
    const Vec3d across = cross(facet.corners[1] - facet.corners[0], facet.corners[2] - facet.corners[0]);
    const double twice = length(across);
    if (!(twice >= 2 * kSmallestFace)) return std::nullopt;
    facet.normal = across / twice;
    facet.area = twice / 2;
    if (indexFromLocal.keepsVertical()) facet.plane = triangle.plane;
    return facet;
}

// The triangle of a facet. A facet has 120 bytes. There may be millions, so only these 16 bytes are kept for each, and
// facets are made again.
struct FacetPlace {
    double area = 0;
    std::uint32_t object = 0, triangle = 0;
};

// Large triangles define their plane most precisely: they come first, equally large ones in their order.
std::vector<FacetPlace> findFacets(const mesh::MeshSet& meshes, const IndexFromLocal& indexFromLocal) {
    std::vector<FacetPlace> places;
    for (std::uint32_t o = 0; o < meshes.objects.size(); ++o)
        for (std::uint32_t t = 0; t < meshes.objects[o].triangles.size(); ++t)
            if (const auto facet = facetOf(meshes.objects[o], meshes.objects[o].triangles[t], indexFromLocal))
                places.push_back({facet->area, o, t});
    std::sort(places.begin(), places.end(), [](const FacetPlace& p, const FacetPlace& q) {
        return p.area != q.area ? p.area > q.area : std::tie(p.object, p.triangle) < std::tie(q.object, q.triangle);
    });
    return places;
}

// Finds the group of a nearly equal plane by a spatial hash over normal and height.
class GroupsByPlace {
public:
    explicit GroupsByPlace(Vec3d center) : center_(center) {}

    // The group of an existing plane within kNearby of all corners, or a new group.
    std::size_t find(const Facet& facet, std::vector<PlaneGroup>& groups) {
        const volume::BrickPlane own = planeThrough(facet.normal, facet.corners[0]);
        const std::array<double, 4> place{own.normal.x * kCellsPerNormal, own.normal.y * kCellsPerNormal,
                                          own.normal.z * kCellsPerNormal, heightOver(own, center_)};
        // Search all cells that a nearly equal plane may fall into; usually one.
        constexpr double kEdge = 0.05;
        for (unsigned corner = 0; corner < 16; ++corner) {
            Cell cell;
            bool isOther = true;
            for (std::size_t n = 0; n < 4; ++n) {
                const bool isUp = ((corner >> n) & 1u) != 0;
                const double low = std::floor(place[n] - kEdge), high = std::floor(place[n] + kEdge);
                isOther = isOther && (!isUp || high != low);
                cell[n] = static_cast<std::int64_t>(isUp ? high : low);
            }
            if (!isOther) continue;
            const auto found = cells_.find(cell);
            if (found == cells_.end()) continue;
            for (const std::size_t group : found->second)
                if (fits(facet, groups[group].plane)) return group;
        }
        Cell home;
        for (std::size_t n = 0; n < 4; ++n) home[n] = static_cast<std::int64_t>(std::floor(place[n]));
        cells_[home].push_back(groups.size());
        groups.push_back({own, {}, 0});
        return groups.size() - 1;
    }

private:
    static constexpr double kCellsPerNormal = 64;
    using Cell = std::array<std::int64_t, 4>;
    struct CellHash {
        std::size_t operator()(const Cell& cell) const noexcept {
            std::uint64_t hash = 0;
            for (const std::int64_t n : cell) hash = mixHash(hash, std::uint64_t(n));
            return hash;
        }
    };

    static bool fits(const Facet& facet, const volume::BrickPlane& plane) noexcept {
        return std::abs(dot(facet.normal, plane.normal)) > 0.99 &&
               std::all_of(facet.corners.begin(), facet.corners.end(),
                           [&](Vec3d corner) { return std::abs(heightOver(plane, corner)) < kNearby; });
    }

    Vec3d center_;
    std::unordered_map<Cell, std::vector<std::size_t>, CellHash> cells_;
};

// The shared plane of the meshes, from which all faces on it take their heights, in voxel space.
volume::BrickPlane sharedPlane(const mesh::Plane& local, const IndexFromLocal& indexFromLocal) noexcept {
    const mesh::Plane plane = indexFromLocal.plane(local);
    const Vec3d normal{-plane.slopeX / double(kQuanta), -plane.slopeY / double(kQuanta), 1};
    return planeThrough(normal / length(normal), voxelSpace({0, 0, plane.offset / double(kQuanta)}));
}

// Precise to 2e-6 voxel over 4000 voxels. The bits below are noise and would take most of the bytes in a file.
volume::BrickPlane rounded(const volume::BrickPlane& plane) noexcept {
    constexpr double kNormal = double(std::int64_t{1} << 32), kOffset = double(1 << 20);
    volume::BrickPlane result;
    for (int axis = 0; axis < 3; ++axis) result.normal[axis] = std::round(plane.normal[axis] * kNormal) / kNormal + 0.0;
    result.offset = std::round(plane.offset * kOffset) / kOffset + 0.0;
    return result;
}

// nullopt if the faces lie outside the grid.
std::optional<volume::FacePlane> clipped(const PlaneGroup& group, Vec3i dimension) noexcept {
    volume::FacePlane face{rounded(group.plane), {}, {}};
    for (int axis = 0; axis < 3; ++axis) {
        const double low = std::floor(group.box.min[axis]), high = std::ceil(group.box.max[axis]);
        const double end = std::min(dimension[axis], 65535);
        if (low >= end || high <= 0) return std::nullopt;
        const auto a = static_cast<std::size_t>(axis);
        face.min[a] = static_cast<std::uint16_t>(std::max(low, 0.0));
        face.max[a] = static_cast<std::uint16_t>(std::clamp(high, double(face.min[a]) + 1, end));
    }
    return face;
}

}  // namespace

std::vector<volume::FacePlane> findFacePlanes(const mesh::MeshSet& meshes, const volume::Grid& grid) {
    const IndexFromLocal indexFromLocal(meshes, grid);
    const Vec3i n = grid.dimension();
    std::vector<PlaneGroup> groups;
    GroupsByPlace byPlace({n.x / 2.0, n.y / 2.0, n.z / 2.0});
    constexpr std::size_t kNone = ~std::size_t{0};
    std::vector<std::size_t> groupOf(meshes.planes.size(), kNone);
    for (const FacetPlace& place : findFacets(meshes, indexFromLocal)) {
        const mesh::ObjectMesh& object = meshes.objects[place.object];
        const Facet facet = *facetOf(object, object.triangles[place.triangle], indexFromLocal);
        std::size_t group = kNone;
        if (facet.plane == mesh::kNoPlane) {
            group = byPlace.find(facet, groups);
        } else if (groupOf[facet.plane] != kNone) {
            group = groupOf[facet.plane];
        } else {
            group = groupOf[facet.plane] = groups.size();
            groups.push_back({sharedPlane(meshes.planes[facet.plane], indexFromLocal), {}, 0});
        }
        groups[group].area += facet.area;
        for (const Vec3d corner : facet.corners) groups[group].box.add(corner);
    }
    std::erase_if(groups, [](const PlaneGroup& group) { return group.area < kSmallestArea; });
    std::stable_sort(groups.begin(), groups.end(),
                     [](const PlaneGroup& p, const PlaneGroup& q) { return p.area > q.area; });
    std::vector<volume::FacePlane> planes;
    for (const PlaneGroup& group : groups)
        if (const auto face = clipped(group, n)) planes.push_back(*face);
    return planes;
}

}  // namespace svt::voxelize
