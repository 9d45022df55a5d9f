#pragma once
/// \file
/// A bounding volume hierarchy over boxes, to find the few of very many that are near something.

#include <svt/core/vec.hpp>

#include <cstdint>
#include <vector>

namespace svt::mesh {

class BoxTree {
public:
    /// Cost: O(n log n).
    explicit BoxTree(std::vector<Box3d> boxes);

    /// Calls `take(i)` for each box i with isNear(box), until one call returns true. `isNear` must hold for a box if it
    /// holds for one inside of it. The order is that of the tree.
    /// \return whether a call returned true
    template <class IsNear, class Take>
    [[nodiscard]] bool visit(const IsNear& isNear, const Take& take) const {
        std::uint32_t stack[64];  // halves go down at most 32 steps
        std::uint32_t depth = 0;
        if (!nodes_.empty()) stack[depth++] = 0;
        while (depth != 0) {
            const std::uint32_t index = stack[--depth];
            const Node& node = nodes_[index];
            if (!isNear(node.box)) continue;
            if (node.right != 0) {
                stack[depth++] = node.right;
                stack[depth++] = index + 1;
                continue;
            }
            for (std::uint32_t i = node.begin; i < node.end; ++i)
                if (isNear(boxes_[order_[i]]) && take(order_[i])) return true;
        }
        return false;
    }

    /// Calls `body(i)` for each box i with isNear(box).
    template <class IsNear, class Body>
    void forEach(const IsNear& isNear, const Body& body) const {
        static_cast<void>(visit(isNear, [&](std::uint32_t i) {
            body(i);
            return false;
        }));
    }

private:
    struct Node {
        Box3d box;
        std::uint32_t begin = 0, end = 0;  // of order_
        std::uint32_t right = 0;           // right child of an inner node, whose left child is the next; 0 for a leaf
    };
    std::uint32_t build(std::uint32_t begin, std::uint32_t end);

    std::vector<Box3d> boxes_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace svt::mesh
