#pragma once
/// \file
/// How far faces are from the faces of another object.

#include <svt/compare/shape/shapes.hpp>

#include <cstdint>
#include <vector>

namespace svt::compare {

/// A tree of boxes over the triangles of one object. Thread-safe to read.
class FaceTree {
public:
    /// Cost: O(n log n) for n triangles.
    explicit FaceTree(const Faces& faces);

    /// A triangle near the last point: the search for a point beside it begins there.
    struct Hint {
        std::uint32_t triangle = 0;
    };
    /// Distance from a point to the nearest triangle, metres; infinite without triangles.
    /// \param enough  the search ends at a triangle within this distance, and returns its distance
    /// \param hint    any; receives the triangle of the result. It saves time, and never changes a result above `enough`
    /// Cost: O(log n) where the triangles are spread in space; O(1) if the hint is within `enough`.
    [[nodiscard]] double distanceTo(Vec3d point, double enough, Hint& hint) const;
    [[nodiscard]] double distanceTo(Vec3d point, double enough = 0) const {
        Hint hint;
        return distanceTo(point, enough, hint);
    }

private:
    struct Node {
        Box3d box;
        std::uint32_t first = 0, count = 0;  ///< of triangles; count 0: the children are the next node and `first`
    };
    std::uint32_t build(std::uint32_t first, std::uint32_t count);

    std::vector<std::array<Vec3d, 3>> triangles_;
    std::vector<Node> nodes_;
};

/// A turn about a vertical axis, and a move.
struct Turn {
    Vec3d from{}, to{};           ///< the axis goes through `from`, and `from` moves to `to`
    double cosine = 1, sine = 0;  ///< of the angle, counter-clockwise seen from above

    [[nodiscard]] Vec3d operator()(Vec3d point) const noexcept {
        const Vec3d off = point - from;
        return to + Vec3d{cosine * off.x - sine * off.y, sine * off.x + cosine * off.y, off.z};
    }
    [[nodiscard]] Turn reversed() const noexcept { return {to, from, cosine, -sine}; }
};

/// The largest distance from points on `faces` to `other`: corners, midpoints of edges, and centres of all triangles, so
/// at most the directed Hausdorff distance.
/// \param shift  added to all points
/// \param step   metres between further points on each triangle; 0: none
[[nodiscard]] double largestDistance(const Faces& faces, const FaceTree& other, Vec3d shift = {}, double step = 0);
/// The same from points that are turned first. The search ends at the first point farther away than `most` metres.
[[nodiscard]] double largestDistance(const Faces& faces, const FaceTree& other, const Turn& turn, double most);

}  // namespace svt::compare
