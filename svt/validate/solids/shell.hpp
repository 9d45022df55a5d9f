#pragma once
/// \file
/// A shell as faces and triangles over shared points, and the tests of one shell.

#include <svt/plane/box_tree.hpp>
#include <svt/validate/exact/snapper.hpp>
#include <svt/validate/polygons/defect.hpp>
#include <svt/validate/polygons/polygon_checks.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::validate {

/// A face: rings of indices of points, in the direction of its use.
struct Face {
    std::uint32_t polygon = 0;  ///< in BuildingModel::polygons
    std::vector<std::vector<std::uint32_t>> rings;
};

struct Shell {
    std::vector<Face> faces;
    std::vector<Corners> triangles;     ///< indices of points, in the direction of their faces
    std::vector<std::uint32_t> faceOf;  ///< of each triangle
};

/// Points of a geometry and their places in the world.
struct PointSet {
    const std::vector<Point>* points = nullptr;
    const Lattice* lattice = nullptr;
    double snap = 0;  ///< in units

    [[nodiscard]] const Point& at(std::uint32_t i) const { return (*points)[i]; }
    [[nodiscard]] Vec3d units(std::uint32_t i) const { return Lattice::local(at(i)); }
    [[nodiscard]] Vec3d world(std::uint32_t i) const { return lattice->toWorld(at(i)); }
    [[nodiscard]] std::array<Point, 3> corners(const Corners& t) const { return {at(t[0]), at(t[1]), at(t[2])}; }
};

/// The tree of boxes of triangles or of bodies. Its order decides which piece of a surface is found first.
[[nodiscard]] inline plane::BoxTree treeOf(std::vector<Box3d> boxes) {
    return plane::BoxTree(std::move(boxes), {.leafSize = 6, .usesCenters = false});
}

/// The tests of a shell.
struct ShellRules {
    bool isClosed = true;  ///< false for a CompositeSurface, which may have a border
};

/// Maximum number of findings of each kind per shell.
inline constexpr std::size_t kLargestDefectCount = 100;

/// Tests faces that are valid themselves: enough faces, every edge used by two in opposite directions, one umbrella
/// around every point, one piece, closed, free of intersections. The tests end with the first that fails.
/// Cost: O(n log n) for faces that meet only at their borders.
[[nodiscard]] std::vector<Defect> checkShell(const Shell& shell, const PointSet& points, const ShellRules& rules = {});

/// Six times the volume that a closed shell encloses, in units; positive if its faces are oriented outwards.
[[nodiscard]] double sixfoldVolume(std::span<const Corners> triangles, const PointSet& points) noexcept;

}  // namespace svt::validate
