#pragma once
/// \file
/// Triangles in a tree of boxes, from which a ray takes its crossings in order of depth.
///
/// Watertight: the ray becomes the origin of a plane (Woop, Benthin & Wald 2013). Each corner has one place there, for
/// all triangles. Two triangles that share an edge evaluate the same expression for it, with opposite signs. Where it is
/// zero, the ray counts as moved aside by an infinitesimal step, the same for all edges (simulation of simplicity:
/// Edelsbrunner & Mücke 1990). So a ray crosses a closed mesh as often inwards as outwards.

#include <svt/core/vec.hpp>
#include <svt/render/faces/face_beam.hpp>
#include <svt/render/voxel_ray.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace svt::render {

/// Corners are counter-clockwise from outside.
struct FaceTriangle {
    std::array<std::uint32_t, 3> corners{};
    std::uint32_t object = 0;
};

/// Where a ray crosses a triangle.
struct FaceCrossing {
    double t = -std::numeric_limits<double>::infinity();
    std::uint32_t triangle = 0;
    bool isEntry = false;

    [[nodiscard]] bool isBefore(const FaceCrossing& other) const noexcept {
        return t < other.t || (t == other.t && triangle < other.triangle);
    }
};

/// The plane across a ray: the axis that it follows most, and its slopes along the other two.
struct RayAcross {
    int x, y, along;
    double slopeX, slopeY;
    double squaredLength;  ///< of the direction
    bool isBackwards;
    explicit RayAcross(const VoxelRay& ray) noexcept;
};

class FaceTree {
public:
    static constexpr std::size_t kBatch = 12;
    using Batch = std::array<FaceCrossing, kBatch>;

    FaceTree() = default;
    /// \param points  voxel space
    FaceTree(std::vector<Vec3d> points, std::vector<FaceTriangle> triangles);

    /// The first crossings after `last`, up to t = `to`, in order.
    /// \param most  of them, 1 to kBatch
    /// \return their number; `most` if there may be more
    [[nodiscard]] std::size_t findNext(const VoxelRay& ray, const FaceCrossing& last, double to, std::size_t most,
                                       Batch& batch) const;

    /// Finds the triangles that rays of a beam may cross, by increasing BeamTriangle::from.
    /// \return false, and an incomplete list, if there are more than `most`
    [[nodiscard]] bool collect(const FaceBeam& beam, std::size_t most, std::vector<BeamTriangle>& found) const;
    /// Tests a triangle of a beam that contains the ray.
    /// \return whether the ray crosses it: the same crossings as those of findNext()
    [[nodiscard]] bool cross(const BeamTriangle& triangle, BeamPlace place, const VoxelRay& ray,
                             const RayAcross& across, FaceCrossing& crossing) const noexcept;
    [[nodiscard]] const FaceTriangle& triangle(std::uint32_t number) const noexcept { return triangles_[number]; }
    /// Normal of a triangle, outwards, voxel space, not of unit length.
    [[nodiscard]] Vec3d normal(std::uint32_t number) const noexcept;
    [[nodiscard]] std::size_t sizeBytes() const noexcept;

private:
    struct Box {
        std::array<float, 3> min{}, max{};
    };
    struct Node : Box {
        std::uint32_t first = 0;  // leaf: its first triangle; else: its first child, followed by the second
        std::uint32_t count = 0;  // triangles of a leaf; 0: two children
    };
    struct Span {
        double from, to;
    };
    [[nodiscard]] static Span spanOf(const Box& box, const VoxelRay& ray) noexcept;
    [[nodiscard]] Node boundsOf(std::size_t begin, std::size_t end) const noexcept;
    void split(std::size_t node, std::size_t begin, std::size_t end, int depth);
    [[nodiscard]] std::size_t splitPlace(std::size_t begin, std::size_t end);
    [[nodiscard]] bool cross(std::uint32_t number, const VoxelRay& ray, const RayAcross& across,
                             FaceCrossing& crossing) const noexcept;

    // Calls visit(crossing) for the crossings from about `from` up to `to`, which it may lower; near boxes first.
    template <class Visit>
    void traverse(const VoxelRay& ray, double from, const double& to, const Visit& visit) const;
    [[nodiscard]] Box boxOf(std::uint32_t triangle) const noexcept;

    std::vector<Vec3d> points_;
    std::vector<FaceTriangle> triangles_;
    std::vector<Node> nodes_;
};

}  // namespace svt::render
