#include <svt/voxelize/rewrite/rewrite.hpp>

#include <svt/core/parallel.hpp>

#include <algorithm>
#include <tuple>

namespace svt::voxelize {
namespace {

using volume::ColumnTile;
using volume::ColumnTileData;
using volume::ColumnVolume;
using volume::Run;

ColumnTileData copyTile(const ColumnTile& tile) {
    return {{tile.rowOf.begin(), tile.rowOf.end()},
            {tile.rowColumns.begin(), tile.rowColumns.end()},
            {tile.columnStart.begin(), tile.columnStart.end()},
            {tile.runs.begin(), tile.runs.end()}};
}

void joinEqualRuns(std::vector<Run>& runs) {
    std::size_t kept = 0;
    for (std::size_t r = 1; r < runs.size(); ++r) {
        if (runs[kept].scalar == runs[r].scalar)
            runs[kept].end = runs[r].end;
        else
            runs[++kept] = runs[r];
    }
    runs.resize(kept + 1);
}

}  // namespace

ColumnVolume rewriteColumns(const ColumnVolume& columns, const TileRewriterFactory& makeRewriter, int threads) {
    std::vector<ColumnTileData> tiles(columns.tiles().size());
    parallelFor(tiles.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        std::vector<Run> runs;
        std::vector<std::uint16_t> row;
        for (std::size_t t = begin; t < end; ++t) {
            const auto tileX = static_cast<std::int32_t>(t % std::size_t(columns.tilesX()));
            const auto tileY = static_cast<std::int32_t>(t / std::size_t(columns.tilesX()));
            const ColumnTile& tile = columns.tiles()[t];
            const ColumnRewriter rewrite = makeRewriter(tileX, tileY, tile);
            if (!rewrite) {
                tiles[t] = copyTile(tile);
                continue;
            }
            const std::int32_t width = columns.tileWidth(tileX);
            volume::ColumnTileBuilder builder(width);
            row.resize(std::size_t(width));
            for (std::int32_t y = 0; y < columns.tileHeight(tileY); ++y) {
                for (std::int32_t x = 0; x < width; ++x) {
                    runs.clear();
                    const std::size_t entry =
                        std::size_t(tile.rowOf[std::size_t(y)]) * std::size_t(width) + std::size_t(x);
                    rewrite(tileX * ColumnVolume::kTileSize + x, tileY * ColumnVolume::kTileSize + y,
                            tile.column(tile.rowColumns[entry]), runs);
                    joinEqualRuns(runs);
                    row[std::size_t(x)] = builder.addColumn(runs);
                }
                builder.addRow(row);
            }
            tiles[t] = builder.finish();
        }
    });
    return ColumnVolume::fromTiles(columns.dimension(), std::move(tiles));
}

ColumnVolume editVoxels(const ColumnVolume& columns, std::vector<VoxelEdit> edits, int threads) {
    const Vec3i d = columns.dimension();
    std::erase_if(edits, [d](const VoxelEdit& edit) {
        const Vec3i v = edit.voxel;
        return v.x < 0 || v.y < 0 || v.z < 0 || v.x >= d.x || v.y >= d.y || v.z >= d.z;
    });
    const auto place = [](const Vec3i& v) { return std::tuple(v.y, v.x, v.z); };
    std::stable_sort(edits.begin(), edits.end(),
                     [&](const VoxelEdit& p, const VoxelEdit& q) { return place(p.voxel) < place(q.voxel); });
    return rewriteColumns(
        columns,
        [&](std::int32_t tileX, std::int32_t tileY, const ColumnTile&) -> ColumnRewriter {
            const bool isTouched = std::any_of(edits.begin(), edits.end(), [&](const VoxelEdit& edit) {
                return edit.voxel.x / ColumnVolume::kTileSize == tileX &&
                       edit.voxel.y / ColumnVolume::kTileSize == tileY;
            });
            if (!isTouched) return {};
            return [&edits](std::int32_t i, std::int32_t j, std::span<const Run> runs, std::vector<Run>& out) {
                auto edit = std::lower_bound(
                    edits.begin(), edits.end(), std::tuple(j, i),
                    [](const VoxelEdit& e, const auto& at) { return std::tuple(e.voxel.y, e.voxel.x) < at; });
                for (const Run& run : runs) {
                    for (; edit != edits.end() && edit->voxel.y == j && edit->voxel.x == i &&
                           static_cast<std::uint32_t>(edit->voxel.z) < run.end;
                         ++edit) {
                        const auto k = static_cast<std::uint32_t>(edit->voxel.z);
                        const std::uint32_t begin = out.empty() ? 0 : out.back().end;
                        if (k > begin) out.push_back({k, run.scalar});
                        if (k >= begin) out.push_back({k + 1, edit->scalar});
                    }
                    if (out.empty() || out.back().end < run.end) out.push_back(run);
                }
            };
        },
        threads);
}

}  // namespace svt::voxelize
