#include <svt/core/hash.hpp>
#include <svt/mesh/planes.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace svt::mesh {
namespace {

// Slope limit (89.7 degrees). Steeper faces have no plane and take their heights from their own corners.
constexpr double kSteepest = 200;

struct Candidate {
    std::uint32_t object, triangle;
    double area;
    Plane plane;
};

struct CellKey {
    std::int64_t slopeX, slopeY, offset;
    friend bool operator==(const CellKey&, const CellKey&) = default;
};
struct CellHash {
    std::size_t operator()(const CellKey& key) const noexcept {
        std::uint64_t h = mixHash(0, std::uint64_t(key.slopeX));
        h = mixHash(h, std::uint64_t(key.slopeY));
        return (h ^ (h >> 29) ^ std::uint64_t(key.offset)) * 0x94D049BB133111EBull;
    }
};

// The triangles that can have a plane, by descending area. Takes away the planes that the triangles had.
std::vector<Candidate> findCandidates(MeshSet& meshes) {
    std::vector<Candidate> candidates;
    for (std::uint32_t o = 0; o < meshes.objects.size(); ++o) {
        ObjectMesh& object = meshes.objects[o];
        for (std::uint32_t t = 0; t < object.triangles.size(); ++t) {
            Triangle& triangle = object.triangles[t];
            triangle.plane = kNoPlane;
            const Vec3d a = object.vertices[triangle.corners[0]];
            const Vec3d normal =
                cross(object.vertices[triangle.corners[1]] - a, object.vertices[triangle.corners[2]] - a);
            if (!(std::abs(normal.z) > 0) || std::abs(normal.x) > kSteepest * std::abs(normal.z) ||
                std::abs(normal.y) > kSteepest * std::abs(normal.z))
                continue;
            Plane plane{-normal.x / normal.z, -normal.y / normal.z, 0};
            plane.offset = a.z - plane.slopeX * a.x - plane.slopeY * a.y;
            candidates.push_back({o, t, length(normal), plane});
        }
    }
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& p, const Candidate& q) {
        if (p.area != q.area) return p.area > q.area;
        return std::tie(p.object, p.triangle) < std::tie(q.object, q.triangle);
    });
    return candidates;
}

// The planes found so far, by a spatial hash over slope and height.
class PlanesByPlace {
public:
    explicit PlanesByPlace(Vec3d center) : center_(center) {}

    // The first plane near `place` for which fits(plane) holds, or kNoPlane.
    template <class Fits>
    [[nodiscard]] std::uint32_t find(const Plane& place, const Fits& fits) const {
        const CellKey home = cellOf(place);
        for (std::int64_t dx = -1; dx <= 1; ++dx)
            for (std::int64_t dy = -1; dy <= 1; ++dy)
                for (std::int64_t dz = -1; dz <= 1; ++dz) {
                    const auto cell = cells_.find({home.slopeX + dx, home.slopeY + dy, home.offset + dz});
                    if (cell == cells_.end()) continue;
                    for (const std::uint32_t plane : cell->second)
                        if (fits(plane)) return plane;
                }
        return kNoPlane;
    }

    void add(const Plane& place, std::uint32_t plane) { cells_[cellOf(place)].push_back(plane); }

private:
    [[nodiscard]] CellKey cellOf(const Plane& plane) const {
        // The slope of small triangles is imprecise, so cells are wide and the corners decide.
        constexpr double kSlopeCell = 1e-2, kOffsetCell = 1e-1;
        const auto cell = [](double value, double width) {
            return static_cast<std::int64_t>(std::floor(value / width));
        };
        const double heightAtCenter = plane.slopeX * center_.x + plane.slopeY * center_.y + plane.offset;
        return {cell(plane.slopeX, kSlopeCell), cell(plane.slopeY, kSlopeCell), cell(heightAtCenter, kOffsetCell)};
    }

    Vec3d center_;
    std::unordered_map<CellKey, std::vector<std::uint32_t>, CellHash> cells_;
};

// True if all corners of a triangle with the plane `own` are within `distance` metres of `plane`, scaled by the slope.
bool fitsPlane(const ObjectMesh& object, const Triangle& triangle, const Plane& own, const Plane& plane,
               double distance) {
    const double steepness = 1 + std::abs(own.slopeX) + std::abs(own.slopeY);
    for (const std::uint32_t corner : triangle.corners) {
        const Vec3d p = object.vertices[corner];
        if (std::abs(plane.slopeX * p.x + plane.slopeY * p.y + plane.offset - p.z) > distance * steepness) return false;
    }
    // The corners of a sliver fit many planes, so the slopes must agree, too.
    return std::abs(plane.slopeX - own.slopeX) + std::abs(plane.slopeY - own.slopeY) < 2e-2 * steepness;
}

}  // namespace

void assignPlanes(MeshSet& meshes, double distance) {
    PlanesByPlace byPlace(meshes.bounds.isEmpty() ? Vec3d{} : meshes.bounds.center());
    for (const Candidate& candidate : findCandidates(meshes)) {
        const ObjectMesh& object = meshes.objects[candidate.object];
        Triangle& triangle = meshes.objects[candidate.object].triangles[candidate.triangle];
        triangle.plane = byPlace.find(candidate.plane, [&](std::uint32_t plane) {
            return fitsPlane(object, triangle, candidate.plane, meshes.planes[plane], distance);
        });
        if (triangle.plane != kNoPlane) continue;
        triangle.plane = static_cast<std::uint32_t>(meshes.planes.size());
        meshes.planes.push_back(candidate.plane);
        byPlace.add(candidate.plane, triangle.plane);
    }
}

}  // namespace svt::mesh
