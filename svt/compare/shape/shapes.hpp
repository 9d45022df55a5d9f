#pragma once
/// \file
/// The shape of each object of a volume by figures that do not depend on its triangulation.

#include <svt/core/vec.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace svt::compare {

/// The triangles of an object, in the space of both volumes: metres from the grid origin of the first.
struct Faces {
    std::span<const volume::VectorParts::Triangle> triangles;
    const volume::VectorParts* parts = nullptr;
    Vec3d offset{};

    [[nodiscard]] std::array<Vec3d, 3> corners(std::size_t triangle) const noexcept {
        const auto& c = triangles[triangle].corners;
        return {parts->position(c[0], offset), parts->position(c[1], offset), parts->position(c[2], offset)};
    }
};

struct Shape {
    std::uint32_t label = 0;
    Faces faces;             ///< without triangles, if the volume keeps none for the object
    bool isSolid = false;    ///< whether the mesh is closed
    bool isCounted = false;  ///< whether voxels decide its volume: open shells, material behind surfaces
    std::uint64_t voxels = 0;
    std::uint64_t uncertainVoxels = 0;  ///< that other objects took, or that may lie outside of an open shell
    Box3d box;
    double area = 0;               ///< m2 of all faces
    std::optional<double> volume;  ///< m3 of a closed mesh
    Vec3d center{};                ///< centre of area; centre of the box without triangles
    /// Second moments of area about the centre, m4: xx, yy, zz, xy, yz, zx. A symmetric matrix that turns with the object.
    std::array<double, 6> moments{};
    std::uint64_t digest = 0;  ///< of the triangles, in any order; 0: without triangles
};

/// The shapes of all objects, ascending by label.
/// \param offset  from the grid origin of the first volume to that of this one
/// Cost: O(triangles), and O(voxel runs) if an object has no triangles.
[[nodiscard]] std::vector<Shape> findShapes(const volume::SemanticVolume& volume, Vec3d offset);

/// Whether area, centre and moments agree so well that faces within `distance` metres of each other explain the rest. A
/// hole changes them by more.
/// \param shift  added to the centre of `a`
[[nodiscard]] bool agreeWithin(const Shape& a, const Shape& b, double distance, Vec3d shift = {}) noexcept;

/// Whether one shape may be the other, moved: areas, moments and closed volumes agree within rounding and `tolerance`.
[[nodiscard]] bool areAlike(const Shape& a, const Shape& b, double tolerance) noexcept;

/// Whether one closed mesh may be the other, rotated and moved: areas, volumes and the invariants of the second moments
/// agree.
[[nodiscard]] bool areAlikeTurned(const Shape& a, const Shape& b, double tolerance) noexcept;

/// Whether the shapes are alike and at the same place, within `tolerance` metres.
[[nodiscard]] bool areAtOnePlace(const Shape& a, const Shape& b, double tolerance) noexcept;

}  // namespace svt::compare
