#include <svt/validate/solids/triangle_tree.hpp>

#include <numeric>

namespace svt::validate {

void TriangleTree::build(std::vector<IntegerBox> boxes) {
    boxes_ = std::move(boxes);
    order_.resize(boxes_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.clear();
    slabs_.clear();
    if (!boxes_.empty()) split(0, static_cast<std::uint32_t>(boxes_.size()));
}

// Halved by count: no deeper than 32 levels.
void TriangleTree::split(std::uint32_t begin, std::uint32_t end) {
    constexpr std::uint32_t kLeaf = 6;
    const std::size_t index = nodes_.size();
    nodes_.emplace_back();
    IntegerBox box;
    for (std::uint32_t i = begin; i < end; ++i) box.add(boxes_[order_[i]]);
    nodes_[index].box = box;
    nodes_[index].begin = begin;
    nodes_[index].end = end;
    if (end - begin <= kLeaf) return;
    const Point size{box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z};
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                         const std::int64_t ofA = boxes_[a].low[axis] + boxes_[a].high[axis],
                                            ofB = boxes_[b].low[axis] + boxes_[b].high[axis];
                         return ofA != ofB ? ofA < ofB : a < b;
                     });
    split(begin, middle);
    nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
    split(middle, end);
}

TriangleTree::Slab TriangleTree::slabOf(const Node& node, Vec3d normal,
                                        const std::vector<RoundTriangle>& triangles) const {
    Slab slab{normal, kInfinity, -kInfinity};
    for (std::uint32_t i = node.begin; i < node.end; ++i)
        for (const Vec3d& corner : triangles[order_[i]]) {
            const double at = dot(normal, corner);
            slab.low = std::min(slab.low, at);
            slab.high = std::max(slab.high, at);
        }
    // A step on both sides is more than rounding does: coordinates have up to 40 bits.
    slab.low -= 1;
    slab.high += 1;
    return slab;
}

void TriangleTree::addSlabs(const std::vector<RoundTriangle>& triangles) {
    constexpr std::uint32_t kTried = 4;
    slabs_.clear();
    slabs_.reserve(nodes_.size());
    for (const Node& node : nodes_) {
        // Without a triangle to take the normal from: a slab that all reach.
        Slab thinnest{{}, 0, 0};
        for (std::uint32_t i = 0; i < kTried; ++i) {
            const RoundTriangle& t = triangles[order_[node.begin + (node.end - node.begin) * i / kTried]];
            const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
            if (!(length(normal) > 0)) continue;
            const Slab slab = slabOf(node, normalized(normal), triangles);
            if (thinnest.normal == Vec3d{} || slab.high - slab.low < thinnest.high - thinnest.low) thinnest = slab;
        }
        slabs_.push_back(thinnest);
    }
}

}  // namespace svt::validate
