#include <svt/volume/lod_pyramid.hpp>
#include <svt/volume/volume_part.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace svt::volume {
namespace {

constexpr std::int32_t kTile = ColumnVolume::kTileSize;
constexpr std::uint16_t kNoColumn = 0xFFFF;  // a tile has 4096 columns at most

/// Counts voxels again. The volume of a solid that was cut is unknown, so its voxels count.
void recount(SemanticVolume& volume) {
    const auto voxels = volume.columns.countVoxels(volume.labels.scalarCount());
    for (Label& label : volume.labels.labels) {
        std::uint64_t count = 0;
        for (Scalar s = 0; s < label.count; ++s) count += voxels[label.first + s];
        if (count == label.voxels) continue;
        const bool isBody = label.filling == Filling::Body;
        label.volume = isBody ? static_cast<double>(count) * volume.grid.voxelVolume() : 0;
        label.thinVoxels = std::min(label.thinVoxels, count);
        label.uncertainVoxels = std::min(label.uncertainVoxels, count);
        label.voxels = count;
    }
}

// The overlaps of a part, by labels before and after recount(). A label that lost voxels is taken to have lost its shared
// ones at the same rate.
std::vector<Overlap> overlapsOf(const SemanticVolume& part, const LabelTable& before) {
    std::vector<Overlap> overlaps;
    for (Overlap overlap : before.overlaps) {
        const std::uint64_t whole = before.labels[overlap.a].voxels, left = part.labels.labels[overlap.a].voxels;
        if (left == 0) continue;  // nothing of it is here that could have taken voxels
        if (left < whole && overlap.voxels > 0) {
            const double share = double(overlap.voxels) * double(left) / double(whole);
            overlap.voxels = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(share)));
        }
        overlaps.push_back(overlap);
    }
    return overlaps;
}

void appendRun(std::vector<Run>& runs, Run run) {
    if (!runs.empty() && runs.back().scalar == run.scalar)
        runs.back().end = run.end;
    else
        runs.push_back(run);
}

ColumnTileData replacedTile(const ColumnTile& tile, std::size_t width, std::span<const Scalar> newOf) {
    ColumnTileBuilder builder(static_cast<std::int32_t>(width));
    std::vector<std::uint16_t> numberOf;
    std::vector<Run> runs;
    // Columns are numbered by first use, and columns that become equal get the number of the first one.
    for (std::uint32_t c = 0; c + 1 < tile.columnStart.size(); ++c) {
        runs.clear();
        for (const Run& run : tile.column(c)) appendRun(runs, {run.end, newOf[run.scalar]});
        numberOf.push_back(builder.addColumn(runs));
    }
    std::vector<std::uint16_t> row(width);
    for (std::size_t r = 0; r < tile.rowOf.size(); ++r) {
        if (r > 0 && tile.rowOf[r] == tile.rowOf[r - 1]) {
            builder.repeatRow();
            continue;
        }
        const auto* columns = tile.rowColumns.data() + tile.rowOf[r] * width;
        for (std::size_t x = 0; x < width; ++x) row[x] = numberOf[columns[x]];
        builder.addRow(row);
    }
    return builder.finish();
}

/// One tile of a box of columns. Columns of the source are cut once each.
class Cropper {
public:
    Cropper(const ColumnVolume& source, const IndexBox& box) : source_(source), box_(box) {}

    ColumnTileData tile(std::int32_t iBegin, std::int32_t jBegin, std::int32_t width, std::int32_t height) {
        ColumnTileBuilder builder(width);
        std::vector<std::uint16_t> row(static_cast<std::size_t>(width));
        for (auto& known : numberOf_) known.clear();
        for (std::int32_t j = jBegin; j < jBegin + height; ++j) {
            for (std::int32_t x = 0; x < width; ++x)
                row[std::size_t(x)] = number(builder, iBegin, iBegin + x, j, jBegin);
            builder.addRow(row);
        }
        return builder.finish();
    }

private:
    // A tile of the part lies in four tiles of the source at most.
    std::uint16_t number(ColumnTileBuilder& builder, std::int32_t iBegin, std::int32_t i, std::int32_t j,
                         std::int32_t jBegin) {
        const std::int32_t tileX = i / kTile, tileY = j / kTile;
        const auto quarter =
            static_cast<std::size_t>((tileX > iBegin / kTile ? 1 : 0) + (tileY > jBegin / kTile ? 2 : 0));
        const ColumnTile& tile =
            source_.tiles()[std::size_t(tileX) + std::size_t(source_.tilesX()) * std::size_t(tileY)];
        const std::size_t rowNumber = tile.rowOf[std::size_t(j % kTile)];
        const std::uint16_t column =
            tile.rowColumns[rowNumber * std::size_t(source_.tileWidth(tileX)) + std::size_t(i % kTile)];
        auto& known = numberOf_[quarter];
        if (known.empty()) known.assign(tile.columnStart.size() - 1, kNoColumn);
        if (known[column] == kNoColumn) known[column] = builder.addColumn(cut(tile.column(column)));
        return known[column];
    }

    std::span<const Run> cut(std::span<const Run> runs) {
        runs_.clear();
        const auto begin = static_cast<std::uint32_t>(box_.begin.z), end = static_cast<std::uint32_t>(box_.end.z);
        for (const Run& run : runs) {
            if (run.end <= begin) continue;
            runs_.push_back({std::min(run.end, end) - begin, run.scalar});
            if (run.end >= end) break;
        }
        return runs_;
    }

    const ColumnVolume& source_;
    IndexBox box_;
    std::array<std::vector<std::uint16_t>, 4> numberOf_;
    std::vector<Run> runs_;
};

std::vector<FacePlane> croppedPlanes(std::span<const FacePlane> planes, const IndexBox& box) {
    std::vector<FacePlane> kept;
    for (FacePlane plane : planes) {
        bool isInside = true;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const std::int32_t least = std::max<std::int32_t>(plane.min[a], box.begin[axis]) - box.begin[axis];
            const std::int32_t most = std::min<std::int32_t>(plane.max[a], box.end[axis]) - box.begin[axis];
            isInside = isInside && least < most;
            plane.min[a] = static_cast<std::uint16_t>(std::max(least, 0));
            plane.max[a] = static_cast<std::uint16_t>(std::max(most, 0));
        }
        plane.plane.offset += dot(plane.plane.normal, toDouble(box.begin));
        if (isInside) kept.push_back(plane);
    }
    return kept;
}

/// The scalar of a cell: the most frequent scalar of the label that fills most of it; background if it fills more.
Scalar scalarOf(const Mixture& mixture, std::span<const std::uint32_t> labelOf) {
    int most = 0;
    Scalar scalar = 0;
    for (const MixturePart& part : mixture.labels()) {
        int coverage = 0;
        for (const MixturePart& other : mixture.labels())
            if (labelOf[other.scalar] == labelOf[part.scalar]) coverage += other.coverage;
        if (coverage <= most) continue;  // parts are ordered: of equal ones, the first
        most = coverage;
        scalar = part.scalar;
    }
    return most >= 255 - mixture.coverage() ? scalar : 0;
}

}  // namespace

Result<IndexBox> samplesIn(const Grid& grid, const Box3d& world) {
    Box3d index;
    for (int corner = 0; corner < 8; ++corner)
        index.add(grid.indexFromWorld({(corner & 1) != 0 ? world.max.x : world.min.x,
                                       (corner & 2) != 0 ? world.max.y : world.min.y,
                                       (corner & 4) != 0 ? world.max.z : world.min.z}));
    IndexBox box;
    const Vec3i dimension = grid.dimension();
    // Rounding may move a bound away from the sample that it should lie on.
    constexpr double kRounding = 1e-6;
    for (int axis = 0; axis < 3; ++axis) {
        const double least = std::max(std::ceil(index.min[axis] - kRounding), 0.0);
        const double most = std::min(std::floor(index.max[axis] + kRounding), double(dimension[axis] - 1));
        if (world.isEmpty() || !(least <= most))
            return Error(Code::NothingSelected,
                         fmt::format("no sample lies in the box from {:.3f},{:.3f},{:.3f} to {:.3f},{:.3f},{:.3f}; "
                                     "`svt info` prints the position of the volume",
                                     world.min.x, world.min.y, world.min.z, world.max.x, world.max.y, world.max.z));
        box.begin[axis] = static_cast<std::int32_t>(least);
        box.end[axis] = static_cast<std::int32_t>(most) + 1;
        if (box.end[axis] - box.begin[axis] > 1) continue;
        if (box.end[axis] < dimension[axis])
            ++box.end[axis];
        else
            --box.begin[axis];
    }
    return box;
}

IndexBox samplesAround(const ColumnVolume& columns, Scalar first, Scalar last) {
    const Vec3i n = columns.dimension();
    IndexBox box{n, {0, 0, 0}};
    for (std::int32_t j = 0; j < n.y; ++j)
        for (std::int32_t i = 0; i < n.x; ++i) {
            std::int32_t low = 0;
            for (const Run& run : columns.column(i, j)) {
                const auto high = static_cast<std::int32_t>(run.end);
                if (run.scalar >= first && run.scalar <= last) {
                    box.begin = {std::min(box.begin.x, i), std::min(box.begin.y, j), std::min(box.begin.z, low)};
                    box.end = {std::max(box.end.x, i + 1), std::max(box.end.y, j + 1), std::max(box.end.z, high)};
                }
                low = high;
            }
        }
    if (box.end.x == 0) return {};
    for (int axis = 0; axis < 3; ++axis) {
        box.begin[axis] = std::max(0, box.begin[axis] - 1);
        box.end[axis] = std::min(n[axis], box.end[axis] + 1);
    }
    return box;
}

ColumnVolume replaceScalars(const ColumnVolume& columns, std::span<const Scalar> newOf) {
    std::vector<ColumnTileData> tiles;
    tiles.reserve(columns.tiles().size());
    for (std::size_t t = 0; t < columns.tiles().size(); ++t) {
        const auto tileX = static_cast<std::int32_t>(t % std::size_t(columns.tilesX()));
        tiles.push_back(replacedTile(columns.tiles()[t], std::size_t(columns.tileWidth(tileX)), newOf));
    }
    return ColumnVolume::fromTiles(columns.dimension(), std::move(tiles));
}

Result<SemanticVolume> croppedVolume(const SemanticVolume& volume, const IndexBox& box) {
    const Vec3i dimension = volume.grid.dimension();
    for (int axis = 0; axis < 3; ++axis)
        if (box.begin[axis] < 0 || box.end[axis] > dimension[axis] || box.end[axis] - box.begin[axis] < 2)
            return Error(Code::BadArgument, fmt::format("cannot crop to samples {} to {} of {} along axis {}",
                                                        box.begin[axis], box.end[axis], dimension[axis], axis));
    if (box == IndexBox{{}, dimension}) return volume;
    const Vec3i size = box.end - box.begin;
    SVT_TRY(grid, Grid::fromParts(size, volume.grid.spacing(), volume.grid.worldFromIndex(toDouble(box.begin)),
                                  volume.grid.axes()));
    Cropper cropper(volume.columns, box);
    std::vector<ColumnTileData> tiles;
    for (std::int32_t j = 0; j < size.y; j += kTile)
        for (std::int32_t i = 0; i < size.x; i += kTile)
            tiles.push_back(cropper.tile(box.begin.x + i, box.begin.y + j, std::min(kTile, size.x - i),
                                         std::min(kTile, size.y - j)));
    SemanticVolume part{*grid,          volume.labels,    ColumnVolume::fromTiles(size, std::move(tiles)),
                        volume.crsName, volume.modelName, volume.source};
    part.planes = croppedPlanes(volume.planes, box);
    recount(part);
    part.labels.overlaps = overlapsOf(part, volume.labels);
    return part;
}

Result<SemanticVolume> volumeIn(const SemanticVolume& volume, const Box3d& world) {
    SVT_TRY(samples, samplesIn(volume.grid, world));
    return croppedVolume(volume, *samples);
}

Result<SemanticVolume> selectedVolume(const SemanticVolume& volume, std::span<const std::uint32_t> kept) {
    std::vector<Scalar> newOf(volume.labels.scalarCount(), 0);
    for (const std::uint32_t label : kept) {
        if (label >= volume.labels.labels.size())
            return Error(Code::BadArgument, fmt::format("there is no label {}", label));
        const Label& chosen = volume.labels.labels[label];
        for (Scalar s = chosen.first; s < chosen.first + chosen.count; ++s) newOf[s] = s;
    }
    SemanticVolume part{volume.grid,    volume.labels,    replaceScalars(volume.columns, newOf),
                        volume.crsName, volume.modelName, volume.source};
    part.planes = volume.planes;
    recount(part);
    part.labels.overlaps = overlapsOf(part, volume.labels);
    return part;
}

namespace {

SemanticVolume coarseOf(const SemanticVolume& volume, const LodLevel& level,
                        const std::vector<std::uint32_t>& labelOf) {
    std::vector<Scalar> newOf;
    newOf.reserve(level.mixtures.size());
    for (const Mixture& mixture : level.mixtures) newOf.push_back(scalarOf(mixture, labelOf));
    SemanticVolume part{level.grid,     volume.labels,    replaceScalars(level.columns, newOf),
                        volume.crsName, volume.modelName, volume.source};
    part.labels.overlaps.clear();
    recount(part);
    return part;
}

}  // namespace

Result<std::vector<SemanticVolume>> coarseVolumes(const SemanticVolume& volume, int coarsest, int threads) {
    SVT_TRY(levels, buildLodPyramid(volume.columns, volume.grid, coarsest, threads));
    const auto labelOf = volume.labels.labelOfScalar();
    std::vector<SemanticVolume> parts;
    for (const LodLevel& level : *levels) parts.push_back(coarseOf(volume, level, labelOf));
    return parts;
}

Result<SemanticVolume> coarseVolume(const SemanticVolume& volume, int level, int threads) {
    if (level == 0) return volume;
    if (level < 0 || level > 6)
        return Error(Code::BadArgument, fmt::format("level {} is out of range; 0 to 6 are possible", level));
    if (const int count = lodLevelCount(volume.grid.dimension()); level > count)
        return Error(Code::BadArgument,
                     fmt::format("the volume is too small for level {}; its coarsest is {}", level, count));
    SVT_TRY(coarse, buildLodLevel(volume.columns, volume.grid, level, threads));
    return coarseOf(volume, *coarse, volume.labels.labelOfScalar());
}

}  // namespace svt::volume
