#include <svt/illustrate/exploded.hpp>

#include <svt/core/parallel.hpp>
#include <svt/illustrate/explode/storey_parts.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace svt::illustrate {
namespace {

using volume::ColumnTile;
using volume::ColumnTileData;
using volume::Run;
using volume::Scalar;
using volume::VectorParts;

constexpr double kMostTimes = 16;             // by which a grid may grow: memory grows with it
constexpr double kBrick = 8;                  // samples along an edge of a brick
constexpr std::int32_t kMostSamples = 65535;  // along an axis: boxes of planes have 16 bits

struct Lift {
    const StoreyParts& parts;
    std::int32_t step;    // samples by which a storey is lifted above the one below
    std::int32_t height;  // samples of the new grid
    std::vector<std::uint32_t> labelOfScalar;
};

struct Piece {
    std::uint32_t from, to;
    Scalar scalar;
};

// Lifts the runs of a column. Where two pieces meet after that, the lower one stays.
class ColumnLift {
public:
    explicit ColumnLift(const Lift& lift) : lift_(lift) {}

    std::span<const Run> lifted(std::span<const Run> runs) {
        pieces_.clear();
        std::uint32_t from = 0;
        for (const Run& run : runs) {
            addPieces(from, run);
            from = run.end;
        }
        std::stable_sort(pieces_.begin(), pieces_.end(),
                         [](const Piece& a, const Piece& b) { return a.from < b.from; });
        runs_.clear();
        std::uint32_t end = 0;
        for (const Piece& piece : pieces_) {
            if (piece.to <= end) continue;
            if (piece.from > end) append(piece.from, 0);
            append(piece.to, piece.scalar);
            end = piece.to;
        }
        if (end < static_cast<std::uint32_t>(lift_.height)) append(static_cast<std::uint32_t>(lift_.height), 0);
        return runs_;
    }

private:
    void addPieces(std::uint32_t from, const Run& run) {
        if (run.scalar == 0) return;
        const std::uint32_t label = lift_.labelOfScalar[run.scalar];
        for (const StoreyPart& part : lift_.parts.ofLabel[label]) {
            if (from >= run.end) return;
            const std::uint32_t to = std::min(run.end, static_cast<std::uint32_t>(std::max(0, part.end)));
            if (to <= from) continue;
            const auto by = static_cast<std::uint32_t>(part.number * lift_.step);
            pieces_.push_back({from + by, to + by, run.scalar});
            from = to;
        }
    }
    void append(std::uint32_t end, Scalar scalar) {
        if (!runs_.empty() && runs_.back().scalar == scalar)
            runs_.back().end = end;
        else
            runs_.push_back({end, scalar});
    }

    const Lift& lift_;
    std::vector<Piece> pieces_;
    std::vector<Run> runs_;
};

ColumnTileData liftTile(const ColumnTile& tile, std::int32_t width, const Lift& lift) {
    volume::ColumnTileBuilder builder(width);
    ColumnLift columns(lift);
    constexpr std::uint16_t kUnknown = 0xFFFF;
    std::vector<std::uint16_t> known(tile.columnStart.size(), kUnknown), row(static_cast<std::size_t>(width));
    for (std::size_t y = 0; y < tile.rowOf.size(); ++y) {
        if (y > 0 && tile.rowOf[y] == tile.rowOf[y - 1]) {
            builder.repeatRow();
            continue;
        }
        for (std::size_t x = 0; x < row.size(); ++x) {
            const std::uint16_t column = tile.rowColumns[tile.rowOf[y] * row.size() + x];
            if (known[column] == kUnknown) known[column] = builder.addColumn(columns.lifted(tile.column(column)));
            row[x] = known[column];
        }
        builder.addRow(row);
    }
    return builder.finish();
}

// The planes of faces for each storey: whose they are is not known, so each storey gets those that reach into it.
std::vector<volume::FacePlane> liftPlanes(const volume::SemanticVolume& volume, const Lift& lift) {
    std::vector<volume::FacePlane> planes;
    for (const volume::FacePlane& face : volume.planes)
        for (int number = 0; number <= lift.parts.highest; ++number) {
            const std::int32_t by = number * lift.step;
            volume::FacePlane copy = face;
            copy.plane.offset -= face.plane.normal.z * by;
            copy.min[2] = static_cast<std::uint16_t>(face.min[2] + by);
            copy.max[2] = static_cast<std::uint16_t>(face.max[2] + by);
            planes.push_back(copy);
            // An upright plane is the same in all storeys.
            if (face.plane.normal.z != 0) continue;
            planes.back().max[2] = static_cast<std::uint16_t>(face.max[2] + lift.parts.highest * lift.step);
            break;
        }
    return planes;
}

// Lifts edges and triangles. Those of labels that are cut into storeys are clipped to each storey.
class VectorLift {
public:
    VectorLift(const volume::SemanticVolume& volume, const Lift& lift)
        : from_(volume.vectors), lift_(lift), up_(volume.grid.axes()[2]), spacing_(volume.grid.spacing().z) {
        to_.unit = from_.unit;
    }

    VectorParts lifted() {
        for (const auto& segment : from_.segments)
            eachPart(segment.label, {segment.ends.begin(), segment.ends.end()}, [&](std::span<const Vec3d> points) {
                if (points.size() >= 2) to_.segments.push_back({segment.label, {add(points[0]), add(points[1])}});
            });
        for (const auto& triangle : from_.triangles)
            eachPart(
                triangle.label, {triangle.corners.begin(), triangle.corners.end()}, [&](std::span<const Vec3d> points) {
                    for (std::size_t n = 2; n < points.size(); ++n)
                        to_.triangles.push_back({triangle.label, {add(points[0]), add(points[n - 1]), add(points[n])}});
                });
        return std::move(to_);
    }

private:
    // Height of a point in samples from the lower side of the lowest.
    [[nodiscard]] double heightOf(Vec3d point) const { return dot(point, up_) * from_.unit / spacing_ + 0.5; }

    template <class Use>
    void eachPart(std::uint32_t label, std::span<const std::uint32_t> corners, const Use& use) {
        const auto& parts = lift_.parts.ofLabel[label];
        double low = -std::numeric_limits<double>::infinity();
        for (std::size_t n = 0; n < parts.size(); ++n) {
            points_.clear();
            for (const std::uint32_t corner : corners) points_.push_back(toDouble(from_.points[corner]));
            const double high = n + 1 == parts.size() ? std::numeric_limits<double>::infinity() : parts[n].end;
            if (n > 0) keepAbove(low, 1);
            if (n + 1 < parts.size()) keepAbove(-high, -1);
            const Vec3d by = up_ * (parts[n].number * lift_.step * spacing_ / from_.unit);
            for (Vec3d& point : points_) point = point + by;
            use(points_);
            low = high;
        }
    }

    // Clips the polygon or segment to side * height >= limit (Sutherland and Hodgman 1974).
    void keepAbove(double limit, double side) {
        std::vector<Vec3d> kept;
        const std::size_t count = points_.size(), edges = count == 2 ? 1 : count;
        for (std::size_t n = 0; n < count; ++n) {
            const Vec3d a = points_[n], b = points_[(n + 1) % count];
            const double atA = side * heightOf(a) - limit, atB = side * heightOf(b) - limit;
            if (atA >= 0) kept.push_back(a);
            if (n < edges && (atA >= 0) != (atB >= 0)) kept.push_back(a + (b - a) * (atA / (atA - atB)));
        }
        points_ = std::move(kept);
    }

    std::uint32_t add(Vec3d point) {
        const auto whole = [](double v) { return static_cast<std::int32_t>(std::lround(v)); };
        const std::array<std::int32_t, 3> key{whole(point.x), whole(point.y), whole(point.z)};
        const auto [found, isNew] = numbers_.try_emplace(key, static_cast<std::uint32_t>(to_.points.size()));
        if (isNew) to_.points.push_back({key[0], key[1], key[2]});
        return found->second;
    }

    const VectorParts& from_;
    const Lift& lift_;
    Vec3d up_;
    double spacing_;
    VectorParts to_;
    std::vector<Vec3d> points_;
    std::map<std::array<std::int32_t, 3>, std::uint32_t> numbers_;
};

}  // namespace

Result<volume::SemanticVolume> explodeStoreys(const volume::SemanticVolume& volume, double distance, int threads) {
    if (!(distance > 0) || !std::isfinite(distance))
        return Error(Code::BadArgument,
                     fmt::format("storeys cannot be drawn {} m apart; a distance above 0 is possible", distance));
    const StoreyParts parts = findStoreyParts(volume);
    if (parts.highest == 0)
        return Error(
            Code::BadArgument,
            "no building of this model has two storeys, or rooms on two levels, that could be drawn apart; leave "
            "out --explode");
    const volume::Grid& grid = volume.grid;
    // Whole bricks: so each storey falls into bricks, and is drawn, as it was.
    const double steps = kBrick * std::max(1.0, std::round(distance / grid.spacing().z / kBrick));
    Vec3i dimension = grid.dimension();
    const double height = dimension.z + steps * parts.highest;
    if (height > std::min<double>(kMostSamples, kMostTimes * std::max(dimension.z, 256)))
        return Error(
            Code::BadArgument,
            fmt::format("{} storeys drawn {} m apart take {} samples along z, too many for this model; use a smaller "
                        "distance or a larger --spacing",
                        parts.highest + 1, distance, height));
    dimension.z = static_cast<std::int32_t>(height);
    SVT_TRY(higher, volume::Grid::fromParts(dimension, grid.spacing(), grid.origin(), grid.axes()));
    const Lift lift{parts, static_cast<std::int32_t>(steps), dimension.z, volume.labels.labelOfScalar()};
    const volume::ColumnVolume& columns = volume.columns;
    std::vector<ColumnTileData> tiles(columns.tiles().size());
    parallelFor(tiles.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            const auto tileX = static_cast<std::int32_t>(t % static_cast<std::size_t>(columns.tilesX()));
            tiles[t] = liftTile(columns.tiles()[t], columns.tileWidth(tileX), lift);
        }
    });
    volume::SemanticVolume apart{*higher,
                                 volume.labels,
                                 volume::ColumnVolume::fromTiles(dimension, std::move(tiles)),
                                 volume.crsName,
                                 volume.modelName,
                                 volume.source,
                                 {},
                                 liftPlanes(volume, lift)};
    if (!volume.vectors.isEmpty()) apart.vectors = VectorLift(volume, lift).lifted();
    return apart;
}

}  // namespace svt::illustrate
