#include <svt/compare/shape/surface_distance.hpp>

#include <svt/core/hash.hpp>
#include <svt/core/triangle_distance.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace svt::compare {
namespace {

Vec3d middleOf(const std::array<Vec3d, 3>& t) noexcept { return (t[0] + t[1] + t[2]) / 3.0; }

double squaredDistanceToBox(const Box3d& box, Vec3d p) noexcept {
    const auto beyond = [](double low, double high, double at) { return std::max(std::max(low - at, at - high), 0.0); };
    const double x = beyond(box.min.x, box.max.x, p.x), y = beyond(box.min.y, box.max.y, p.y),
                 z = beyond(box.min.z, box.max.z, p.z);
    return x * x + y * y + z * z;
}

// Corners and edges that were visited, by their points. A corner is an edge from a point to itself.
class VisitedEdges {
public:
    explicit VisitedEdges(std::size_t triangles) : slots_(std::bit_ceil(8 * triangles + 16), kFree) {}

    // Whether this is the first visit.
    [[nodiscard]] bool add(std::uint32_t a, std::uint32_t b) noexcept {
        const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        for (std::size_t at = mixHash(1, key);; ++at) {
            std::uint64_t& slot = slots_[at & (slots_.size() - 1)];
            if (slot == key) return false;
            if (slot != kFree) continue;
            slot = key;
            return true;
        }
    }

private:
    static constexpr std::uint64_t kFree = ~std::uint64_t{0};
    std::vector<std::uint64_t> slots_;  // at most 6 of 8 per triangle are used
};

// Points in rows along the longest side.
template <class Use>
void forEachLatticePoint(std::array<Vec3d, 3> t, double step, const Use& use) {
    for (int turn = 0; turn < 2 && length(t[1] - t[0]) < std::max(length(t[2] - t[1]), length(t[0] - t[2])); ++turn)
        std::rotate(t.begin(), t.begin() + 1, t.end());
    const double base = length(t[1] - t[0]);
    const double height = base > 0 ? length(cross(t[1] - t[0], t[2] - t[0])) / base : 0;
    const int rows = std::max(1, static_cast<int>(std::ceil(height / step)));
    for (int r = 0; r < rows; ++r) {
        const double up = double(r) / rows;
        const Vec3d left = t[0] + (t[2] - t[0]) * up, right = t[1] + (t[2] - t[1]) * up;
        const int count = std::max(1, static_cast<int>(std::ceil(length(right - left) / step)));
        for (int n = 0; n <= count; ++n) use(left + (right - left) * (double(n) / count));
    }
}

}  // namespace

FaceTree::FaceTree(const Faces& faces) {
    triangles_.reserve(faces.triangles.size());
    for (std::size_t t = 0; t < faces.triangles.size(); ++t) triangles_.push_back(faces.corners(t));
    if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(triangles_.size()));
}

// Halves the triangles at the median along the longest side of their middles. The depth is at most 32.
std::uint32_t FaceTree::build(std::uint32_t first, std::uint32_t count) {
    constexpr std::uint32_t kLeaf = 4;
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    Node node;
    Box3d middles;
    for (std::uint32_t t = first; t < first + count; ++t) {
        for (const Vec3d& corner : triangles_[t]) node.box.add(corner);
        middles.add(middleOf(triangles_[t]));
    }
    nodes_.push_back(node);
    if (count <= kLeaf) {
        nodes_[number].first = first;
        nodes_[number].count = count;
        return number;
    }
    const Vec3d size = middles.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t half = count / 2;
    const auto begin = triangles_.begin() + first;
    std::nth_element(begin, begin + half, begin + count,
                     [&](const auto& s, const auto& t) { return middleOf(s)[axis] < middleOf(t)[axis]; });
    build(first, half);
    nodes_[number].first = build(first + half, count - half);
    return number;
}

double FaceTree::distanceTo(Vec3d point, double enough, Hint& hint) const {
    if (nodes_.empty()) return kInfinity;
    const auto distanceOf = [&](std::uint32_t t) {
        return distanceToTriangle(point, triangles_[t][0], triangles_[t][1], triangles_[t][2]);
    };
    hint.triangle = std::min(hint.triangle, static_cast<std::uint32_t>(triangles_.size() - 1));
    double nearest = distanceOf(hint.triangle);
    struct Open {
        std::uint32_t node;
        double squared;  // distance to its box
    };
    std::array<Open, 64> stack;
    std::size_t depth = 0;
    stack[depth++] = {0, squaredDistanceToBox(nodes_[0].box, point)};
    while (depth > 0 && nearest > enough) {
        const auto [number, squared] = stack[--depth];
        if (squared >= nearest * nearest) continue;
        const Node& node = nodes_[number];
        for (std::uint32_t t = node.first; t < node.first + node.count; ++t)
            if (const double distance = distanceOf(t); distance < nearest) {
                nearest = distance;
                hint.triangle = t;
            }
        if (node.count > 0) continue;
        // The nearer child is taken first.
        Open near{number + 1, squaredDistanceToBox(nodes_[number + 1].box, point)},
            far{node.first, squaredDistanceToBox(nodes_[node.first].box, point)};
        if (far.squared < near.squared) std::swap(near, far);
        stack[depth++] = far;
        stack[depth++] = near;
    }
    return nearest;
}

namespace {

// Calls use(point) for the points of a triangle that no earlier one had.
template <class Use>
void forEachNewPoint(const Faces& faces, std::size_t t, VisitedEdges& visited, const Use& use) {
    const auto& c = faces.triangles[t].corners;
    const std::array<Vec3d, 3> p = faces.corners(t);
    for (std::size_t n = 0; n < 3; ++n)
        if (visited.add(c[n], c[n])) use(p[n]);
    for (std::size_t n = 0; n < 3; ++n)
        if (visited.add(c[n], c[(n + 1) % 3])) use((p[n] + p[(n + 1) % 3]) / 2.0);
    use((p[0] + p[1] + p[2]) / 3.0);
}

}  // namespace

double largestDistance(const Faces& faces, const FaceTree& other, Vec3d shift, double step) {
    double largest = 0;
    FaceTree::Hint hint;  // points of a triangle, and mostly of the next one, have one triangle of the other near them
    VisitedEdges visited(faces.triangles.size());
    const auto look = [&](Vec3d point) { largest = std::max(largest, other.distanceTo(point + shift, largest, hint)); };
    for (std::size_t t = 0; t < faces.triangles.size(); ++t) {
        forEachNewPoint(faces, t, visited, look);
        if (step > 0) forEachLatticePoint(faces.corners(t), step, look);
    }
    return largest;
}

double largestDistance(const Faces& faces, const FaceTree& other, const Turn& turn, double most) {
    double largest = 0;
    FaceTree::Hint hint;
    VisitedEdges visited(faces.triangles.size());
    const auto look = [&](Vec3d point) { largest = std::max(largest, other.distanceTo(turn(point), largest, hint)); };
    for (std::size_t t = 0; t < faces.triangles.size() && largest <= most; ++t)
        forEachNewPoint(faces, t, visited, look);
    return largest;
}

}  // namespace svt::compare
