#pragma once
/// \file
/// A bounding volume hierarchy over the faces of one mesh, for rays.

#include <svt/mesh/mesh_set.hpp>

#include <cstdint>
#include <vector>

namespace svt::mesh {

/// A triangle with an area, ready for rays.
struct RayFace {
    Vec3d a, ab, ac, unitNormal, center;
    std::uint32_t triangle;  ///< index in the mesh
};

/// Distance along the ray to the plane of a face where the ray meets it, in lengths of `direction`, or infinity
/// (Moeller & Trumbore 1997). Negative behind the origin.
[[nodiscard]] double hitFace(const RayFace& face, Vec3d origin, Vec3d direction) noexcept;

/// The faces with an area, halved by their middles along the longest side of their box, up to 4 in a leaf.
class FaceTree {
public:
    /// Cost: O(n log n).
    FaceTree(const std::vector<Vec3d>& vertices, const std::vector<Triangle>& triangles);

    [[nodiscard]] const std::vector<RayFace>& faces() const noexcept { return faces_; }

    /// Calls `body(face)` for the faces in all leaves whose boxes the ray meets before `nearest`, in lengths of
    /// `direction`. The body may lower `nearest`.
    template <class F>
    void forEachNear(Vec3d origin, Vec3d direction, double& nearest, F&& body) const {
        if (nodes_.empty()) return;
        const Vec3d inverse{1 / direction.x, 1 / direction.y, 1 / direction.z};
        std::uint32_t stack[64];  // the tree halves: as deep as the number of faces has bits
        std::size_t depth = 0;
        stack[depth++] = 0;
        while (depth != 0) {
            const std::uint32_t index = stack[--depth];
            const Node& node = nodes_[index];
            if (!hitsBox(node.box, origin, inverse, nearest)) continue;
            if (node.right != 0) {
                stack[depth++] = node.right;
                stack[depth++] = index + 1;
                continue;
            }
            for (std::uint32_t f = node.begin; f < node.end; ++f) body(faces_[f]);
        }
    }

private:
    struct Node {
        Box3d box;
        std::uint32_t begin = 0, end = 0;  // faces below the node; tested in leaves
        std::uint32_t right = 0;           // right child of an inner node, whose left child is the next; 0 for a leaf
    };
    static bool hitsBox(const Box3d& box, Vec3d origin, Vec3d inverse, double nearest) noexcept;
    std::uint32_t build(std::uint32_t begin, std::uint32_t end);

    std::vector<RayFace> faces_;
    std::vector<Node> nodes_;
};

}  // namespace svt::mesh
