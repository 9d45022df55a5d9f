#pragma once
/// \file
/// New columns from old ones, tile by tile: how patterns, thematic bodies and single voxels are put into
/// a finished volume without making it dense.

#include <svt/volume/column_volume.hpp>

#include <functional>
#include <span>
#include <vector>

namespace svt::voxelize {

/// Appends the new runs of column (i, j) to `out` (ends ascending, the last at nz; neighbours may have equal scalars,
/// they are joined).
using ColumnRewriter = std::function<void(std::int32_t i, std::int32_t j, std::span<const volume::Run> runs,
                                          std::vector<volume::Run>& out)>;

/// A rewriter for one tile, made anew for each so that it can keep what it knows of the tile; empty: the tile stays as
/// it is.
using TileRewriterFactory =
    std::function<ColumnRewriter(std::int32_t tileX, std::int32_t tileY, const volume::ColumnTile& tile)>;

/// Rewrites all columns of the tiles for which `makeRewriter` gives a rewriter; called from several threads.
/// The result is in canonical form.
[[nodiscard]] volume::ColumnVolume rewriteColumns(const volume::ColumnVolume& columns,
                                                  const TileRewriterFactory& makeRewriter, int threads);

struct VoxelEdit {
    Vec3i voxel;
    volume::Scalar scalar = 0;
};

/// Sets single voxels; of several edits of one voxel the first counts, edits outside the volume do nothing.
[[nodiscard]] volume::ColumnVolume editVoxels(const volume::ColumnVolume& columns, std::vector<VoxelEdit> edits,
                                              int threads);

}  // namespace svt::voxelize
