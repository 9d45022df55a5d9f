#pragma once
/// \file
/// Writes the labels of a volume as triangles to one binary glTF 2.0 file (.glb), which Blender, Windows, three.js,
/// Cesium and most other 3D programs open.
///
///     header       12 bytes: "glTF", 2, length of the file.
///     JSON chunk   scene: a root node, below it the labels as a tree, each with its own mesh and material.
///     BIN chunk    positions of all labels, then their indices; see bufferViews.
///
/// Space: metres. Mesh positions are relative to the grid's lower corner, the outer corner of sample (0, 0, 0), along
/// the grid's axes x, y, z. The matrix of the root node rotates them to world directions with y up, as glTF requires:
/// east is +x, height +y, north -z. The lower corner is at the origin, which keeps coordinates small;
/// `asset.extras.origin` has its world coordinates, `asset.extras.crs` their CRS.
///
/// A label: the node's `name` is the label's name or id, its `extras` hold `id` and `class`. The material has the
/// label's colour, linear as glTF requires. Its opacity is the fraction of light that one metre of the label stops, or
/// that of a pane of glass in the model, because a surface has no thickness. Spaces have the opacity 0 beside anything
/// else, as in pictures. No normals are written: glTF then requires flat shading.

#include <svt/core/names.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/surface_source.hpp>

#include <array>
#include <cstdint>
#include <filesystem>

namespace svt::writers {

/// Placement of the surface vertices.
enum class GlbFaces : std::uint8_t {
    Planes,  ///< on the oblique planes of the original geometry, if known; see SlopeVertices
    Voxels,  ///< on voxel corners: slopes are stairs
    Meshes   ///< triangles of the model, where the volume keeps them; otherwise as Planes
};
constexpr auto namesOf(GlbFaces) {
    return std::to_array<Name<GlbFaces>>(
        {{GlbFaces::Planes, "planes"}, {GlbFaces::Voxels, "voxels"}, {GlbFaces::Meshes, "meshes"}});
}

struct GlbOptions {
    GlbFaces faces = GlbFaces::Planes;
    MeshChoice meshes = MeshChoice::Sheets;  ///< None for GlbFaces::Voxels, All for GlbFaces::Meshes
    /// The volume from which the written volume was extracted, on the same grid. Its planes are used, because the
    /// result of an extraction, such as a thin hull, has few planes of its own. Null: the planes of the volume itself.
    const volume::SemanticVolume* planesOf = nullptr;
    std::uint64_t maxTriangles = std::uint64_t{1} << 27;  ///< upper limit; more give GridTooLarge
    int threads = 0;                                      ///< maximum; 0: all cores. The bytes do not depend on it.
    const Progress* progress = nullptr;                   ///< stages "surface", "triangles", "vertices", "write"
};

/// Statistics of the written file.
struct GlbReport {
    std::uint64_t bytes = 0;
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    std::size_t meshes = 0;  ///< labels with voxels
};

/// Writes the surfaces of all labels with voxels as one .glb, all or nothing. Voxel faces are merged into rectangles,
/// closed per label (see labelSurfaces). Then the vertices on slopes are moved by up to one voxel. The labels of
/// GlbOptions::meshes are written as the triangles of the model, if the volume keeps these (see drawnTriangles); sheets
/// have two sides. `planesOf` excludes triangles of the model. Equal volumes give equal bytes. Cost and memory: those of labelSurfaces; the file itself is not kept in memory.
/// \return statistics, or
///         - CannotWrite, DiskFull, Cancelled
///         - NothingSelected  no label has voxels.
///         - GridTooLarge     there are too many triangles, or the file would reach the .glb limit of 4 GiB.
///         - BadArgument      grid, columns or `planesOf` differ in dimension.
[[nodiscard]] Result<GlbReport> writeGlb(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                         const GlbOptions& options = {});

}  // namespace svt::writers
