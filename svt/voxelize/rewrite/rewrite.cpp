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

// Appends the runs of a column with the edits of its voxels, bottom up.
void editRuns(std::span<const Run> runs, std::span<const VoxelEdit> edits, std::vector<Run>& out) {
    auto edit = edits.begin();
    for (const Run& run : runs) {
        for (; edit != edits.end() && static_cast<std::uint32_t>(edit->voxel.z) < run.end; ++edit) {
            const auto k = static_cast<std::uint32_t>(edit->voxel.z);
            const std::uint32_t begin = out.empty() ? 0 : out.back().end;
            if (k > begin) out.push_back({k, run.scalar});
            if (k >= begin) out.push_back({k + 1, edit->scalar});
        }
        if (out.empty() || out.back().end < run.end) out.push_back(run);
    }
    joinEqualRuns(out);
}

// A tile with edits by row, column and height. Columns without edits are looked up once each.
ColumnTileData editTile(const ColumnTile& tile, std::int32_t width, std::span<const VoxelEdit> edits) {
    if (edits.empty()) return copyTile(tile);
    constexpr std::uint32_t kUnknown = 0xFFFFFFFFu;
    volume::ColumnTileBuilder builder(width);
    std::vector<std::uint32_t> numbers(tile.columnStart.size(), kUnknown);
    std::vector<std::uint16_t> row(static_cast<std::size_t>(width));
    std::vector<Run> runs;
    auto edit = edits.begin();
    for (std::size_t y = 0; y < tile.rowOf.size(); ++y) {
        for (std::size_t x = 0; x < row.size(); ++x) {
            const std::uint16_t old = tile.rowColumns[std::size_t(tile.rowOf[y]) * row.size() + x];
            const auto first = edit;
            const auto isHere = [&](const VoxelEdit& e) {
                return std::size_t(e.voxel.y) % ColumnVolume::kTileSize == y &&
                       std::size_t(e.voxel.x) % ColumnVolume::kTileSize == x;
            };
            while (edit != edits.end() && isHere(*edit)) ++edit;
            if (first != edit) {
                runs.clear();
                editRuns(tile.column(old), std::span(&*first, static_cast<std::size_t>(edit - first)), runs);
                row[x] = builder.addColumn(runs);
                continue;
            }
            if (numbers[old] == kUnknown) numbers[old] = builder.addColumn(tile.column(old));
            row[x] = static_cast<std::uint16_t>(numbers[old]);
        }
        builder.addRow(row);
    }
    return builder.finish();
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
    const auto tileOf = [&](const VoxelEdit& edit) {
        return std::size_t(edit.voxel.x / ColumnVolume::kTileSize) +
               std::size_t(columns.tilesX()) * std::size_t(edit.voxel.y / ColumnVolume::kTileSize);
    };
    const auto place = [&](const VoxelEdit& edit) {
        return std::tuple(tileOf(edit), edit.voxel.y, edit.voxel.x, edit.voxel.z);
    };
    std::stable_sort(edits.begin(), edits.end(),
                     [&](const VoxelEdit& p, const VoxelEdit& q) { return place(p) < place(q); });
    std::vector<ColumnTileData> tiles(columns.tiles().size());
    parallelFor(tiles.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            const auto first = std::lower_bound(edits.begin(), edits.end(), t,
                                                [&](const VoxelEdit& edit, std::size_t n) { return tileOf(edit) < n; });
            const auto last = std::upper_bound(first, edits.end(), t,
                                               [&](std::size_t n, const VoxelEdit& edit) { return n < tileOf(edit); });
            const auto width = columns.tileWidth(static_cast<std::int32_t>(t % std::size_t(columns.tilesX())));
            tiles[t] =
                editTile(columns.tiles()[t], width,
                         std::span(edits).subspan(std::size_t(first - edits.begin()), std::size_t(last - first)));
        }
    });
    return ColumnVolume::fromTiles(d, std::move(tiles));
}

}  // namespace svt::voxelize
