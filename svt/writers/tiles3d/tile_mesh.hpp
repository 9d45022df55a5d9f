#pragma once
/// \file
/// The triangles of a tile: faces of features, and the vertices that they become.

#include <svt/core/vec.hpp>
#include <svt/writers/gltf/label_surface.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace svt::writers {

using VertexColor = std::array<std::uint8_t, 4>;  ///< linear, with opacity

/// Converts a colour from sRGB to a vertex colour of glTF, which is linear.
[[nodiscard]] VertexColor linearColor(Vec3f color, float opacity) noexcept;

/// Triangles of a feature. World directions, metres.
struct FeatureFaces {
    std::vector<Vec3d> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<VertexColor> colors;  ///< per triangle

    /// Appends a surface without triangles of zero area.
    /// \param places   positions of its vertices
    /// \param colorOf  takes the normal of a face
    void add(const LabelSurface& surface, std::span<const Vec3d> places,
             const std::function<VertexColor(Vec3d)>& colorOf);
};

/// Replaces all points in a cube of the lattice with this side by their mean. Triangles that lose their area are left
/// out, and so is the second of two with the same corners. A point moves by less than the diagonal of the cube.
/// Cost: O(n log n).
[[nodiscard]] FeatureFaces simplified(const FeatureFaces& faces, double side);

/// The vertices of a tile, each attribute in its own array. A vertex has the colour of its faces,
/// and their normal within a step.
struct TileMesh {
    std::vector<Vec3f> positions;                     ///< y up, metres
    std::vector<std::array<std::int8_t, 4>> normals;  ///< y up, in 127 steps; the last number is 0
    std::vector<VertexColor> colors;
    std::vector<std::uint32_t> features;
    std::vector<std::uint32_t> indices;
    bool isDoubleSided = false;  ///< it has faces of meshes, which need not be closed

    void append(const FeatureFaces& faces, std::uint32_t feature);
};

}  // namespace svt::writers
