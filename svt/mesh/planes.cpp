#include <svt/core/hash.hpp>
#include <svt/mesh/planes.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_map>

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

}  // namespace

void assignPlanes(MeshSet& meshes, double distance) {
    const Vec3d center = meshes.bounds.isEmpty() ? Vec3d{} : meshes.bounds.center();
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

    // The slope of small triangles is imprecise, so hash cells are wide and the corners decide.
    constexpr double kSlopeCell = 1e-2, kOffsetCell = 1e-1;
    std::unordered_map<CellKey, std::vector<std::uint32_t>, CellHash> cells;
    const auto heightAtCenter = [&](const Plane& plane) {
        return plane.slopeX * center.x + plane.slopeY * center.y + plane.offset;
    };
    for (const Candidate& candidate : candidates) {
        ObjectMesh& object = meshes.objects[candidate.object];
        Triangle& triangle = object.triangles[candidate.triangle];
        const double steepness = 1 + std::abs(candidate.plane.slopeX) + std::abs(candidate.plane.slopeY);
        const auto cellOf = [](double value, double cell) {
            return static_cast<std::int64_t>(std::floor(value / cell));
        };
        const CellKey home{cellOf(candidate.plane.slopeX, kSlopeCell), cellOf(candidate.plane.slopeY, kSlopeCell),
                           cellOf(heightAtCenter(candidate.plane), kOffsetCell)};
        const auto fits = [&](const Plane& plane) {
            for (const std::uint32_t corner : triangle.corners) {
                const Vec3d p = object.vertices[corner];
                if (std::abs(plane.slopeX * p.x + plane.slopeY * p.y + plane.offset - p.z) > distance * steepness)
                    return false;
            }
            // The corners of a sliver fit many planes, so the slopes must agree, too.
            return std::abs(plane.slopeX - candidate.plane.slopeX) + std::abs(plane.slopeY - candidate.plane.slopeY) <
                   2e-2 * steepness;
        };
        for (std::int64_t dx = -1; dx <= 1 && triangle.plane == kNoPlane; ++dx)
            for (std::int64_t dy = -1; dy <= 1 && triangle.plane == kNoPlane; ++dy)
                for (std::int64_t dz = -1; dz <= 1 && triangle.plane == kNoPlane; ++dz) {
                    const auto cell = cells.find({home.slopeX + dx, home.slopeY + dy, home.offset + dz});
                    if (cell == cells.end()) continue;
                    for (const std::uint32_t plane : cell->second)
                        if (fits(meshes.planes[plane])) {
                            triangle.plane = plane;
                            break;
                        }
                }
        if (triangle.plane != kNoPlane) continue;
        triangle.plane = static_cast<std::uint32_t>(meshes.planes.size());
        meshes.planes.push_back(candidate.plane);
        cells[home].push_back(triangle.plane);
    }
}

}  // namespace svt::mesh
