#pragma once
/// \file
/// Meshes to the canonical label volume. Never dense on the way: every column is made as runs, equal columns and
/// rows are shared as they come.
///
/// Exactness. In index space vertices are snapped to even multiples of 1/512 voxel and samples stand 1/512 voxel off
/// them along each axis, so no vertex and no axis-parallel edge or face ever meets a sample. What remains is decided in
/// 64-bit integers with half-open rules, and heights come from planes that all objects share:
/// a voxel is inside exactly when its centre is, save for centres within 1/256 voxel of a face, and solids that share
/// a face never both claim a voxel there and never leave one between them.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/mesh/mesh_scene.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/volume/grid.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace svt::voxelize {

/// What the voxelizer must know of an object beside its mesh.
struct ObjectClaim {
    volume::Scalar scalar = 0;  ///< written to its voxels, > 0
    std::uint8_t rank = 0;  ///< who wins where objects overlap: the lower rank, then the smaller volume, then the id
    std::string id;         ///< last tie-break
};

enum class SheetMode : std::uint8_t {
    Thin,         ///< 6-separating: of two neighbouring samples with the sheet between them, the one behind it
    Conservative  ///< every voxel whose box the sheet touches (separating axis test, Akenine-Moeller 2001)
};

struct VoxelizeOptions {
    SheetMode sheets = SheetMode::Thin;  ///< for objects that are no solids
    bool keepThinParts = true;           ///< solids' parts thinner than a voxel get a 6-separating pass
    int threads = 0;                     ///< 0: all cores; the result does not depend on it
    const Progress* progress = nullptr;
};

/// Voxels that two solids both claim. `a` has the priority.
struct ClaimPair {
    std::uint32_t a = 0, b = 0;  ///< object indices
    std::uint64_t voxels = 0;
    friend bool operator==(const ClaimPair&, const ClaimPair&) = default;
};

struct VoxelizeResult {
    volume::ColumnVolume columns;
    std::vector<std::uint64_t>
        thinVoxels;  ///< per object: voxels claimed by the pass for thin parts alone, before priority
    std::vector<std::uint64_t> uncertainVoxels;  ///< per object: decided by a winding number between 0.25 and 0.75
    std::vector<ClaimPair> overlaps;             ///< ordered by (a, b); between solids only
};

/// Voxelizes all objects of `scene` into one volume.
///
/// Solids by signed crossings along z (inside = winding number > 0), open shells with solid meaning by the generalized
/// winding number (Jacobson 2013, evaluated after Martens & Bessmeltsev 2025), other surfaces as sheets. Every object
/// with geometry gets at least one voxel.
///
/// \param claims  one per scene.objects, same order
/// \param grid    its world box need not hold all objects; what is outside is cut away
/// \return the volume, or GridTooLarge, or Cancelled
/// Cost: O(triangles * rows they cover + distinct columns); open shells O(columns * open edges). Memory: the result
/// and per thread one tile of 64 x 64 columns.
[[nodiscard]] Result<VoxelizeResult> voxelize(const mesh::MeshScene& scene, const volume::Grid& grid,
                                              std::span<const ObjectClaim> claims, const VoxelizeOptions& options = {});

}  // namespace svt::voxelize
