#include <svt/plane/box_tree.hpp>

#include <algorithm>
#include <numeric>

namespace svt::plane {
namespace {

Vec3d centerOf(const Box3d& box) noexcept { return box.isEmpty() ? Vec3d{} : box.center(); }

}  // namespace

BoxTree::BoxTree(std::vector<Box3d> boxes, Halving halving) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(boxes_.size());
    if (!boxes_.empty()) build(0, static_cast<std::uint32_t>(boxes_.size()), halving);
}

std::uint32_t BoxTree::build(std::uint32_t begin, std::uint32_t end, Halving halving) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Box3d box, centers;
    for (std::uint32_t i = begin; i < end; ++i) {
        box.add(boxes_[order_[i]]);
        centers.add(centerOf(boxes_[order_[i]]));
    }
    nodes_[index].box = box;
    nodes_[index].begin = begin;
    nodes_[index].end = end;
    if (end - begin <= halving.leafSize) {
        // nth_element() leaves them in an order that depends on the standard library.
        std::sort(order_.begin() + begin, order_.begin() + end);
        return index;
    }
    const Vec3d size = (halving.usesCenters ? centers : box).size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t p, std::uint32_t q) {
                         const double a = centerOf(boxes_[p])[axis], b = centerOf(boxes_[q])[axis];
                         return a != b ? a < b : p < q;
                     });
    build(begin, middle, halving);
    const std::uint32_t right = build(middle, end, halving);
    nodes_[index].right = right;
    return index;
}

BoxTree::Slab BoxTree::slabOf(const Node& node, Vec3d normal, const std::vector<SpaceTriangle>& triangles) const {
    Slab slab{normal, kInfinity, -kInfinity};
    for (std::uint32_t i = node.begin; i < node.end; ++i)
        for (const Vec3d& corner : triangles[order_[i]]) {
            const double at = dot(normal, corner);
            slab.low = std::min(slab.low, at);
            slab.high = std::max(slab.high, at);
        }
    // A step on both sides is more than the rounding error.
    slab.low -= 1;
    slab.high += 1;
    return slab;
}

bool BoxTree::isReached(const Slab& slab, const SpaceTriangle& t) noexcept {
    const double a = dot(slab.normal, t[0]), b = dot(slab.normal, t[1]), c = dot(slab.normal, t[2]);
    return std::min({a, b, c}) <= slab.high && std::max({a, b, c}) >= slab.low;
}

void BoxTree::addSlabs(const std::vector<SpaceTriangle>& triangles) {
    constexpr std::uint32_t kTried = 4;
    slabs_.clear();
    slabs_.reserve(nodes_.size());
    for (const Node& node : nodes_) {
        // Without a normal, all triangles reach the slab.
        Slab thinnest{{}, 0, 0};
        for (std::uint32_t i = 0; i < kTried; ++i) {
            const SpaceTriangle& t = triangles[order_[node.begin + (node.end - node.begin) * i / kTried]];
            const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
            if (!(length(normal) > 0)) continue;
            const Slab slab = slabOf(node, normalized(normal), triangles);
            if (thinnest.normal == Vec3d{} || slab.high - slab.low < thinnest.high - thinnest.low) thinnest = slab;
        }
        slabs_.push_back(thinnest);
    }
}

std::vector<std::uint32_t> BoxTree::findAll(const Box3d& box) const {
    std::vector<std::uint32_t> found;
    forEach(box, [&](std::uint32_t i) { found.push_back(i); });
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace svt::plane
