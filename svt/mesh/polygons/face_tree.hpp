#pragma once
/// \file
/// The faces of one mesh, found by rays.

#include <svt/mesh/mesh_set.hpp>
#include <svt/plane/box_tree.hpp>

#include <algorithm>
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

/// Whether a ray meets a box before `nearest` (slab test, Kay & Kajiya 1986). `inverse`: 1 / direction.
[[nodiscard]] inline bool hitsBox(const Box3d& box, Vec3d origin, Vec3d inverse, double nearest) noexcept {
    double low = 0, high = nearest;
    for (int axis = 0; axis < 3; ++axis) {
        const bool isBackward = inverse[axis] < 0;
        // NaN (0 * inf, for a ray in a face of the slab) leaves the bounds unchanged: std::max and std::min then return
        // their first argument.
        low = std::max(low, ((isBackward ? box.max : box.min)[axis] - origin[axis]) * inverse[axis]);
        high = std::min(high, ((isBackward ? box.min : box.max)[axis] - origin[axis]) * inverse[axis]);
    }
    return low <= high * (1 + 1e-12) + 1e-12;
}

/// The faces of a mesh that have an area, in a tree of their boxes.
///
/// The rays of a building meet 10 to 200 boxes each. Where thin triangles lie across each other's boxes, as in a star
/// of many thousand spikes, each ray would meet all of them. So all rays together may test 256 boxes per face plus 34
/// million boxes.
/// Threads: one at a time.
class FaceTree {
public:
    /// Cost: O(n log n).
    FaceTree(const std::vector<Vec3d>& vertices, const std::vector<Triangle>& triangles);

    /// In the order of the mesh.
    [[nodiscard]] const std::vector<RayFace>& faces() const noexcept { return faces_; }

    /// True if a ray ended because too many boxes were tested: its result must not be used.
    [[nodiscard]] bool isExhausted() const noexcept { return testsLeft_ == 0; }

    /// Calls `body(face)` for the faces whose boxes the ray meets before `nearest`, in lengths of `direction`. The body
    /// may lower `nearest`.
    template <class F>
    void forEachNear(Vec3d origin, Vec3d direction, double& nearest, F&& body) {
        const Vec3d inverse{1 / direction.x, 1 / direction.y, 1 / direction.z};
        const auto isNear = [&](const Box3d& box) {
            if (testsLeft_ == 0) return false;
            --testsLeft_;
            return hitsBox(box, origin, inverse, nearest);
        };
        tree_.forEachAlong(direction, isNear, [&](std::uint32_t f) { body(faces_[f]); });
    }

private:
    std::vector<RayFace> faces_;
    plane::BoxTree tree_;
    std::uint64_t testsLeft_;
};

}  // namespace svt::mesh
