#include <svt/core/hash.hpp>
#include <svt/core/parallel.hpp>
#include <svt/volume/lod_pyramid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace svt::volume {
namespace {

constexpr int kCoarsest = 6;  // a cell of 64 x 64 columns is one tile of the fine volume

struct MixtureHash {
    std::size_t operator()(const Mixture& mixture) const noexcept {
        std::uint64_t hash = mixture.partCount;
        for (const MixturePart& part : mixture.labels()) {
            hash = mixHash(hash, std::uint64_t{part.scalar} << 8 | part.coverage);
            hash ^= hash >> 31;
        }
        return static_cast<std::size_t>(hash);
    }
};

struct KeyHash {
    std::size_t operator()(const std::vector<std::uint32_t>& key) const noexcept {
        std::uint64_t hash = key.size();
        for (const std::uint32_t word : key) {
            hash = mixHash(hash, word);
            hash ^= hash >> 31;
        }
        return static_cast<std::size_t>(hash);
    }
};

// Numbers mixtures by first use.
class MixtureTable {
public:
    Scalar number(const Mixture& mixture) {
        const auto [place, isNew] = numbers_.try_emplace(mixture, static_cast<Scalar>(mixtures_.size()));
        if (isNew) mixtures_.push_back(mixture);
        return place->second;
    }
    [[nodiscard]] std::vector<Mixture>& mixtures() noexcept { return mixtures_; }

private:
    std::unordered_map<Mixture, Scalar, MixtureHash> numbers_;
    std::vector<Mixture> mixtures_;
};

// A distinct fine column in the block of a coarse column.
struct BlockColumn {
    std::uint32_t number = 0;  // number of the column in its tile
    std::uint32_t count = 0;   // how often it occurs in the block
    const Run* run = nullptr;
};

// Makes coarse columns of mixture numbers from the runs of the fine columns of each block. A block lies in one fine
// tile. Blocks with the same columns are mixed once.
class ColumnMixer {
public:
    ColumnMixer(const ColumnVolume& fine, int level, MixtureTable& table)
        : fine_(fine), size_(std::int32_t{1} << level), table_(table) {}

    /// Runs of mixture numbers of coarse column (i, j).
    std::span<const Run> mix(std::int32_t i, std::int32_t j) {
        const std::int32_t tileX = i * size_ / ColumnVolume::kTileSize, tileY = j * size_ / ColumnVolume::kTileSize;
        gather(tileX, tileY, i * size_ % ColumnVolume::kTileSize, j * size_ % ColumnVolume::kTileSize);
        key_.assign({static_cast<std::uint32_t>(tileX), static_cast<std::uint32_t>(tileY)});
        for (const BlockColumn& column : columns_) {
            key_.push_back(column.number);
            key_.push_back(column.count);
        }
        const auto known = known_.find(key_);
        if (known != known_.end()) return known->second;
        return known_.emplace(key_, mixGathered()).first->second;
    }

private:
    // Counts the distinct columns of the block that begins at (x, y) in the tile; equal consecutive rows at once.
    void gather(std::int32_t tileX, std::int32_t tileY, std::int32_t x, std::int32_t y) {
        const ColumnTile& tile = fine_.tiles()[static_cast<std::size_t>(tileX + fine_.tilesX() * tileY)];
        const std::int32_t width = fine_.tileWidth(tileX);
        const std::int32_t endX = std::min(x + size_, width), endY = std::min(y + size_, fine_.tileHeight(tileY));
        columns_.clear();
        if (placeOf_.size() < tile.columnStart.size()) placeOf_.resize(tile.columnStart.size(), 0);
        for (std::int32_t row = y; row < endY;) {
            const std::uint8_t rowNumber = tile.rowOf[static_cast<std::size_t>(row)];
            std::uint32_t rows = 0;
            for (; row < endY && tile.rowOf[static_cast<std::size_t>(row)] == rowNumber; ++row) ++rows;
            const std::uint16_t* numbers =
                tile.rowColumns.data() + static_cast<std::size_t>(rowNumber) * static_cast<std::size_t>(width);
            for (std::int32_t column = x; column < endX; ++column) {
                std::uint32_t& place = placeOf_[numbers[column]];
                if (place == 0) {
                    columns_.push_back({numbers[column], 0, nullptr});
                    place = static_cast<std::uint32_t>(columns_.size());
                }
                columns_[place - 1].count += rows;
            }
        }
        for (const BlockColumn& column : columns_) placeOf_[column.number] = 0;
        std::sort(columns_.begin(), columns_.end(),
                  [](const BlockColumn& a, const BlockColumn& b) { return a.number < b.number; });
        for (BlockColumn& column : columns_) column.run = tile.column(column.number).data();
    }

    std::vector<Run> mixGathered() {
        const auto nz = static_cast<std::uint32_t>(fine_.dimension().z);
        const auto size = static_cast<std::uint32_t>(size_);
        const std::uint32_t cells = (nz + size - 1) / size;
        std::vector<Run> runs;
        std::uint32_t cell = 0;
        while (cell < cells) {
            // No run ends inside [bottom, same), so all whole cells in this range are equal.
            const std::uint32_t bottom = cell * size;
            std::uint32_t same = nz;
            for (BlockColumn& column : columns_) {
                while (column.run->end <= bottom) ++column.run;
                same = std::min(same, column.run->end);
            }
            const std::uint32_t next = same == nz ? cells : std::max(same / size, cell + 1);
            const Scalar mixture = mixCell(bottom, std::min(bottom + size, nz));
            if (!runs.empty() && runs.back().scalar == mixture)
                runs.back().end = next;
            else
                runs.push_back({next, mixture});
            cell = next;
        }
        return runs;
    }

    Scalar mixCell(std::uint32_t bottom, std::uint32_t top) {
        counts_.clear();
        std::uint64_t total = 0;
        for (const BlockColumn& column : columns_) {
            std::uint32_t from = bottom;
            for (const Run* run = column.run; from < top; ++run) {
                const std::uint32_t to = std::min(run->end, top);
                add(run->scalar, std::uint64_t{to - from} * column.count);
                from = to;
            }
            total += std::uint64_t{top - bottom} * column.count;
        }
        return table_.number(makeMixture(counts_, total));
    }

    void add(Scalar scalar, std::uint64_t count) {
        for (auto& [known, sum] : counts_)
            if (known == scalar) {
                sum += count;
                return;
            }
        counts_.emplace_back(scalar, count);
    }

    const ColumnVolume& fine_;
    std::int32_t size_;  // samples per cell along an axis
    MixtureTable& table_;
    std::vector<BlockColumn> columns_;
    std::vector<std::uint32_t> placeOf_;  // by column number: 1 + index in columns_, 0 = absent
    std::vector<std::uint32_t> key_;
    std::unordered_map<std::vector<std::uint32_t>, std::vector<Run>, KeyHash> known_;
    std::vector<std::pair<Scalar, std::uint64_t>> counts_;
};

struct LevelTile {
    MixtureTable table;
    ColumnTileData data;
};

void makeTile(const ColumnVolume& fine, int level, Vec3i dimension, std::int32_t tileX, std::int32_t tileY,
              LevelTile& tile) {
    const std::int32_t beginX = tileX * ColumnVolume::kTileSize, beginY = tileY * ColumnVolume::kTileSize;
    const std::int32_t width = std::min(ColumnVolume::kTileSize, dimension.x - beginX);
    const std::int32_t height = std::min(ColumnVolume::kTileSize, dimension.y - beginY);
    ColumnMixer mixer(fine, level, tile.table);
    ColumnTileBuilder builder(width);
    std::vector<std::uint16_t> row(static_cast<std::size_t>(width));
    for (std::int32_t j = 0; j < height; ++j) {
        for (std::int32_t i = 0; i < width; ++i)
            row[static_cast<std::size_t>(i)] = builder.addColumn(mixer.mix(beginX + i, beginY + j));
        builder.addRow(row);
    }
    tile.data = builder.finish();
}

Result<LodLevel> makeLevel(const ColumnVolume& fine, const Grid& grid, int level, Vec3i dimension, int threads) {
    LodLevel result;
    result.level = level;
    const double size = static_cast<double>(1 << level);
    const Vec3d center{(size - 1) / 2, (size - 1) / 2, (size - 1) / 2};
    SVT_TRY(coarse, Grid::fromParts(dimension, grid.spacing() * size, grid.worldFromIndex(center), grid.axes()));
    result.grid = *coarse;

    const std::int32_t tilesX = (dimension.x + ColumnVolume::kTileSize - 1) / ColumnVolume::kTileSize;
    const std::int32_t tilesY = (dimension.y + ColumnVolume::kTileSize - 1) / ColumnVolume::kTileSize;
    std::vector<LevelTile> tiles(static_cast<std::size_t>(tilesX) * static_cast<std::size_t>(tilesY));
    parallelFor(tiles.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n)
            makeTile(fine, level, dimension, static_cast<std::int32_t>(n % static_cast<std::size_t>(tilesX)),
                     static_cast<std::int32_t>(n / static_cast<std::size_t>(tilesX)), tiles[n]);
    });

    // Renumber the mixtures of the tiles to those of the level, in tile order.
    MixtureTable table;
    (void)table.number(Mixture{});
    std::vector<ColumnTileData> data;
    data.reserve(tiles.size());
    for (LevelTile& tile : tiles) {
        std::vector<Scalar> numbers;
        for (const Mixture& mixture : tile.table.mixtures()) numbers.push_back(table.number(mixture));
        for (Run& run : tile.data.runs) run.scalar = numbers[run.scalar];
        data.push_back(std::move(tile.data));
    }
    result.mixtures = std::move(table.mixtures());
    result.columns = ColumnVolume::fromTiles(dimension, std::move(data));
    SVT_TRY(bricks, BrickVolume::fromColumns(result.columns, {.faces = BrickFaces::Voxels, .threads = threads}));
    result.bricks = std::move(*bricks);
    return result;
}

}  // namespace

int Mixture::coverage() const noexcept {
    int sum = 0;
    for (const MixturePart& part : labels()) sum += part.coverage;
    return sum;
}

Mixture makeMixture(std::span<const std::pair<Scalar, std::uint64_t>> counts, std::uint64_t total) {
    std::vector<std::pair<Scalar, std::uint64_t>> labels;
    std::uint64_t filled = 0;
    for (const auto& [scalar, count] : counts) {
        if (scalar == 0) continue;
        labels.emplace_back(scalar, count);
        filled += count;
    }
    Mixture mixture;
    if (labels.empty()) return mixture;
    std::sort(labels.begin(), labels.end(), [](const auto& a, const auto& b) {
        return a.second != b.second ? a.second > b.second : a.first < b.first;
    });
    labels.resize(std::min(labels.size(), Mixture::kMaxParts));
    mixture.partCount = static_cast<std::uint8_t>(labels.size());
    std::uint64_t kept = 0;
    for (const auto& label : labels) kept += label.second;

    // The coverages add up to `sum` exactly, each at least 1: whole shares first, the rest by largest remainder.
    std::uint64_t sum = std::max<std::uint64_t>((filled * 510 + total) / (2 * total), labels.size());
    if (filled < total) sum = std::min<std::uint64_t>(sum, 254);  // background that is present keeps a share, too
    sum -= labels.size();
    std::uint64_t given = 0;
    std::array<std::pair<std::uint64_t, std::size_t>, Mixture::kMaxParts> remainders{};
    for (std::size_t n = 0; n < labels.size(); ++n) {
        const std::uint64_t share = sum * labels[n].second;
        mixture.parts[n] = {labels[n].first, static_cast<std::uint8_t>(1 + share / kept)};
        given += share / kept;
        remainders[n] = {share % kept, n};
    }
    std::stable_sort(remainders.begin(), remainders.begin() + mixture.partCount,
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (std::size_t n = 0; given < sum; ++n, ++given) ++mixture.parts[remainders[n].second].coverage;
    return mixture;
}

int lodLevelCount(Vec3i dimension) noexcept {
    int count = 0;
    for (; count < kCoarsest; ++count) {
        for (int axis = 0; axis < 3; ++axis) dimension[axis] = (dimension[axis] + 1) / 2;
        if (std::min({dimension.x, dimension.y, dimension.z}) < 2) break;
    }
    return count;
}

Result<LodLevel> buildLodLevel(const ColumnVolume& columns, const Grid& grid, int level, int threads) {
    Vec3i dimension = columns.dimension();
    if (level < 1 || level > lodLevelCount(dimension))
        return Error(Code::BadArgument,
                     fmt::format("level {} is out of range; there are {}", level, lodLevelCount(dimension)));
    if (grid.dimension() != dimension)
        return Error(Code::BadArgument, "the grid and the volume have different dimensions");
    for (int axis = 0; axis < 3; ++axis)
        for (int n = 0; n < level; ++n) dimension[axis] = (dimension[axis] + 1) / 2;
    return makeLevel(columns, grid, level, dimension, threads);
}

Result<std::vector<LodLevel>> buildLodPyramid(const ColumnVolume& columns, const Grid& grid, int coarsest, int threads,
                                              const Progress* progress) {
    if (coarsest < 1 || coarsest > kCoarsest)
        return Error(Code::BadArgument,
                     fmt::format("level {} is out of range; 1 to {} are possible", coarsest, kCoarsest));
    if (grid.dimension() != columns.dimension())
        return Error(Code::BadArgument, "the grid and the volume have different dimensions");
    std::vector<LodLevel> levels;
    for (int level = 1; level <= std::min(coarsest, lodLevelCount(columns.dimension())); ++level) {
        Progress::tell(progress, "prepare", double(level - 1) / coarsest);
        SVT_TRY(made, buildLodLevel(columns, grid, level, threads));
        levels.push_back(std::move(*made));
    }
    return levels;
}

}  // namespace svt::volume
