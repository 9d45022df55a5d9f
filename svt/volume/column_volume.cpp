#include <svt/volume/column_volume.hpp>

#include <svt/core/check.hpp>

#include <algorithm>
#include <cstring>

namespace svt::volume {
namespace {

// Multilinear hash (Lemire & Kaser 2014): a sum of words times odd factors, fast because no product depends on the one
// before. Only its upper half is well mixed; sufficient for tables that compare the items afterwards.
struct WordHash {
    std::uint64_t sum, factor = 0x9E3779B97F4A7C15ull;
    void add(std::uint64_t word) noexcept {
        sum += (word + (factor >> 7)) * factor;
        factor += 0xBF58476D1CE4E5BAull;
    }
    [[nodiscard]] std::uint64_t value() const noexcept { return sum ^ sum >> 29; }
};

std::uint64_t hashRuns(std::span<const Run> runs) noexcept {
    WordHash hash{runs.size()};
    for (const Run& run : runs) hash.add(std::uint64_t(run.scalar) << 32 | run.end);
    return hash.value();
}

std::uint64_t hashRow(std::span<const std::uint16_t> columns) noexcept {
    WordHash hash{columns.size()};
    std::size_t i = 0;
    for (; i + 4 <= columns.size(); i += 4) {
        std::uint64_t word;
        std::memcpy(&word, columns.data() + i, sizeof word);
        hash.add(word);
    }
    for (; i < columns.size(); ++i) hash.add(columns[i]);
    return hash.value();
}

// Branch-free per run: candidates from a hash table are nearly always equal.
bool isEqualColumn(std::span<const Run> a, std::span<const Run> b) noexcept {
    if (a.size() != b.size()) return false;
    std::uint32_t differences = 0;
    for (std::size_t r = 0; r < a.size(); ++r) differences |= (a[r].end ^ b[r].end) | (a[r].scalar ^ b[r].scalar);
    return differences == 0;
}

template <class T>
bool isEqual(std::span<const T> a, std::span<const T> b) noexcept {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

// Replaces `runs` by those of the column whose lowest sample is scalars[base]; `layer` samples lie in each layer.
void findRuns(std::span<const Scalar> scalars, std::size_t base, std::size_t layer, std::int32_t height,
              std::vector<Run>& runs) {
    runs.clear();
    for (std::int32_t k = 0; k < height; ++k) {
        const Scalar scalar = scalars[base + layer * std::size_t(k)];
        if (runs.empty() || runs.back().scalar != scalar) runs.push_back({0, scalar});
        runs.back().end = static_cast<std::uint32_t>(k + 1);
    }
}

}  // namespace

ColumnVolume ColumnVolume::fromTiles(Vec3i dimension, std::vector<ColumnTileData> tiles) {
    ColumnVolume volume;
    volume.dimension_ = dimension;
    SVT_CHECK(tiles.size() == std::size_t(volume.tilesX()) * std::size_t(volume.tilesY()));
    auto storage = std::make_shared<std::vector<ColumnTileData>>(std::move(tiles));
    volume.tiles_.reserve(storage->size());
    for (const ColumnTileData& tile : *storage) volume.tiles_.push_back(tile.view());
    volume.storage_ = std::move(storage);
    return volume;
}

ColumnVolume ColumnVolume::fromDense(Vec3i dimension, std::span<const Scalar> scalars) {
    ColumnVolume shape;
    shape.dimension_ = dimension;
    std::vector<ColumnTileData> tiles;
    std::vector<Run> runs;
    const std::size_t nx = std::size_t(dimension.x), ny = std::size_t(dimension.y);
    for (std::int32_t tileY = 0; tileY < shape.tilesY(); ++tileY) {
        for (std::int32_t tileX = 0; tileX < shape.tilesX(); ++tileX) {
            const std::int32_t width = shape.tileWidth(tileX);
            ColumnTileBuilder builder(width);
            std::vector<std::uint16_t> row(static_cast<std::size_t>(width));
            for (std::int32_t y = 0; y < shape.tileHeight(tileY); ++y) {
                for (std::int32_t x = 0; x < width; ++x) {
                    const std::size_t base =
                        std::size_t(tileX * kTileSize + x) + nx * std::size_t(tileY * kTileSize + y);
                    findRuns(scalars, base, nx * ny, dimension.z, runs);
                    row[std::size_t(x)] = builder.addColumn(runs);
                }
                builder.addRow(row);
            }
            tiles.push_back(builder.finish());
        }
    }
    return fromTiles(dimension, std::move(tiles));
}

std::int32_t ColumnVolume::tileWidth(std::int32_t tileX) const noexcept {
    return std::min(kTileSize, dimension_.x - tileX * kTileSize);
}

std::int32_t ColumnVolume::tileHeight(std::int32_t tileY) const noexcept {
    return std::min(kTileSize, dimension_.y - tileY * kTileSize);
}

std::span<const Run> ColumnVolume::column(std::int32_t i, std::int32_t j) const noexcept {
    const std::int32_t tileX = i / kTileSize;
    const ColumnTile& tile = tiles_[std::size_t(tileX) + std::size_t(tilesX()) * std::size_t(j / kTileSize)];
    const std::size_t row = tile.rowOf[std::size_t(j % kTileSize)];
    return tile.column(tile.rowColumns[row * std::size_t(tileWidth(tileX)) + std::size_t(i % kTileSize)]);
}

Scalar ColumnVolume::scalarAt(std::int32_t i, std::int32_t j, std::int32_t k) const noexcept {
    const auto runs = column(i, j);
    const auto found = std::upper_bound(runs.begin(), runs.end(), static_cast<std::uint32_t>(k),
                                        [](std::uint32_t at, const Run& run) { return at < run.end; });
    return found->scalar;
}

std::vector<std::uint64_t> ColumnVolume::countVoxels(Scalar scalarCount) const {
    std::vector<std::uint64_t> counts(scalarCount, 0);
    std::vector<std::uint64_t> uses;
    std::vector<std::uint64_t> rowUses;
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
        const ColumnTile& tile = tiles_[t];
        const auto width = static_cast<std::size_t>(tileWidth(static_cast<std::int32_t>(t % std::size_t(tilesX()))));
        rowUses.assign(tile.rowColumns.size() / width, 0);
        for (const std::uint8_t row : tile.rowOf) ++rowUses[row];
        uses.assign(tile.columnStart.size() - 1, 0);
        for (std::size_t e = 0; e < tile.rowColumns.size(); ++e) uses[tile.rowColumns[e]] += rowUses[e / width];
        for (std::size_t c = 0; c < uses.size(); ++c) {
            std::uint32_t begin = 0;
            for (const Run& run : tile.column(static_cast<std::uint32_t>(c))) {
                if (run.scalar < scalarCount) counts[run.scalar] += uses[c] * (run.end - begin);
                begin = run.end;
            }
        }
    }
    return counts;
}

std::size_t ColumnVolume::sizeBytes() const noexcept {
    std::size_t bytes = tiles_.size() * sizeof(ColumnTile);
    for (const ColumnTile& tile : tiles_)
        bytes += tile.rowOf.size_bytes() + tile.rowColumns.size_bytes() + tile.columnStart.size_bytes() +
                 tile.runs.size_bytes();
    return bytes;
}

bool operator==(const ColumnVolume& a, const ColumnVolume& b) noexcept {
    if (a.dimension_ != b.dimension_) return false;
    for (std::size_t t = 0; t < a.tiles_.size(); ++t) {
        const ColumnTile& s = a.tiles_[t];
        const ColumnTile& u = b.tiles_[t];
        if (!isEqual(s.rowOf, u.rowOf) || !isEqual(s.rowColumns, u.rowColumns) ||
            !isEqual(s.columnStart, u.columnStart) || !isEqual(s.runs, u.runs))
            return false;
    }
    return true;
}

void ColumnTileBuilder::start(std::int32_t width) {
    width_ = static_cast<std::size_t>(width);
    runCount_ = 0;
    columnStart_.assign(1, 0);
    rowColumns_.clear();
    rowOf_.clear();
    columnIndex_.clear();
    rowIndex_.clear();
}

std::uint16_t ColumnTileBuilder::addColumn(std::span<const Run> runs) {
    std::copy(runs.begin(), runs.end(), beginColumn(runs.size()));
    return endColumn(runs.size());
}

std::uint16_t ColumnTileBuilder::endColumn(std::size_t count) {
    const std::span<const Run> runs(runs_.data() + runCount_, count);
    return static_cast<std::uint16_t>(columnIndex_.findOrAdd(
        hashRuns(runs), [&](std::uint32_t known) { return isEqualColumn(column(known), runs); },
        [&] {
            runCount_ += count;
            columnStart_.push_back(static_cast<std::uint32_t>(runCount_));
            return static_cast<std::uint32_t>(columnStart_.size() - 2);
        }));
}

void ColumnTileBuilder::addRow(std::span<const std::uint16_t> columns) {
    rowOf_.push_back(static_cast<std::uint8_t>(rowIndex_.findOrAdd(
        hashRow(columns),
        [&](std::uint32_t known) {
            return isEqual<std::uint16_t>(std::span(rowColumns_).subspan(known * width_, width_), columns);
        },
        [&] {
            rowColumns_.insert(rowColumns_.end(), columns.begin(), columns.end());
            return static_cast<std::uint32_t>(rowColumns_.size() / width_ - 1);
        })));
}

void ColumnTileBuilder::repeatRow() { rowOf_.push_back(rowOf_.back()); }

ColumnTileData ColumnTileBuilder::finish() const {
    return {rowOf_, rowColumns_, columnStart_, {runs_.begin(), runs_.begin() + static_cast<std::ptrdiff_t>(runCount_)}};
}

}  // namespace svt::volume
