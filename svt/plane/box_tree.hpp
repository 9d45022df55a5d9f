#pragma once
/// \file
/// A bounding volume hierarchy over boxes in space, to find the boxes near a place.

#include <svt/plane/point.hpp>

#include <span>
#include <vector>

namespace svt::plane {

/// Corners of a triangle in space.
using SpaceTriangle = std::array<Vec3d, 3>;

/// The box, extended by `by` on all sides. Exact for whole numbers up to 2^52.
[[nodiscard]] inline Box3d grown(const Box3d& box, double by) noexcept {
    return {box.min - Vec3d{by, by, by}, box.max + Vec3d{by, by, by}};
}

/// A binary tree whose nodes are split at the middle box.
class BoxTree {
public:
    /// How a node is split. It determines the order in which boxes are found.
    struct Halving {
        std::uint32_t leafSize = 4;  ///< maximum number of boxes of a node that is not split
        bool usesCenters = true;     ///< along the longest axis of the centers of boxes; false: of the boxes
    };

    BoxTree() = default;
    /// Cost: O(n log n).
    explicit BoxTree(std::vector<Box3d> boxes, Halving halving);
    explicit BoxTree(std::vector<Box3d> boxes) : BoxTree(std::move(boxes), Halving{}) {}

    /// Gives each node a slab in addition to its box: the space between two parallel planes perpendicular to a normal
    /// of one of its triangles. The boxes of long slanted triangles side by side all meet, but their slabs do not
    /// (Gottschalk 1996, "OBBTree").
    /// \param triangles  one per box, in the same order; coordinates are whole numbers of up to 40 bits
    /// Cost: O(n log n).
    void addSlabs(const std::vector<SpaceTriangle>& triangles);

    /// Calls `take(i)` for each box i with isNear(box), until one call returns true. `isNear` must hold for a box if it
    /// holds for a box inside it. The order is that of the tree.
    /// \return whether a call returned true
    template <class IsNear, class Take>
    [[nodiscard]] bool visit(const IsNear& isNear, const Take& take) const {
        return walk([&](const Box3d& box, std::uint32_t) { return isNear(box); }, isNear, take);
    }

    /// As visit(), but the child of a node that lies first along `direction` comes first. So a ray that ends at its
    /// first hit tests fewer boxes. Calls `body(i)` for each box i with isNear(box).
    template <class IsNear, class Body>
    void forEachAlong(Vec3d direction, const IsNear& isNear, const Body& body) const {
        const auto isRightFirst = [&](const Box3d& left, const Box3d& right) {
            return dot(right.center() - left.center(), direction) < 0;
        };
        static_cast<void>(
            walk([&](const Box3d& box, std::uint32_t) { return isNear(box); }, isNear, untilEnd(body), isRightFirst));
    }

    /// Calls `body(i)` for each box i with isNear(box).
    template <class IsNear, class Body>
    void forEach(const IsNear& isNear, const Body& body) const {
        static_cast<void>(visit(isNear, untilEnd(body)));
    }
    /// Calls `body(i)` for each box i that overlaps `box`.
    template <class Body>
    void forEach(const Box3d& box, const Body& body) const {
        forEach([&](const Box3d& other) { return other.overlaps(box); }, body);
    }
    /// As forEach(box, body), without boxes in slabs that `triangle` does not reach. Requires addSlabs().
    template <class Body>
    void forEachBeside(const Box3d& box, const SpaceTriangle& triangle, const Body& body) const {
        const auto isNear = [&](const Box3d& other) { return other.overlaps(box); };
        static_cast<void>(walk(
            [&](const Box3d& other, std::uint32_t node) { return isNear(other) && isReached(slabs_[node], triangle); },
            isNear, untilEnd(body)));
    }
    /// The boxes that overlap `box`, in ascending order.
    [[nodiscard]] std::vector<std::uint32_t> findAll(const Box3d& box) const;

    [[nodiscard]] const std::vector<Box3d>& boxes() const noexcept { return boxes_; }
    /// The box around all boxes; empty if there is none.
    [[nodiscard]] Box3d bounds() const noexcept { return nodes_.empty() ? Box3d{} : nodes_.front().box; }

private:
    struct Node {
        Box3d box;
        std::uint32_t begin = 0, end = 0;  // of order_
        std::uint32_t right = 0;           // right child of an inner node, whose left child is the next; 0 for a leaf
    };
    struct Slab {
        Vec3d normal{};
        double low = 0, high = 0;
    };
    struct Place {
        Vec3d center;
        std::uint32_t box;
    };
    // The node of order_[begin] and the following, which `places` names.
    std::uint32_t build(std::uint32_t begin, std::span<Place> places, Halving halving);
    [[nodiscard]] Slab slabOf(const Node& node, Vec3d normal, const std::vector<SpaceTriangle>& triangles) const;
    [[nodiscard]] static bool isReached(const Slab& slab, const SpaceTriangle& triangle) noexcept;

    template <class Body>
    static auto untilEnd(const Body& body) {
        return [&body](std::uint32_t i) {
            body(i);
            return false;
        };
    }

    struct LeftFirst {
        bool operator()(const Box3d&, const Box3d&) const noexcept { return false; }
    };

    template <class IsNodeNear, class IsNear, class Take, class IsRightFirst = LeftFirst>
    [[nodiscard]] bool walk(const IsNodeNear& isNodeNear, const IsNear& isNear, const Take& take,
                            const IsRightFirst& isRightFirst = {}) const {
        std::uint32_t stack[64];  // the tree is at most 32 nodes deep
        std::uint32_t depth = 0;
        if (!nodes_.empty()) stack[depth++] = 0;
        while (depth != 0) {
            const std::uint32_t index = stack[--depth];
            const Node& node = nodes_[index];
            if (!isNodeNear(node.box, index)) continue;
            if (node.right != 0) {
                const bool isSwapped = isRightFirst(nodes_[index + 1].box, nodes_[node.right].box);
                stack[depth++] = isSwapped ? index + 1 : node.right;
                stack[depth++] = isSwapped ? node.right : index + 1;
                continue;
            }
            for (std::uint32_t i = node.begin; i < node.end; ++i)
                if (isNear(boxes_[order_[i]]) && take(order_[i])) return true;
        }
        return false;
    }

    std::vector<Box3d> boxes_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
    std::vector<Slab> slabs_;  // of nodes; empty without addSlabs()
};

}  // namespace svt::plane
