#pragma once
/// \file
/// The labels of a volume as triangles in one binary glTF 2.0 file (.glb), which Blender, Windows, three.js, Cesium and
/// most other 3D programs open.
///
///     header       12 bytes: "glTF", 2, length of the file
///     JSON chunk   scene: a root node, below it the labels as a tree, each with mesh and material of its own
///     BIN chunk    positions of all labels, then their indices; see bufferViews
///
/// Space: metres. A mesh holds places along the grid's axes from the grid's lower corner, the outer corner of sample
/// (0, 0, 0): x, y, z. The root node's matrix turns them into the world's directions with y up, as glTF wants it:
/// east is +x, height +y, north -z. So the lower corner lies at the origin and numbers stay small;
/// `asset.extras.origin` has its world coordinates, `asset.extras.crs` their CRS.
///
/// A label: `name` of its node is the label's name or id, `extras` has its `id` and `class`. The material has the
/// label's colour (linear, as glTF wants it); its opacity is the share of light that one metre of the label stops,
/// since a surface has no depth. No normals: glTF then asks for flat faces.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

/// Where the corners of surfaces are.
enum class GlbFaces : std::uint8_t {
    Planes,  ///< on the oblique planes that the voxels came from, where these are known; see SlopeVertices
    Voxels   ///< where the voxels' are: slopes are stairs
};

struct GlbOptions {
    GlbFaces faces = GlbFaces::Planes;
    /// The volume that the one to write was cut out of, such as that of a shell, on the same grid: its planes count,
    /// since a thin hull has few of its own. Null: those of the volume itself.
    const volume::SemanticVolume* planesOf = nullptr;
    std::uint64_t maxTriangles = std::uint64_t{1} << 27;  ///< a larger surface is refused
    int threads = 0;                     ///< at most this many; 0: all cores. The bytes do not depend on it.
    const Progress* progress = nullptr;  ///< stage "surface"
};

/// What was written.
struct GlbReport {
    std::uint64_t bytes = 0;
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    std::size_t meshes = 0;  ///< labels with voxels
};

/// Writes the surfaces of all labels with voxels (see labelSurfaces: voxel faces merged into rectangles, closed per
/// label; then the corners on slopes are moved by at most a voxel) as one .glb, all or nothing. Equal volumes give
/// equal bytes. Cost and memory: those of labelSurfaces; the file itself is not held. \return figures, or CannotWrite,
/// DiskFull, Cancelled; NothingSelected where no label has voxels; GridTooLarge where
///         there are too many triangles or the file would reach 4 GiB, which a .glb cannot; BadArgument where grid,
///         columns or `planesOf` differ in dimension
[[nodiscard]] Result<GlbReport> writeGlb(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                         const GlbOptions& options = {});

}  // namespace svt::writers
