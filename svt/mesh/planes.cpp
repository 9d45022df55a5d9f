#include <svt/core/hash.hpp>
#include <svt/mesh/planes.hpp>

#include <algorithm>
#include <array>
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

// The triangles that can have a plane, by descending area. Removes the previous planes of the triangles.
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

// A plane as a point: its slopes, and its height at the middle of the model.
using DualPoint = std::array<double, 3>;

// The corners of a triangle, relative to the middle of the model, and how far a plane may be above or below them.
struct CornerLimits {
    std::array<Vec3d, 3> corners;
    double distance = 0;
};

// The planes of one cell as an octree over their points. If many planes hardly differ, the search tests only planes
// that pass by the corners of a triangle.
class PlaneTree {
public:
    PlaneTree(const DualPoint& low, const DualPoint& size) : low_(low), size_(size), nodes_(1) {}

    void add(const DualPoint& at, std::uint32_t plane) {
        constexpr int kDeepest = 24;
        constexpr std::size_t kMost = 16;
        DualPoint low = low_, size = size_;
        std::uint32_t node = 0;
        for (int depth = 0;; ++depth) {
            nodes_[node].first = std::min(nodes_[node].first, plane);
            if (nodes_[node].children == 0) {
                nodes_[node].entries.push_back({at, plane});
                if (nodes_[node].entries.size() > kMost && depth < kDeepest) split(node, low, size);
                return;
            }
            node = nodes_[node].children + octantOf(at, low, size);
            enter(node, low, size);
        }
    }

    // Lowers `best` to the first plane that passes by the corners and for which fits(plane) holds.
    template <class Fits>
    void find(const CornerLimits& limits, const Fits& fits, std::uint32_t& best) const {
        find(0, low_, size_, limits, fits, best);
    }

private:
    struct Entry {
        DualPoint at;
        std::uint32_t plane;
    };
    struct Node {
        std::uint32_t first = kNoPlane;  // the lowest number below it
        std::uint32_t children = 0;      // the first of eight; 0: none
        std::vector<Entry> entries;
    };

    static std::uint32_t octantOf(const DualPoint& at, const DualPoint& low, const DualPoint& size) noexcept {
        std::uint32_t octant = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            octant |= std::uint32_t(at[axis] >= low[axis] + size[axis] / 2) << axis;
        return octant;
    }

    // From the box of a node to that of its child; children come in groups of eight behind the root.
    static void enter(std::uint32_t child, DualPoint& low, DualPoint& size) noexcept {
        const std::uint32_t octant = (child - 1) % 8;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            size[axis] /= 2;
            if ((octant >> axis & 1) != 0) low[axis] += size[axis];
        }
    }

    void split(std::uint32_t node, const DualPoint& low, const DualPoint& size) {
        const auto children = static_cast<std::uint32_t>(nodes_.size());
        nodes_.resize(nodes_.size() + 8);
        for (const Entry& entry : nodes_[node].entries) {
            Node& child = nodes_[children + octantOf(entry.at, low, size)];
            child.first = std::min(child.first, entry.plane);
            child.entries.push_back(entry);
        }
        nodes_[node].entries = {};
        nodes_[node].children = children;
    }

    // Whether some plane with its point in the box can pass by the corners. The height of a plane over a corner is
    // linear in its point.
    static bool mayPass(const CornerLimits& limits, const DualPoint& low, const DualPoint& size) noexcept {
        return std::all_of(limits.corners.begin(), limits.corners.end(), [&](const Vec3d& p) {
            const double middle = (low[0] + size[0] / 2) * p.x + (low[1] + size[1] / 2) * p.y + low[2] + size[2] / 2;
            const double reach = (size[0] * std::abs(p.x) + size[1] * std::abs(p.y) + size[2]) / 2;
            constexpr double kRounding = 1e-7;
            return std::abs(middle - p.z) <= reach + limits.distance + kRounding;
        });
    }

    template <class Fits>
    void find(std::uint32_t number, const DualPoint& low, const DualPoint& size, const CornerLimits& limits,
              const Fits& fits, std::uint32_t& best) const {
        const Node& node = nodes_[number];
        if (node.first >= best || !mayPass(limits, low, size)) return;
        for (const Entry& entry : node.entries)
            if (entry.plane < best && fits(entry.plane)) best = entry.plane;
        for (std::uint32_t child = 0; node.children != 0 && child < 8; ++child) {
            DualPoint childLow = low, childSize = size;
            enter(node.children + child, childLow, childSize);
            find(node.children + child, childLow, childSize, limits, fits, best);
        }
    }

    DualPoint low_, size_;
    std::vector<Node> nodes_;
};

// The planes found so far, by a spatial hash over slope and height.
class PlanesByPlace {
public:
    explicit PlanesByPlace(Vec3d center) : center_(center) {}

    // The first plane near `place` that passes by the corners of `triangle` and for which fits(plane) holds, or
    // kNoPlane.
    template <class Fits>
    [[nodiscard]] std::uint32_t find(const Plane& place, const ObjectMesh& object, const Triangle& triangle,
                                     double distance, const Fits& fits) const {
        CornerLimits limits;
        for (std::size_t c = 0; c < 3; ++c) {
            const Vec3d corner = object.vertices[triangle.corners[c]];
            limits.corners[c] = {corner.x - center_.x, corner.y - center_.y, corner.z};
        }
        limits.distance = distance;
        std::uint32_t best = kNoPlane;
        const CellKey home = cellOf(pointOf(place));
        for (std::int64_t dx = -1; dx <= 1; ++dx)
            for (std::int64_t dy = -1; dy <= 1; ++dy)
                for (std::int64_t dz = -1; dz <= 1; ++dz) {
                    const auto cell = cells_.find({home.slopeX + dx, home.slopeY + dy, home.offset + dz});
                    if (cell != cells_.end()) cell->second.find(limits, fits, best);
                }
        return best;
    }

    void add(const Plane& place, std::uint32_t plane) {
        const DualPoint at = pointOf(place);
        const CellKey key = cellOf(at);
        const DualPoint low{double(key.slopeX) * kSlopeCell, double(key.slopeY) * kSlopeCell,
                            double(key.offset) * kOffsetCell};
        cells_.try_emplace(key, low, DualPoint{kSlopeCell, kSlopeCell, kOffsetCell}).first->second.add(at, plane);
    }

private:
    // The slope of small triangles is imprecise, so cells are wide and the corners decide.
    static constexpr double kSlopeCell = 1e-2, kOffsetCell = 1e-1;

    [[nodiscard]] DualPoint pointOf(const Plane& plane) const {
        return {plane.slopeX, plane.slopeY, plane.slopeX * center_.x + plane.slopeY * center_.y + plane.offset};
    }
    [[nodiscard]] static CellKey cellOf(const DualPoint& at) {
        const auto cell = [](double value, double width) {
            return static_cast<std::int64_t>(std::floor(value / width));
        };
        return {cell(at[0], kSlopeCell), cell(at[1], kSlopeCell), cell(at[2], kOffsetCell)};
    }

    Vec3d center_;
    std::unordered_map<CellKey, PlaneTree, CellHash> cells_;
};

// How far a plane may be from the corners of a triangle with the plane `own`, along z.
double reachOf(const Plane& own, double distance) {
    return distance * (1 + std::abs(own.slopeX) + std::abs(own.slopeY));
}

// True if all corners of a triangle with the plane `own` are within `distance` metres of `plane`, scaled by the slope.
bool fitsPlane(const ObjectMesh& object, const Triangle& triangle, const Plane& own, const Plane& plane,
               double distance) {
    const double reach = reachOf(own, distance);
    for (const std::uint32_t corner : triangle.corners) {
        const Vec3d p = object.vertices[corner];
        if (std::abs(plane.slopeX * p.x + plane.slopeY * p.y + plane.offset - p.z) > reach) return false;
    }
    // The corners of a sliver fit many planes, so the slopes must agree, too.
    return std::abs(plane.slopeX - own.slopeX) + std::abs(plane.slopeY - own.slopeY) < 2e-2 * reachOf(own, 1);
}

}  // namespace

void assignPlanes(MeshSet& meshes, double distance) {
    PlanesByPlace byPlace(meshes.bounds.isEmpty() ? Vec3d{} : meshes.bounds.center());
    for (const Candidate& candidate : findCandidates(meshes)) {
        const ObjectMesh& object = meshes.objects[candidate.object];
        Triangle& triangle = meshes.objects[candidate.object].triangles[candidate.triangle];
        triangle.plane = byPlace.find(
            candidate.plane, object, triangle, reachOf(candidate.plane, distance), [&](std::uint32_t plane) {
                return fitsPlane(object, triangle, candidate.plane, meshes.planes[plane], distance);
            });
        if (triangle.plane != kNoPlane) continue;
        triangle.plane = static_cast<std::uint32_t>(meshes.planes.size());
        meshes.planes.push_back(candidate.plane);
        byPlace.add(candidate.plane, triangle.plane);
    }
}

}  // namespace svt::mesh
