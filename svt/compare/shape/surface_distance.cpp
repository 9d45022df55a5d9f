#include <svt/compare/shape/surface_distance.hpp>

#include <svt/core/triangle_distance.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace svt::compare {
namespace {

Vec3d middleOf(const std::array<Vec3d, 3>& t) noexcept { return (t[0] + t[1] + t[2]) / 3.0; }

double distanceToBox(const Box3d& box, Vec3d p) noexcept {
    Vec3d off{};
    for (int axis = 0; axis < 3; ++axis) off[axis] = std::max({box.min[axis] - p[axis], p[axis] - box.max[axis], 0.0});
    return length(off);
}

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
    std::array<std::uint32_t, 64> stack{};
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0 && nearest > enough) {
        const std::uint32_t number = stack[--depth];
        const Node& node = nodes_[number];
        if (distanceToBox(node.box, point) >= nearest) continue;
        for (std::uint32_t t = node.first; t < node.first + node.count; ++t)
            if (const double distance = distanceOf(t); distance < nearest) {
                nearest = distance;
                hint.triangle = t;
            }
        if (node.count > 0) continue;
        // The nearer child is taken first.
        std::uint32_t near = number + 1, far = node.first;
        if (distanceToBox(nodes_[far].box, point) < distanceToBox(nodes_[near].box, point)) std::swap(near, far);
        stack[depth++] = far;
        stack[depth++] = near;
    }
    return nearest;
}

double largestDistance(const Faces& faces, const FaceTree& other, Vec3d shift, double step) {
    double largest = 0;
    FaceTree::Hint
        hint;  // the points of a triangle, and mostly of the next one, have one triangle of the other near them
    const auto look = [&](Vec3d point) { largest = std::max(largest, other.distanceTo(point + shift, largest, hint)); };
    for (std::size_t t = 0; t < faces.triangles.size(); ++t) {
        const auto [a, b, c] = faces.corners(t);
        for (const Vec3d point : {a, b, c, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, (a + b + c) / 3.0}) look(point);
        if (step <= 0) continue;
        forEachLatticePoint({a, b, c}, step, look);
    }
    return largest;
}

}  // namespace svt::compare
