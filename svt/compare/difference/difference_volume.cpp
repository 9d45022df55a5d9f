#include <svt/compare/difference_volume.hpp>

#include <svt/compare/difference/difference_labels.hpp>
#include <svt/compare/match/voxel_overlaps.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace svt::compare {
namespace {

using volume::Run, volume::Scalar;

constexpr double kMostUnits = 0x1p30;  // of a coordinate

// One of the two volumes, and where its first sample is in the difference volume.
struct Placed {
    const volume::SemanticVolume& volume;
    Vec3i at;
    std::vector<std::uint32_t> labelOf = volume.labels.labelOfScalar();

    [[nodiscard]] std::span<const Run> column(std::int32_t i, std::int32_t j) const {
        const Vec3i n = volume.grid.dimension();
        const std::int32_t x = i - at.x, y = j - at.y;
        return x < 0 || y < 0 || x >= n.x || y >= n.y ? std::span<const Run>() : volume.columns.column(x, y);
    }
};

// Walks up a column of one volume in samples of the difference volume.
class ColumnReader {
public:
    ColumnReader(const Placed& placed, std::int32_t i, std::int32_t j)
        : placed_(placed), runs_(placed.column(i, j)), begin_(placed.at.z) {}

    /// The label at sample k; ascending calls. \param end  receives the sample at which it may change
    std::uint32_t labelAt(std::int64_t k, std::int64_t& end) {
        if (k < begin_) {
            if (!runs_.empty()) end = std::min(end, begin_);
            return volume::kNoLabel;
        }
        while (run_ < runs_.size() && begin_ + runs_[run_].end <= k) ++run_;
        if (run_ == runs_.size()) return volume::kNoLabel;
        end = std::min(end, begin_ + runs_[run_].end);
        return placed_.labelOf[runs_[run_].scalar];
    }

private:
    const Placed& placed_;
    std::span<const Run> runs_;
    std::int64_t begin_;
    std::size_t run_ = 0;
};

volume::ColumnVolume makeColumns(const Placed& was, const Placed& is, const DifferenceLabels& labels, Vec3i dimension) {
    constexpr std::int32_t kTile = volume::ColumnVolume::kTileSize;
    std::vector<volume::ColumnTileData> tiles;
    volume::ColumnTileBuilder builder(kTile);
    std::vector<Run> runs;
    std::vector<std::uint16_t> row;
    const auto makeColumn = [&](std::int32_t i, std::int32_t j) {
        ColumnReader before(was, i, j), after(is, i, j);
        runs.clear();
        for (std::int64_t k = 0, end = 0; k < dimension.z; k = end) {
            end = dimension.z;
            const std::uint32_t a = before.labelAt(k, end), b = after.labelAt(k, end);
            const Scalar scalar = labels.scalarAt(a, b);
            if (!runs.empty() && runs.back().scalar == scalar)
                runs.back().end = static_cast<std::uint32_t>(end);
            else
                runs.push_back({static_cast<std::uint32_t>(end), scalar});
        }
        return builder.addColumn(runs);
    };
    for (std::int32_t y = 0; y < dimension.y; y += kTile)
        for (std::int32_t x = 0; x < dimension.x; x += kTile) {
            const std::int32_t endX = std::min(x + kTile, dimension.x), endY = std::min(y + kTile, dimension.y);
            builder.start(endX - x);
            for (std::int32_t j = y; j < endY; ++j) {
                row.clear();
                for (std::int32_t i = x; i < endX; ++i) row.push_back(makeColumn(i, j));
                builder.addRow(row);
            }
            tiles.push_back(builder.finish());
        }
    return volume::ColumnVolume::fromTiles(dimension, std::move(tiles));
}

// Copies the faces of whole objects. \param shift  added to points, in units of `to`
template <class WholeOf>
void copyFaces(const volume::VectorParts& from, Vec3d shift, const WholeOf& wholeOf, volume::VectorParts& to) {
    std::vector<std::uint32_t> pointOf(from.points.size(), volume::kNoLabel);
    const auto copyPoint = [&](std::uint32_t p) {
        if (pointOf[p] == volume::kNoLabel) {
            const Vec3d at = toDouble(from.points[p]) * (from.unit / to.unit) + shift;
            pointOf[p] = static_cast<std::uint32_t>(to.points.size());
            to.points.push_back({static_cast<std::int32_t>(std::lround(at.x)),
                                 static_cast<std::int32_t>(std::lround(at.y)),
                                 static_cast<std::int32_t>(std::lround(at.z))});
        }
        return pointOf[p];
    };
    for (const auto& triangle : from.triangles)
        if (const std::uint32_t label = wholeOf(triangle.label); label != volume::kNoLabel)
            to.triangles.push_back(
                {label,
                 {copyPoint(triangle.corners[0]), copyPoint(triangle.corners[1]), copyPoint(triangle.corners[2])}});
}

void movePlanes(const Placed& placed, std::vector<volume::FacePlane>& to) {
    const Vec3d shift = toDouble(placed.at);
    for (volume::FacePlane plane : placed.volume.planes) {
        plane.plane.offset -= dot(plane.plane.normal, shift);
        for (int axis = 0; axis < 3; ++axis) {
            plane.min[std::size_t(axis)] = static_cast<std::uint16_t>(plane.min[std::size_t(axis)] + placed.at[axis]);
            plane.max[std::size_t(axis)] = static_cast<std::uint16_t>(plane.max[std::size_t(axis)] + placed.at[axis]);
        }
        to.push_back(plane);
    }
}

void fillCounts(volume::SemanticVolume& volume) {
    const auto counts = volume.columns.countVoxels(volume.labels.scalarCount());
    for (volume::Label& label : volume.labels.labels) {
        if (label.count == 0) continue;
        label.voxels = counts[label.first];
        if (label.filling == volume::Filling::Winding) label.volume = 0;
    }
}

}  // namespace

Result<volume::SemanticVolume> makeDifferenceVolume(const volume::SemanticVolume& was, const volume::SemanticVolume& is,
                                                    const Comparison& comparison) {
    const auto offset = latticeOffset(was.grid, is.grid);
    if (!offset)
        return Error(Code::BadArgument,
                     "a .svt of the difference needs two volumes with the same sample positions; give one state as a "
                     "model file, "
                     "which is then built on the samples of the other");
    const Vec3i n = was.grid.dimension(), m = is.grid.dimension();
    Vec3i first{}, dimension{};
    for (int axis = 0; axis < 3; ++axis) {
        first[axis] = std::min(0, (*offset)[axis]);
        const std::int64_t end = std::max<std::int64_t>(n[axis], std::int64_t{(*offset)[axis]} + m[axis]);
        dimension[axis] = static_cast<std::int32_t>(
            std::min<std::int64_t>(end - first[axis], std::numeric_limits<std::int32_t>::max()));
    }
    SVT_TRY(grid, volume::Grid::fromParts(dimension, was.grid.spacing(), was.grid.worldFromIndex(toDouble(first)),
                                          was.grid.axes()));
    const DifferenceLabels labels(was, is, comparison);
    if (labels.table().scalarCount() > volume::kMaxScalarCount)
        return Error(Code::TooManyLabels, fmt::format("the difference has {} objects and parts; {} are possible",
                                                      labels.table().scalarCount(), volume::kMaxScalarCount));
    const Placed before{was, -first}, after{is, *offset - first};
    volume::SemanticVolume difference;
    difference.grid = *grid;
    difference.labels = labels.table();
    difference.columns = makeColumns(before, after, labels, dimension);
    difference.crsName = is.crsName.empty() ? was.crsName : is.crsName;
    difference.modelName = is.modelName;
    difference.source = is.source;
    volume::VectorParts& parts = difference.vectors;
    parts.unit = std::max(was.vectors.unit, is.vectors.unit);
    const Vec3d size = scaled(toDouble(dimension), grid->spacing());
    while (parts.unit < volume::VectorParts::kCoarsestUnit &&
           std::max({size.x, size.y, size.z}) / parts.unit > kMostUnits)
        parts.unit *= 2;
    copyFaces(
        was.vectors, (was.grid.origin() - grid->origin()) / parts.unit,
        [&](std::uint32_t l) { return labels.wholeOfWas(l); }, parts);
    copyFaces(
        is.vectors, (is.grid.origin() - grid->origin()) / parts.unit,
        [&](std::uint32_t l) { return labels.wholeOfIs(l); }, parts);
    std::stable_sort(parts.triangles.begin(), parts.triangles.end(),
                     [](const auto& s, const auto& t) { return s.label < t.label; });
    movePlanes(after, difference.planes);
    movePlanes(before, difference.planes);
    fillCounts(difference);
    return difference;
}

Result<volume::SemanticVolume> translated(const volume::SemanticVolume& volume, Vec3d vector) {
    const volume::Grid& grid = volume.grid;
    SVT_TRY(moved, volume::Grid::fromParts(grid.dimension(), grid.spacing(), grid.origin() + vector, grid.axes()));
    volume::SemanticVolume result = volume;
    result.grid = *moved;
    return result;
}

}  // namespace svt::compare
