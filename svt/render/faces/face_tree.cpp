#include <svt/render/faces/face_tree.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace svt::render {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::size_t kLeaf = 4;        // triangles
constexpr int kMaxDepth = 48;           // of the tree; deeper parts become one leaf
constexpr double kPadding = 1e-5;       // voxels around a box, far above rounding
constexpr std::size_t kSplitBins = 16;  // places at which a box may be split

// A float beyond `value`, by more than its rounding.
float below(double value) noexcept {
    const double padded = value - kPadding;
    return static_cast<float>(padded - std::abs(padded) * std::numeric_limits<float>::epsilon());
}
float above(double value) noexcept {
    const double padded = value + kPadding;
    return static_cast<float>(padded + std::abs(padded) * std::numeric_limits<float>::epsilon());
}

// The bounds of triangles while the tree is made.
struct FaceBounds {
    Vec3d min{kInfinite, kInfinite, kInfinite}, max{-kInfinite, -kInfinite, -kInfinite};
    void add(Vec3d point) noexcept {
        for (int axis = 0; axis < 3; ++axis) {
            min[axis] = std::min(min[axis], point[axis]);
            max[axis] = std::max(max[axis], point[axis]);
        }
    }
    void add(const FaceBounds& other) noexcept {
        add(other.min);
        add(other.max);
    }
    [[nodiscard]] double area() const noexcept {
        const Vec3d size = max - min;
        return size.x >= 0 ? size.x * size.y + size.y * size.z + size.z * size.x : 0;
    }
};

// Where a ray crosses the plane of a triangle. Returns false if they are so parallel that rounding may move the crossing
// by more than the padding of boxes.
bool crossPlane(Vec3d corner, Vec3d normal, const VoxelRay& ray, double squaredLength, double& t) noexcept {
    constexpr double kSteep = 1e-8;
    const double facing = dot(normal, ray.direction);
    t = dot(normal, corner - ray.origin) / facing;
    return facing * facing > kSteep * dot(normal, normal) * squaredLength;
}

}  // namespace

FaceTree::FaceTree(std::vector<Vec3d> points, std::vector<FaceTriangle> triangles)
    : points_(std::move(points)), triangles_(std::move(triangles)) {
    if (triangles_.empty()) return;
    nodes_.reserve(triangles_.size());
    nodes_.emplace_back();
    split(0, 0, triangles_.size(), 0);
    nodes_.shrink_to_fit();
}

FaceTree::Node FaceTree::boundsOf(std::size_t begin, std::size_t end) const noexcept {
    FaceBounds bounds;
    for (std::size_t n = begin; n < end; ++n)
        for (const std::uint32_t corner : triangles_[n].corners) bounds.add(points_[corner]);
    Node node;
    for (int axis = 0; axis < 3; ++axis) {
        node.min[static_cast<std::size_t>(axis)] = below(bounds.min[axis]);
        node.max[static_cast<std::size_t>(axis)] = above(bounds.max[axis]);
    }
    return node;
}

void FaceTree::split(std::size_t node, std::size_t begin, std::size_t end, int depth) {
    nodes_[node] = boundsOf(begin, end);
    const std::size_t middle = end - begin <= kLeaf || depth == kMaxDepth ? begin : splitPlace(begin, end);
    if (middle == begin) {
        nodes_[node].first = static_cast<std::uint32_t>(begin);
        nodes_[node].count = static_cast<std::uint32_t>(end - begin);
        return;
    }
    const std::size_t children = nodes_.size();
    nodes_[node].first = static_cast<std::uint32_t>(children);
    nodes_.resize(children + 2);
    split(children, begin, middle, depth + 1);
    split(children + 1, middle, end, depth + 1);
}

// Sorts the triangles into two groups with the least sum of area times count (surface area heuristic, binned: Wald
// 2007). Returns the start of the second group.
std::size_t FaceTree::splitPlace(std::size_t begin, std::size_t end) {
    const auto centerOf = [&](const FaceTriangle& t) {
        return points_[t.corners[0]] + points_[t.corners[1]] + points_[t.corners[2]];
    };
    FaceBounds centers;
    for (std::size_t n = begin; n < end; ++n) centers.add(centerOf(triangles_[n]));
    const Vec3d size = centers.max - centers.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t half = begin + (end - begin) / 2;
    if (!(size[axis] > 0)) return half;  // all in one place
    const auto binOf = [&](const FaceTriangle& t) {
        const double share = (centerOf(t)[axis] - centers.min[axis]) / size[axis];
        return std::min(static_cast<std::size_t>(share * kSplitBins), kSplitBins - 1);
    };
    std::array<FaceBounds, kSplitBins> bounds;
    std::array<std::size_t, kSplitBins> counts{};
    for (std::size_t n = begin; n < end; ++n) {
        const std::size_t bin = binOf(triangles_[n]);
        ++counts[bin];
        for (const std::uint32_t corner : triangles_[n].corners) bounds[bin].add(points_[corner]);
    }
    std::array<double, kSplitBins> behind{};  // cost of the bins from n on
    FaceBounds sum;
    std::size_t count = 0;
    for (std::size_t n = kSplitBins; n-- > 1;) {
        if (counts[n] > 0) sum.add(bounds[n]);
        count += counts[n];
        behind[n] = sum.area() * static_cast<double>(count);
    }
    sum = {};
    count = 0;
    double least = kInfinite;
    std::size_t best = 1;
    for (std::size_t n = 1; n < kSplitBins; ++n) {
        if (counts[n - 1] > 0) sum.add(bounds[n - 1]);
        count += counts[n - 1];
        const double cost = sum.area() * static_cast<double>(count) + behind[n];
        if (cost < least && count > 0 && count < end - begin) least = cost, best = n;
    }
    const auto at = [&](std::size_t n) { return triangles_.begin() + static_cast<std::ptrdiff_t>(n); };
    const auto middle = std::partition(at(begin), at(end), [&](const FaceTriangle& t) { return binOf(t) < best; });
    return static_cast<std::size_t>(middle - triangles_.begin());
}

FaceTree::Span FaceTree::spanOf(const Box& box, const VoxelRay& ray) noexcept {
    Span span{-kInfinite, kInfinite};
    forEachAxis([&](auto axis) {
        const double low = static_cast<double>(box.min[axis]), high = static_cast<double>(box.max[axis]);
        if (ray.step[axis] == 0) {
            if (ray.origin[axis] < low || ray.origin[axis] > high) span.to = -kInfinite;
            return;
        }
        const double a = (low - ray.origin[axis]) * ray.inverse[axis],
                     b = (high - ray.origin[axis]) * ray.inverse[axis];
        span.from = std::max(span.from, std::min(a, b));
        span.to = std::min(span.to, std::max(a, b));
    });
    return span;
}

RayAcross::RayAcross(const VoxelRay& ray) noexcept {
    const Vec3d d = ray.direction;
    along = std::abs(d.x) >= std::abs(d.y) && std::abs(d.x) >= std::abs(d.z) ? 0
            : std::abs(d.y) >= std::abs(d.z)                                 ? 1
                                                                             : 2;
    x = (along + 1) % 3;
    y = (along + 2) % 3;
    slopeX = d[x] / d[along];
    slopeY = d[y] / d[along];
    squaredLength = dot(d, d);
    isBackwards = d[along] < 0;
}

bool FaceTree::cross(std::uint32_t number, const VoxelRay& ray, const RayAcross& across,
                     FaceCrossing& crossing) const noexcept {
    const auto& corners = triangles_[number].corners;
    const Vec3d a = points_[corners[0]] - ray.origin, b = points_[corners[1]] - ray.origin,
                c = points_[corners[2]] - ray.origin;
    struct Place {
        double x, y;
    };
    const auto placeOf = [&](Vec3d point) {
        return Place{point[across.x] - across.slopeX * point[across.along],
                     point[across.y] - across.slopeY * point[across.along]};
    };
    const auto isLeft = [](Place p, Place q) {
        const double side = p.x * q.y - p.y * q.x;
        if (side != 0) return side > 0;
        return p.y != q.y ? p.y > q.y : p.x < q.x;
    };
    const Place placeA = placeOf(a), placeB = placeOf(b), placeC = placeOf(c);
    const bool isPositive = isLeft(placeA, placeB);
    if (isLeft(placeB, placeC) != isPositive || isLeft(placeC, placeA) != isPositive) return false;
    crossing.triangle = number;
    crossing.isEntry = isPositive == across.isBackwards;
    if (crossPlane(points_[corners[0]], normal(number), ray, across.squaredLength, crossing.t)) return true;
    // In the box: no box of the tree excludes the crossing then.
    const Span span = spanOf(boxOf(number), ray);
    if (!(span.from <= span.to)) return false;
    crossing.t = std::isfinite(crossing.t) ? std::clamp(crossing.t, span.from, span.to) : span.from;
    return true;
}

bool FaceTree::cross(const BeamTriangle& triangle, BeamPlace place, const VoxelRay& ray, const RayAcross& across,
                     FaceCrossing& crossing) const noexcept {
    const float inside = triangle.insideAt(place);
    if (inside < -BeamTriangle::kMargin) return false;
    if (!(inside > BeamTriangle::kMargin) ||
        !crossPlane(triangle.corner, triangle.normal, ray, across.squaredLength, crossing.t))
        return cross(triangle.number, ray, across, crossing);
    crossing.triangle = triangle.number;
    crossing.isEntry = dot(triangle.normal, ray.direction) < 0;
    return true;
}

FaceTree::Box FaceTree::boxOf(std::uint32_t triangle) const noexcept {
    const auto& corners = triangles_[triangle].corners;
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        const auto n = static_cast<std::size_t>(axis);
        const auto [low, high] =
            std::minmax({points_[corners[0]][axis], points_[corners[1]][axis], points_[corners[2]][axis]});
        box.min[n] = below(low);
        box.max[n] = above(high);
    }
    return box;
}

template <class Visit>
void FaceTree::traverse(const VoxelRay& ray, double from, const double& to, const Visit& visit) const {
    if (nodes_.empty()) return;
    const RayAcross across(ray);
    struct Open {
        std::uint32_t node;
        double from;
    };
    std::array<Open, kMaxDepth + 2> stack;
    std::size_t open = 0;
    const auto openOf = [&](std::uint32_t node) -> Open {
        const Span span = spanOf(nodes_[node], ray);
        const bool isMissed = !(span.from <= span.to) || span.to < from || span.from > to;
        return {node, isMissed ? kInfinite : span.from};
    };
    if (const Open root = openOf(0); root.from < kInfinite) stack[open++] = root;
    while (open > 0) {
        const Open next = stack[--open];
        if (next.from > to) continue;
        const Node& node = nodes_[next.node];
        if (node.count > 0) {
            FaceCrossing crossing;
            for (std::uint32_t n = node.first; n < node.first + node.count; ++n)
                if (cross(n, ray, across, crossing) && crossing.t <= to) visit(crossing);
            continue;
        }
        Open near = openOf(node.first), far = openOf(node.first + 1);
        if (far.from < near.from) std::swap(near, far);
        if (far.from < kInfinite) stack[open++] = far;
        if (near.from < kInfinite) stack[open++] = near;
    }
}

std::size_t FaceTree::findNext(const VoxelRay& ray, const FaceCrossing& last, double to, std::size_t most,
                               Batch& batch) const {
    std::size_t count = 0;
    double limit = to;
    traverse(ray, last.t, limit, [&](const FaceCrossing& found) {
        if (!last.isBefore(found)) return;
        if (count == most && !found.isBefore(batch[most - 1])) return;
        std::size_t at = count < most ? count++ : most - 1;
        for (; at > 0 && found.isBefore(batch[at - 1]); --at) batch[at] = batch[at - 1];
        batch[at] = found;
        if (count == most) limit = batch[most - 1].t;
    });
    return count;
}

bool FaceTree::collect(const FaceBeam& beam, std::size_t most, std::vector<BeamTriangle>& found) const {
    found.clear();
    if (nodes_.empty()) return true;
    const auto at = [](const std::array<float, 3>& p) { return Vec3d{double(p[0]), double(p[1]), double(p[2])}; };
    std::array<std::uint32_t, kMaxDepth + 2> stack{};
    std::size_t open = 1;
    while (open > 0) {
        const Node& node = nodes_[stack[--open]];
        if (!beam.mayMeet(at(node.min), at(node.max))) continue;
        if (node.count == 0) {
            stack[open++] = node.first + 1;
            stack[open++] = node.first;
            continue;
        }
        for (std::uint32_t n = node.first; n < node.first + node.count; ++n) {
            const auto& corners = triangles_[n].corners;
            BeamTriangle triangle;
            triangle.number = n;
            if (!beam.findEdges(points_[corners[0]], points_[corners[1]], points_[corners[2]], triangle)) continue;
            const Box box = boxOf(n);
            if (!beam.mayMeet(at(box.min), at(box.max))) continue;
            if (found.size() == most) return false;
            triangle.from = beam.depthOf(at(box.min), at(box.max));
            triangle.corner = points_[corners[0]];
            triangle.normal = normal(n);
            found.push_back(triangle);
        }
    }
    std::ranges::sort(found, {}, &BeamTriangle::from);
    return true;
}

Vec3d FaceTree::normal(std::uint32_t number) const noexcept {
    const auto& corners = triangles_[number].corners;
    const Vec3d a = points_[corners[0]];
    return svt::cross(points_[corners[1]] - a, points_[corners[2]] - a);
}

std::size_t FaceTree::sizeBytes() const noexcept {
    return points_.size() * sizeof(Vec3d) + triangles_.size() * sizeof(FaceTriangle) + nodes_.size() * sizeof(Node);
}

}  // namespace svt::render
