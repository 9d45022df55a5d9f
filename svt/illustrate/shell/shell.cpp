#include <svt/core/hash.hpp>
#include <svt/illustrate/shell.hpp>

#include <svt/core/parallel.hpp>
#include <svt/illustrate/shell/enclosed_air.hpp>
#include <svt/illustrate/shell/run_sets.hpp>
#include <svt/volume/dense.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

namespace svt::illustrate {
namespace {

using volume::ColumnTile;
using volume::ColumnVolume;
using volume::kNoLabel;
using volume::Run;
using volume::Scalar;

constexpr std::int32_t kTile = ColumnVolume::kTileSize;
constexpr double kDefaultReach = 2;  // voxels

// Half width of the box around a voxel, voxels; nothing if the box is wider than the grid, so that no voxel is deep
// inside.
std::optional<Vec3i> reachOf(double thickness, const volume::Grid& grid) {
    Vec3i reach;
    for (int axis = 0; axis < 3; ++axis) {
        const double steps =
            thickness == 0 ? kDefaultReach : std::max(1.0, std::ceil(thickness / grid.spacing()[axis] - 1e-6));
        if (!(2 * steps + 1 <= grid.dimension()[axis])) return std::nullopt;
        reach[axis] = static_cast<std::int32_t>(steps);
    }
    return reach;
}

// Inputs of all tiles.
struct Task {
    const ColumnVolume& columns;
    std::span<const std::uint32_t> valueOfScalar;  // 0: background, kNoGroupValue: no group, else 1 + group
    std::span<const Scalar> newScalar;             // 0: is dropped
    const EnclosedAir& air;
    std::optional<Vec3i> reach;
};

// Makes the shells of tiles; keeps its buffers between them.
class TileShell {
public:
    explicit TileShell(const Task& task)
        : task_(task),
          columns_(task.columns),
          nz_(static_cast<std::uint32_t>(columns_.dimension().z)),
          reach_(task.reach.value_or(Vec3i{0, 0, 0})),
          sets_(nz_) {}

    volume::ColumnTileData run(std::int32_t tileX, std::int32_t tileY) {
        begin(tileX, tileY);
        std::vector<std::uint32_t> deep(width_ * height_, RunSets::kNone);
        if (task_.reach) findDeep(deep);
        builder_.start(static_cast<std::int32_t>(width_));
        const ColumnTile& tile = columns_.tiles()[tile_];
        std::vector<std::uint16_t> row(width_);
        for (std::size_t y = 0; y < height_; ++y) {
            const std::uint32_t* deepRow = deep.data() + y * width_;
            if (y > 0 && tile.rowOf[y] == tile.rowOf[y - 1] &&
                std::equal(deepRow, deepRow + width_, deepRow - width_)) {
                builder_.repeatRow();
                continue;
            }
            for (std::size_t x = 0; x < width_; ++x) {
                const std::uint16_t column = tile.rowColumns[tile.rowOf[y] * width_ + x];
                const bool isAsBefore =
                    x > 0 && deepRow[x] == deepRow[x - 1] && column == tile.rowColumns[tile.rowOf[y] * width_ + x - 1];
                row[x] = isAsBefore ? row[x - 1] : shellColumn(column, tile.column(column), deepRow[x]);
            }
            builder_.addRow(row);
        }
        return builder_.finish();
    }

private:
    void begin(std::int32_t tileX, std::int32_t tileY) {
        sets_ = RunSets(nz_);
        shellColumns_.clear();
        shellIndex_.clear();
        tile_ = std::size_t(tileX) + std::size_t(columns_.tilesX()) * std::size_t(tileY);
        width_ = static_cast<std::size_t>(columns_.tileWidth(tileX));
        height_ = static_cast<std::size_t>(columns_.tileHeight(tileY));
        x0_ = tileX * kTile;
        y0_ = tileY * kTile;
        const Vec3i n = columns_.dimension();
        xBegin_ = std::max(0, x0_ - reach_.x);
        xEnd_ = std::min(n.x, x0_ + static_cast<std::int32_t>(width_) + reach_.x);
        const auto tilesAcross = static_cast<std::size_t>((xEnd_ - 1) / kTile - xBegin_ / kTile + 1);
        known_.assign(tilesAcross, {});
    }

    // Entry x + width * y: the set of the column's voxels that are deep inside their group: the erosion.
    void findDeep(std::vector<std::uint32_t>& deep) {
        const std::size_t rows = height_ + 2 * std::size_t(reach_.y);
        std::vector<std::uint32_t> window(width_ + 2 * std::size_t(reach_.x)), across(rows * width_, RunSets::kNone);
        std::int32_t knownRow = -1;  // tile row of known_
        bool isKnown = false;        // whether the row before is inside the grid, in the same tile row
        for (std::size_t r = 0; r < rows; ++r) {
            const std::int32_t j = y0_ - reach_.y + static_cast<std::int32_t>(r);
            std::uint32_t* out = across.data() + r * width_;
            if (j < 0 || j >= columns_.dimension().y) {
                isKnown = false;
                continue;
            }
            if (j / kTile != knownRow) {
                knownRow = j / kTile;
                for (auto& ofTile : known_) ofTile.clear();
                isKnown = false;
            }
            if (isKnown && isRepeated(j)) {
                std::copy(out - width_, out, out);
                continue;
            }
            gather(j, window);
            intersect(window, std::size_t(reach_.x), out, 1, width_);
            isKnown = true;
        }
        std::vector<std::uint32_t> along(rows);
        for (std::size_t x = 0; x < width_; ++x) {
            for (std::size_t r = 0; r < rows; ++r) along[r] = across[r * width_ + x];
            intersect(along, std::size_t(reach_.y), deep.data() + x, width_, height_);
        }
    }

    // Whether row j equals row j - 1 in all tiles of the window.
    [[nodiscard]] bool isRepeated(std::int32_t j) const {
        if (j % kTile == 0) return false;
        const auto y = static_cast<std::size_t>(j % kTile);
        for (std::int32_t tileX = xBegin_ / kTile; tileX <= (xEnd_ - 1) / kTile; ++tileX) {
            const ColumnTile& tile = columns_.tiles()[tileAt(tileX, j / kTile)];
            if (tile.rowOf[y] != tile.rowOf[y - 1]) return false;
        }
        return true;
    }

    [[nodiscard]] std::size_t tileAt(std::int32_t tileX, std::int32_t tileY) const {
        return std::size_t(tileX) + std::size_t(columns_.tilesX()) * std::size_t(tileY);
    }

    // Gets the sets of row j over the window, eroded along z; empty beyond the grid.
    void gather(std::int32_t j, std::vector<std::uint32_t>& window) {
        const auto y = static_cast<std::size_t>(j % kTile);
        std::fill(window.begin(), window.end(), RunSets::kNone);
        for (std::int32_t i = xBegin_; i < xEnd_;) {
            const std::int32_t tileX = i / kTile, end = std::min(xEnd_, (tileX + 1) * kTile);
            const std::size_t t = tileAt(tileX, j / kTile);
            const ColumnTile& tile = columns_.tiles()[t];
            const auto width = static_cast<std::size_t>(columns_.tileWidth(tileX));
            auto& known = known_[static_cast<std::size_t>(tileX - xBegin_ / kTile)];
            const bool hasAir = task_.air.isIn(t);
            if (!hasAir && known.empty()) known.assign(tile.columnStart.size() - 1, kUnknown);
            std::uint32_t lastNode = kUnknown;
            for (; i < end; ++i) {
                const auto x = static_cast<std::size_t>(i % kTile);
                std::uint32_t& out = window[static_cast<std::size_t>(i - (x0_ - reach_.x))];
                const std::uint16_t column = tile.rowColumns[tile.rowOf[y] * width + x];
                if (hasAir) {
                    // Cells without background have no node of their own, so the columns are compared as well.
                    const std::uint32_t node = task_.air.node(t, x, y);
                    const bool isAsBefore =
                        x > 0 && node == lastNode && column == tile.rowColumns[tile.rowOf[y] * width + x - 1];
                    out = isAsBefore ? (&out)[-1] : eroded(tile.column(column), task_.air.values(t, x, y));
                    lastNode = node;
                } else {
                    if (known[column] == kUnknown) known[column] = eroded(tile.column(column), nullptr);
                    out = known[column];
                }
            }
        }
    }

    // The runs of groups, including enclosed background, shortened by the reach at both ends.
    std::uint32_t eroded(std::span<const Run> runs, const std::uint32_t* air) {
        groupRuns_.clear();
        for (const Run& run : runs) {
            std::uint32_t value = task_.valueOfScalar[run.scalar];
            if (value == 0 && air != nullptr) value = *air++;
            appendRun(groupRuns_, run.end, value == kNoGroupValue ? 0 : value);
        }
        runs_.clear();
        const auto reach = static_cast<std::uint32_t>(reach_.z);
        std::uint32_t begin = 0;
        for (const Run& run : groupRuns_) {
            if (run.scalar != 0 && run.end - begin > 2 * reach) {
                appendRun(runs_, begin + reach, 0);
                appendRun(runs_, run.end - reach, run.scalar);
            }
            begin = run.end;
        }
        if (runs_.empty() || runs_.back().end != nz_) appendRun(runs_, nz_, 0);
        return sets_.add(runs_);
    }

    // out[i * stride] = intersection of in[i .. i + 2 reach], for i < count = in.size() - 2 reach. The input is split
    // into blocks of the window's length, with running intersections from the start and from the end of each block;
    // each window is the intersection of two of these (van Herk 1992).
    void intersect(std::span<const std::uint32_t> in, std::size_t reach, std::uint32_t* out, std::size_t stride,
                   std::size_t count) {
        const std::size_t length = 2 * reach + 1;
        fromStart_.resize(in.size());
        fromEnd_.resize(in.size());
        for (std::size_t i = 0; i < in.size(); ++i)
            fromStart_[i] = i % length == 0 ? in[i] : sets_.common(fromStart_[i - 1], in[i]);
        for (std::size_t i = in.size(); i-- > 0;)
            fromEnd_[i] = i + 1 == in.size() || (i + 1) % length == 0 ? in[i] : sets_.common(in[i], fromEnd_[i + 1]);
        for (std::size_t i = 0; i < count; ++i) out[i * stride] = sets_.common(fromEnd_[i], fromStart_[i + length - 1]);
    }

    // Number of the output column: the column without what is deep inside.
    std::uint16_t shellColumn(std::uint16_t column, std::span<const Run> runs, std::uint32_t deep) {
        const std::uint32_t found = shellIndex_.findOrAdd(
            mixHash(0, std::uint64_t(deep) << 16 | column),
            [&](std::uint32_t known) {
                return shellColumns_[known].column == column && shellColumns_[known].deep == deep;
            },
            [&] {
                runs_.clear();
                const auto inside = sets_.runs(deep);
                for (std::size_t i = 0, j = 0; i < runs.size();) {
                    const std::uint32_t end = std::min(runs[i].end, inside[j].end);
                    appendRun(runs_, end, inside[j].scalar == 0 ? task_.newScalar[runs[i].scalar] : 0);
                    i += runs[i].end == end ? 1 : 0;
                    j += inside[j].end == end ? 1 : 0;
                }
                shellColumns_.push_back({deep, column, builder_.addColumn(runs_)});
                return static_cast<std::uint32_t>(shellColumns_.size() - 1);
            });
        return shellColumns_[found].shell;
    }

    static constexpr std::uint32_t kUnknown = 0xFFFFFFFFu;
    struct ShellColumn {
        std::uint32_t deep;
        std::uint16_t column, shell;
    };

    const Task& task_;
    const ColumnVolume& columns_;
    std::uint32_t nz_;
    Vec3i reach_;
    RunSets sets_;
    volume::ColumnTileBuilder builder_{1};
    std::size_t tile_ = 0, width_ = 0, height_ = 0;
    std::int32_t x0_ = 0, y0_ = 0, xBegin_ = 0, xEnd_ = 0;
    std::vector<std::vector<std::uint32_t>> known_;  // per tile of a tile row: set of each column, or kUnknown
    std::vector<std::uint32_t> fromStart_, fromEnd_;
    std::vector<Run> groupRuns_, runs_;
    std::vector<ShellColumn> shellColumns_;
    HashIndex shellIndex_;
};

Result<void> checkInput(const volume::SemanticVolume& volume, std::span<const std::uint32_t> groupOf,
                        const ShellOptions& options) {
    const std::size_t count = volume.labels.labels.size();
    if (!(options.thickness >= 0) || !std::isfinite(options.thickness))
        return Error(Code::BadArgument,
                     fmt::format("thickness {}: expected metres, 0 or more; 0 gives two voxels", options.thickness));
    if (groupOf.size() != count)
        return Error(Code::BadArgument,
                     fmt::format("groups for {} labels, but the volume has {}", groupOf.size(), count));
    const auto isWrong = [&](std::uint32_t label) { return label != kNoLabel && label >= count; };
    for (const auto& labels : {groupOf, std::span<const std::uint32_t>(options.of)})
        if (const auto found = std::find_if(labels.begin(), labels.end(), isWrong); found != labels.end())
            return Error(Code::BadArgument, fmt::format("label {} of {} does not exist", *found, count));
    const Scalar largest = volume::largestScalar(volume.columns);
    if (largest >= volume.labels.scalarCount())
        return Error(Code::BadArgument, fmt::format("scalar {} belongs to no label", largest));
    return {};
}

// Entry per label: whether its group is kept.
std::vector<bool> keptLabels(std::span<const std::uint32_t> groupOf, std::span<const std::uint32_t> of) {
    std::vector<bool> isKeptGroup(groupOf.size(), of.empty()), isKept(groupOf.size());
    for (const std::uint32_t label : of)
        if (label != kNoLabel && groupOf[label] != kNoLabel) isKeptGroup[groupOf[label]] = true;
    for (std::size_t l = 0; l < groupOf.size(); ++l) isKept[l] = groupOf[l] != kNoLabel && isKeptGroup[groupOf[l]];
    return isKept;
}

// Gives one scalar to each label that represents a group with voxels, in tree order, and none to the others.
void numberGroups(volume::LabelTable& table, std::span<const std::uint32_t> groupOf, const std::vector<bool>& isKept) {
    std::vector<bool> isGroup(groupOf.size(), false);
    for (std::size_t l = 0; l < groupOf.size(); ++l)
        if (isKept[l] && table.labels[l].count > 0) isGroup[groupOf[l]] = true;
    Scalar next = 1;
    for (std::size_t l = 0; l < groupOf.size(); ++l) {
        table.labels[l].first = next;
        table.labels[l].count = isGroup[l] ? 1 : 0;
        next += table.labels[l].count;
    }
    for (volume::Label& label : table.labels)
        if (label.count == 0) label.first = 0;
    table.phaseColors.clear();
}

void countAgain(volume::SemanticVolume& shell) {
    const auto voxels = shell.columns.countVoxels(shell.labels.scalarCount());
    for (volume::Label& label : shell.labels.labels) {
        label.voxels = label.thinVoxels = label.uncertainVoxels = 0;
        for (Scalar s = 0; s < label.count; ++s) label.voxels += voxels[label.first + s];
    }
}

}  // namespace

Result<volume::SemanticVolume> extractShell(const volume::SemanticVolume& volume,
                                            std::span<const std::uint32_t> groupOf, const ShellOptions& options) {
    SVT_DO(checkInput(volume, groupOf, options));
    const std::vector<bool> isKept = keptLabels(groupOf, options.of);
    volume::SemanticVolume shell{volume.grid,      volume.labels, {}, volume.crsName,
                                 volume.modelName, volume.source, {}, volume.planes};
    if (options.labels == ShellLabels::Groups) numberGroups(shell.labels, groupOf, isKept);

    const std::vector<std::uint32_t> labelOfScalar = volume.labels.labelOfScalar();
    std::vector<std::uint32_t> valueOfScalar(labelOfScalar.size(), kNoGroupValue);
    std::vector<Scalar> newScalar(labelOfScalar.size(), 0);
    valueOfScalar[0] = 0;
    for (Scalar s = 1; s < labelOfScalar.size(); ++s) {
        const std::uint32_t l = labelOfScalar[s];
        if (l == kNoLabel || groupOf[l] == kNoLabel) continue;
        valueOfScalar[s] = groupOf[l] + 1;
        if (isKept[l]) newScalar[s] = options.labels == ShellLabels::Groups ? shell.labels.labels[groupOf[l]].first : s;
    }

    const ColumnVolume& columns = volume.columns;
    const EnclosedAir air = EnclosedAir::find(columns, valueOfScalar, options.threads);
    const Task task{columns, valueOfScalar, newScalar, air, reachOf(options.thickness, volume.grid)};
    std::vector<volume::ColumnTileData> tiles(columns.tiles().size());
    parallelFor(tiles.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
        TileShell tileShell(task);
        for (std::size_t t = begin; t < end && !Progress::isCancelled(options.progress); ++t)
            tiles[t] = tileShell.run(static_cast<std::int32_t>(t % std::size_t(columns.tilesX())),
                                     static_cast<std::int32_t>(t / std::size_t(columns.tilesX())));
    });
    if (Progress::isCancelled(options.progress)) return Error(Code::Cancelled, "the shell was stopped");
    shell.columns = ColumnVolume::fromTiles(columns.dimension(), std::move(tiles));
    countAgain(shell);
    Progress::tell(options.progress, "shell", 1);
    if (std::none_of(shell.labels.labels.begin(), shell.labels.labels.end(),
                     [](const volume::Label& label) { return label.voxels > 0; }))
        return Error(
            Code::NothingSelected,
            "the shell has no voxels: the selection is in no group; select features of a group, such as 'under ID'");
    return shell;
}

Result<volume::SemanticVolume> extractShell(const volume::SemanticVolume& volume, ShellLevel level,
                                            const ShellOptions& options) {
    SVT_TRY(groupOf, groupLabels(volume, level, options.threads));
    return extractShell(volume, *groupOf, options);
}

}  // namespace svt::illustrate
