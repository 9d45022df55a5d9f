#pragma once
/// \file
/// Rewrites columns tile by tile: patterns, thematic bodies and single voxels are applied to a finished volume without
/// converting it to a dense array.

#include <svt/volume/column_volume.hpp>

#include <functional>
#include <span>
#include <vector>

namespace svt::voxelize {

/// Appends the new runs of column (i, j) to `out`: ends ascending, the last at nz. Neighbouring runs with equal scalars
/// are allowed and will be merged.
using ColumnRewriter = std::function<void(std::int32_t i, std::int32_t j, std::span<const volume::Run> runs,
                                          std::vector<volume::Run>& out)>;

/// Makes the rewriter of one tile, which can hold data about this tile. An empty function leaves the tile unchanged.
using TileRewriterFactory =
    std::function<ColumnRewriter(std::int32_t tileX, std::int32_t tileY, const volume::ColumnTile& tile)>;

/// Rewrites all columns of the tiles for which `makeRewriter` returns a rewriter. `makeRewriter` and the rewriters are
/// called from several threads. The result is in canonical form.
[[nodiscard]] volume::ColumnVolume rewriteColumns(const volume::ColumnVolume& columns,
                                                  const TileRewriterFactory& makeRewriter, int threads);

struct VoxelEdit {
    Vec3i voxel;
    volume::Scalar scalar = 0;
};

/// Sets single voxels. The first of several edits of one voxel wins; edits outside the volume are ignored.
[[nodiscard]] volume::ColumnVolume editVoxels(const volume::ColumnVolume& columns, std::vector<VoxelEdit> edits,
                                              int threads);

}  // namespace svt::voxelize
