#pragma once
/// \file
/// Sections of closed meshes across any direction, and hits of short rays. Local space: metres from the grid's lower
/// corner along world axes.

#include <svt/core/vec.hpp>
#include <svt/plane/box_tree.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace svt::quantities {

using FlatPoint = std::array<double, 2>;

/// A plane with axes: u, v and normal are orthonormal and right-handed.
struct SectionPlane {
    Vec3d origin{}, u{}, v{}, normal{};

    [[nodiscard]] static SectionPlane across(Vec3d normal, Vec3d origin) noexcept;
    [[nodiscard]] FlatPoint flat(Vec3d p) const noexcept { return {dot(p - origin, u), dot(p - origin, v)}; }
    [[nodiscard]] Vec3d inSpace(FlatPoint p) const noexcept { return origin + u * p[0] + v * p[1]; }
};

/// A piece of the border of a claim in the plane; the claim lies to the left.
struct FlatSegment {
    FlatPoint from{}, to{};
    std::uint32_t claim = 0;
};

/// The closed meshes of a volume, as bodies: the parts of a mesh that share no point, such as the bars of a group. A
/// cavity is a body, too, whose sections have the other direction. Thread-safe to read.
class MeshSections {
public:
    /// \param volume  must outlive this
    /// Cost: O(n log n) in triangles.
    explicit MeshSections(const volume::SemanticVolume& volume);

    [[nodiscard]] bool isClosed(std::uint32_t label) const noexcept { return isClosed_[label] != 0; }

    /// The bodies whose boxes overlap a box, ascending, and so by label.
    [[nodiscard]] std::vector<std::uint32_t> bodiesNear(const Box3d& box) const { return boxes_.findAll(box); }
    /// The same, but nothing if there are more than `most`. Cost: O(log n + most).
    [[nodiscard]] std::optional<std::vector<std::uint32_t>> bodiesNear(const Box3d& box, std::size_t most) const;
    [[nodiscard]] std::uint32_t labelOf(std::uint32_t body) const noexcept { return bodies_[body].label; }

    /// Appends the section of a body. Points of edges that triangles share are equal to the last bit.
    /// Cost: O(log n + triangles that the plane cuts).
    void addSection(std::uint32_t body, const SectionPlane& plane, std::uint32_t claim,
                    std::vector<FlatSegment>& segments) const;

    /// The distance from a point to a body along a way, as a fraction of it; above 1: none.
    [[nodiscard]] double hitAt(std::uint32_t body, Vec3d from, Vec3d way) const;

private:
    struct Body {
        std::uint32_t label = 0;
        std::vector<volume::VectorParts::Triangle> triangles;
        plane::BoxTree tree;  // of its triangles
    };
    void addBodies(std::span<const volume::VectorParts::Triangle> triangles, std::vector<std::uint32_t>& parent);
    [[nodiscard]] std::array<Vec3d, 3> cornersOf(const volume::VectorParts::Triangle& triangle) const noexcept;

    const volume::SemanticVolume& volume_;
    std::vector<Body> bodies_;    // by label
    std::vector<char> isClosed_;  // by label
    plane::BoxTree boxes_;        // of bodies
};

}  // namespace svt::quantities
