#pragma once
/// \file
/// Finds the triangles near a box: a binary tree of boxes, halved at the middle triangle along the longest axis.

#include <svt/validate/exact/lattice.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace svt::validate {

/// A box in lattice units, borders included.
struct IntegerBox {
    Point low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};

    static constexpr std::int64_t kFar = std::numeric_limits<std::int64_t>::max() / 4;
    void add(const Point& p) noexcept {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    void add(const IntegerBox& box) noexcept {
        add(box.low);
        add(box.high);
    }
    [[nodiscard]] IntegerBox grown(std::int64_t by) const noexcept {
        return {{low.x - by, low.y - by, low.z - by}, {high.x + by, high.y + by, high.z + by}};
    }
    [[nodiscard]] bool meets(const IntegerBox& o) const noexcept {
        return low.x <= o.high.x && o.low.x <= high.x && low.y <= o.high.y && o.low.y <= high.y && low.z <= o.high.z &&
               o.low.z <= high.z;
    }
};

class TriangleTree {
public:
    /// Cost: O(n log n).
    void build(std::vector<IntegerBox> boxes);

    /// Calls visit(index) for each box that meets `box`, in ascending order within a leaf only.
    template <class Visit>
    void forEach(const IntegerBox& box, const Visit& visit) const {
        if (nodes_.empty()) return;
        std::uint32_t open[64];
        int count = 0;
        open[count++] = 0;
        while (count > 0) {
            const Node& node = nodes_[open[--count]];
            if (!node.box.meets(box)) continue;
            if (node.right != 0) {
                open[count++] = node.right;
                open[count++] = static_cast<std::uint32_t>(&node - nodes_.data()) + 1;
                continue;
            }
            for (std::uint32_t i = node.begin; i < node.end; ++i)
                if (boxes_[order_[i]].meets(box)) visit(order_[i]);
        }
    }
    [[nodiscard]] const std::vector<IntegerBox>& boxes() const noexcept { return boxes_; }
    [[nodiscard]] IntegerBox bounds() const noexcept { return nodes_.empty() ? IntegerBox{} : nodes_.front().box; }

private:
    struct Node {
        IntegerBox box;
        std::uint32_t begin = 0, end = 0;
        std::uint32_t right = 0;  // the left child follows; 0: a leaf
    };
    void split(std::uint32_t begin, std::uint32_t end);

    std::vector<IntegerBox> boxes_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace svt::validate
