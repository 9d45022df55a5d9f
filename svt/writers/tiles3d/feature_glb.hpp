#pragma once
/// \file
/// A tile's content: hulls of labels as one .glb whose vertices reference their features (EXT_mesh_features), and a
/// table with one row per feature (EXT_structural_metadata).

#include <svt/writers/hulls/label_hulls.hpp>
#include <svt/writers/tiles3d/property_table.hpp>

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace svt::writers {

/// Texts for the rows of the table, one entry per label.
struct FeatureTexts {
    std::vector<std::string> storeys;  ///< name or id of the storey of a label; may be empty
    std::vector<double> volumes;       ///< m3
};
[[nodiscard]] FeatureTexts featureTexts(const volume::SemanticVolume& volume);

/// Surfaces [begin, end) as a .glb, y up, metres from the lower corner of the grid; feature n is surface begin + n.
/// Shading is flat: a vertex has the normal of its face, and is stored once per face.
/// \return the file, or GridTooLarge if it would reach the limit of 4 GiB
[[nodiscard]] Result<std::string> makeFeatureGlb(const LabelHulls& hulls, std::size_t begin, std::size_t end,
                                                 const FeatureTexts& texts);

using VertexColor = std::array<std::uint8_t, 4>;  ///< linear, with opacity

/// The vertices of a primitive, each attribute in its own array; a vertex has the normal of its face.
struct FlatMesh {
    std::vector<Vec3f> positions, normals;  ///< y up
    std::vector<VertexColor> colors;
    std::vector<float> features;
    std::vector<std::uint32_t> indices;

    /// Appends a surface without triangles of zero area.
    /// \param places   positions of its vertices, world directions, metres
    /// \param colorOf  takes the normal of a face
    void append(const LabelSurface& surface, std::span<const Vec3d> places, float feature,
                const std::function<VertexColor(Vec3d)>& colorOf);

    [[nodiscard]] std::uint64_t sizeBytes() const noexcept { return positions.size() * 32 + indices.size() * 4; }
};

/// Converts a colour from sRGB to a vertex colour of glTF, which is linear.
[[nodiscard]] VertexColor linearColor(Vec3f color, float opacity) noexcept;

/// Converts a direction of the world (z up) to glTF (y up).
[[nodiscard]] Vec3f withYUp(Vec3d v) noexcept;

/// The storage of vertices.
enum class VertexStorage {
    Full,  ///< 32 bytes: places and normals as floats
    /// 20 bytes: places in 65535 steps of the longest side, normals in 127 (KHR_mesh_quantization). Indices have two
    /// bytes if possible.
    Quantized
};

/// Writes meshes as a .glb, each a primitive with a material, and the table of their features.
/// \param clear     blended; may be empty, as may `opaque`; not available if quantized
/// \param metadata  adds columns to the buffer, and returns the extension EXT_structural_metadata
/// \param place     position of the meshes, world directions, metres
/// \return the file; GridTooLarge if it would reach the limit of 4 GiB; NothingSelected without triangles
[[nodiscard]] Result<std::string> makeMeshGlb(const FlatMesh& opaque, const FlatMesh& clear, std::size_t features,
                                              const std::function<nlohmann::ordered_json(GltfBuffer&)>& metadata,
                                              Vec3d place, VertexStorage storage);

/// A .glb of a document and its only buffer, which begins at a multiple of 8 bytes.
[[nodiscard]] std::string asGlbFile(const nlohmann::ordered_json& json, const std::string& binary);

/// The box around surfaces [begin, end), world directions, metres from the lower corner.
[[nodiscard]] Box3d boxOfHulls(const LabelHulls& hulls, std::size_t begin, std::size_t end);

}  // namespace svt::writers
