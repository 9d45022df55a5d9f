#pragma once
/// \file
/// The content of a tile as .glb: its triangles, whose vertices reference their features (EXT_mesh_features), and the
/// table of features (EXT_structural_metadata).
///
/// A vertex has 16 bytes (KHR_mesh_quantization): its place in up to 65535 steps (8 bytes), its normal in
/// 127 steps (4), and the number of its feature (4). A step is at most TileCoding::mostStep, and a 64th of short edges,
/// unless the longest side needs more. Places are 32-bit floats (12 bytes) if the steps would be too large. The colour is that of the material: one primitive per colour, all with the same
/// vertices; or 4 bytes more for tiles of many colours.

#include <svt/core/result.hpp>
#include <svt/writers/tiles3d/property_table.hpp>
#include <svt/writers/tiles3d/tile_mesh.hpp>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <functional>
#include <string>

namespace svt::writers {

inline constexpr double kFinestStep = 0.01;  ///< largest step of places in finest content, metres

struct TileCoding {
    double mostStep = kFinestStep;  ///< largest step of places, metres
    /// Vertices, indices and offsets of texts by EXT_meshopt_compression. Places that several faces have stay as they
    /// are, because gzip makes them smaller.
    bool isCompressed = false;
};

/// \param features  rows of the table
/// \param metadata  adds columns to the buffer, and returns the extension EXT_structural_metadata
/// \param place     position of the mesh, world directions, metres
/// \param coding    of the vertices
/// \return the file; GridTooLarge if it would reach the limit of 4 GiB; NothingSelected without triangles
[[nodiscard]] Result<std::string> makeTileGlb(const TileMesh& mesh, std::size_t features,
                                              const std::function<nlohmann::ordered_json(GltfBuffer&)>& metadata,
                                              Vec3d place, const TileCoding& coding);

/// A .glb of a document and its only buffer, which begins at a multiple of 8 bytes.
[[nodiscard]] std::string asGlbFile(const nlohmann::ordered_json& json, const std::string& binary);

}  // namespace svt::writers
