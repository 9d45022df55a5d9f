#pragma once
/// \file
/// Finds the triangles near a box: a binary tree of boxes, halved at the middle triangle along the longest axis.

#include <svt/validate/exact/lattice.hpp>

#include <algorithm>
#include <array>
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

/// Corners of a triangle, in lattice units.
using RoundTriangle = std::array<Vec3d, 3>;

class TriangleTree {
public:
    /// Cost: O(n log n).
    void build(std::vector<IntegerBox> boxes);

    /// Gives each node a slab beside its box: between two parallel planes along a normal of one of its triangles. Boxes of
    /// slanted long triangles side by side all meet, their slabs do not (Gottschalk 1996, "OBBTree").
    /// \param triangles  in the order of the boxes
    /// Cost: O(n log n).
    void addSlabs(const std::vector<RoundTriangle>& triangles);

    /// As forEach, without triangles that lie in slabs which `triangle` does not reach. Needs addSlabs().
    template <class Visit>
    void forEachBeside(const IntegerBox& box, const RoundTriangle& triangle, const Visit& visit) const {
        walk(
            box, [&](std::size_t node) { return slabs_[node].isReached(triangle); }, visit);
    }

    /// Calls visit(index) for each box that meets `box`, in ascending order within a leaf only.
    template <class Visit>
    void forEach(const IntegerBox& box, const Visit& visit) const {
        walk(
            box, [](std::size_t) { return true; }, visit);
    }
    /// The boxes that meet `box`, in ascending order.
    [[nodiscard]] std::vector<std::uint32_t> findAll(const IntegerBox& box) const {
        std::vector<std::uint32_t> found;
        forEach(box, [&](std::uint32_t i) { found.push_back(i); });
        std::sort(found.begin(), found.end());
        return found;
    }
    [[nodiscard]] const std::vector<IntegerBox>& boxes() const noexcept { return boxes_; }
    [[nodiscard]] IntegerBox bounds() const noexcept { return nodes_.empty() ? IntegerBox{} : nodes_.front().box; }

private:
    struct Node {
        IntegerBox box;
        std::uint32_t begin = 0, end = 0;
        std::uint32_t right = 0;  // the left child follows; 0: a leaf
    };
    struct Slab {
        Vec3d normal{};
        double low = 0, high = 0;
        [[nodiscard]] bool isReached(const RoundTriangle& t) const noexcept {
            const double a = dot(normal, t[0]), b = dot(normal, t[1]), c = dot(normal, t[2]);
            return std::min({a, b, c}) <= high && std::max({a, b, c}) >= low;
        }
    };

    void split(std::uint32_t begin, std::uint32_t end);
    [[nodiscard]] Slab slabOf(const Node& node, Vec3d normal, const std::vector<RoundTriangle>& triangles) const;

    template <class IsReached, class Visit>
    void walk(const IntegerBox& box, const IsReached& isReached, const Visit& visit) const {
        if (nodes_.empty()) return;
        std::uint32_t open[64];
        int count = 0;
        open[count++] = 0;
        while (count > 0) {
            const std::uint32_t at = open[--count];
            const Node& node = nodes_[at];
            if (!node.box.meets(box) || !isReached(at)) continue;
            if (node.right != 0) {
                open[count++] = node.right;
                open[count++] = at + 1;
                continue;
            }
            for (std::uint32_t i = node.begin; i < node.end; ++i)
                if (boxes_[order_[i]].meets(box)) visit(order_[i]);
        }
    }

    std::vector<IntegerBox> boxes_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
    std::vector<Slab> slabs_;  // of nodes; empty without addSlabs()
};

}  // namespace svt::validate
