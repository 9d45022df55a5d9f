#pragma once
/// \file
/// Voxelizes meshes into the canonical label volume. No dense array is used: every column is built as runs, and equal
/// columns and rows are shared right away.
///
/// Exactness. In index space, vertices are snapped to even multiples of 1/512 voxel, and samples are offset from them
/// by 1/512 voxel along each axis. So no vertex and no axis-parallel edge or face ever passes through a sample. All
/// other cases are decided in 64-bit integers with half-open rules, and heights come from planes shared by all objects.
/// Therefore a voxel is inside exactly when its centre is, except for centres within 1/256 voxel of a face. Solids that
/// share a face neither both claim a voxel there nor leave a gap between them.

#include <svt/core/names.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/mesh/mesh_set.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/volume/grid.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace svt::voxelize {

inline constexpr std::uint32_t kNoBody = 0xFFFFFFFFu;

/// The properties of an object that the voxelizer needs besides its mesh.
struct ObjectClaim {
    volume::Scalar scalar = 0;  ///< written to its voxels, > 0
    std::uint8_t rank = 0;      ///< where objects overlap, the lower rank wins, then the smaller volume, then the id
    std::string id;             ///< last tie-break
    /// Object index of the body that this surface bounds, such as the building of a roof. As a thin sheet, the surface
    /// gets no voxels that only separate its two sides from each other. The body already does that, and such voxels
    /// would stick out beyond the edges of its faces. The sheet follows the faces of the body that come from the
    /// polygons of the surface. Voxels on the outside of the body that no surface takes go to the nearest face.
    std::uint32_t body = kNoBody;
};

enum class SheetMode : std::uint8_t {
    Thin,         ///< 6-separating: of two neighbouring samples with the sheet between them, the one behind the sheet
    Conservative  ///< every voxel whose box the sheet touches (separating axis test, Akenine-Moeller 2001)
};
constexpr auto namesOf(SheetMode) {
    return std::to_array<Name<SheetMode>>({{SheetMode::Thin, "thin"}, {SheetMode::Conservative, "conservative"}});
}

struct VoxelizeOptions {
    SheetMode sheets = SheetMode::Thin;         ///< for objects that are not solids
    bool keepThinParts = true;                  ///< keep parts of solids thinner than a voxel by a 6-separating pass,
                                                ///< and faces of open shells that their filling leaves out
    std::uint64_t solidAngles = 1'000'000'000;  ///< an open shell that needs more, beyond 20,000 * (samples of its
                                                ///< bounding box)^(2/3), is kept as a sheet
    int threads = 0;                            ///< 0: all cores; the result does not depend on it
    const Progress* progress = nullptr;
};

/// Voxels claimed by two solids; `a` has priority.
struct ClaimPair {
    std::uint32_t a = 0, b = 0;  ///< object indices
    std::uint64_t voxels = 0;
    friend bool operator==(const ClaimPair&, const ClaimPair&) = default;
};

/// An open shell whose filling leaves out faces.
struct LostShare {
    std::uint32_t object = 0;
    double share = 0;  ///< of its surface, 0 to 1
};

struct VoxelizeResult {
    volume::ColumnVolume columns;
    std::vector<std::uint64_t>
        thinVoxels;  ///< per object: voxels claimed only by the pass for thin parts, before priority is applied
    std::vector<std::uint64_t>
        uncertainVoxels;                  ///< per object: voxels with a winding number over 0.25 from a whole number
    std::vector<std::uint32_t> unfilled;  ///< open shells with too many holes for winding numbers: kept as sheets
    std::vector<LostShare> lostFaces;  ///< open shells whose filling left out over 0.1 % of their surface; these faces
                                       ///< got a sheet of voxels, counted as thin
    std::vector<ClaimPair> overlaps;   ///< ordered by (a, b); between solids only. Where more than 16 solids claim a
                                       ///< voxel, only pairs with one of the first 16 count it
    std::uint64_t crowdedVoxels = 0;   ///< claimed by more than 16 solids
};

/// Voxelizes all objects of `meshes` into one volume.
///
/// Solids are filled by signed crossings along z (inside = winding number > 0), open shells with solid meaning by the
/// generalized winding number (Jacobson, Kavan & Sorkine 2013, see surfaces/winding.hpp), all other
/// surfaces become sheets. An object left without voxels receives one inside the grid, unless that would take another
/// object's last voxel.
///
/// \param claims  one per meshes.objects, same order
/// \param grid    need not contain all objects; parts outside are clipped
/// \return the volume, or GridTooLarge (also where sheets or the surroundings of holes need too many voxels), or
///         Cancelled
/// Cost: O(triangles * rows they cover + distinct columns); open shells in addition about O(area of their holes in
/// voxels * pieces of rim close by). Memory: the result, per thread one tile of 64 x 64 columns, and at most 30 million
/// runs of voxels next to holes.
[[nodiscard]] Result<VoxelizeResult> voxelize(const mesh::MeshSet& meshes, const volume::Grid& grid,
                                              std::span<const ObjectClaim> claims, const VoxelizeOptions& options = {});

}  // namespace svt::voxelize
