#include <svt/plane/box_tree.hpp>

#include <algorithm>

namespace svt::plane {
namespace {

Vec3d centerOf(const Box3d& box) noexcept { return box.isEmpty() ? Vec3d{} : box.center(); }

}  // namespace

BoxTree::BoxTree(std::vector<Box3d> boxes, Halving halving) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::vector<Place> places(boxes_.size());
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) places[i] = {centerOf(boxes_[i]), i};
    nodes_.reserve(boxes_.size());
    if (!boxes_.empty()) build(0, places, halving);
}

std::uint32_t BoxTree::build(std::uint32_t begin, std::span<Place> places, Halving halving) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    const auto end = static_cast<std::uint32_t>(begin + places.size());
    nodes_.emplace_back();
    Box3d box, centers;
    for (const Place& place : places) {
        box.add(boxes_[place.box]);
        centers.add(place.center);
    }
    nodes_[index].box = box;
    nodes_[index].begin = begin;
    nodes_[index].end = end;
    if (places.size() <= halving.leafSize) {
        for (std::size_t i = 0; i < places.size(); ++i) order_[begin + i] = places[i].box;
        // nth_element() leaves them in an order that depends on the standard library.
        std::sort(order_.begin() + begin, order_.begin() + end);
        return index;
    }
    const Vec3d size = (halving.usesCenters ? centers : box).size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t middle = places.size() / 2;
    std::nth_element(places.begin(), places.begin() + std::ptrdiff_t(middle), places.end(),
                     [axis](const Place& p, const Place& q) {
                         const double a = p.center[axis], b = q.center[axis];
                         return a != b ? a < b : p.box < q.box;
                     });
    build(begin, places.first(middle), halving);
    const std::uint32_t right = build(static_cast<std::uint32_t>(begin + middle), places.subspan(middle), halving);
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
