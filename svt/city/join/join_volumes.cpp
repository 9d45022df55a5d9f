#include <svt/city/join/join_volumes.hpp>

#include <svt/core/parallel.hpp>
#include <svt/volume/volume_part.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

namespace svt::city {
namespace {

using volume::ColumnTileBuilder;
using volume::ColumnTileData;
using volume::ColumnVolume;
using volume::Run;
using volume::Scalar;

struct Part {
    const ColumnVolume* columns = nullptr;
    Vec3i begin{};      // of its first sample in the whole
    Scalar before = 0;  // scalars of the parts before
};

// Samples that two parts fill: by the scalar that gets them, then the one that loses them.
using SharedSamples = std::map<std::pair<Scalar, Scalar>, std::uint64_t>;

class Joiner {
public:
    Joiner(std::vector<Part> parts, Vec3i dimension) : parts_(std::move(parts)), dimension_(dimension) {}

    // Tiles do not depend on each other, nor on the number of threads.
    // \param shared  empty; receives the samples that several parts fill
    [[nodiscard]] ColumnVolume run(SharedSamples& shared) const {
        constexpr std::int32_t kSize = ColumnVolume::kTileSize;
        const auto across = static_cast<std::size_t>((dimension_.x + kSize - 1) / kSize);
        const auto along = static_cast<std::size_t>((dimension_.y + kSize - 1) / kSize);
        std::vector<ColumnTileData> tiles(across * along);
        std::mutex isAdding;
        parallelFor(tiles.size(), 16, 0, [&](std::size_t begin, std::size_t end) {
            Scratch scratch;
            for (std::size_t n = begin; n < end; ++n) {
                const auto i = static_cast<std::int32_t>(n % across) * kSize;
                const auto j = static_cast<std::int32_t>(n / across) * kSize;
                tiles[n] = tile(i, j, std::min(kSize, dimension_.x - i), std::min(kSize, dimension_.y - j), scratch);
            }
            const std::lock_guard lock(isAdding);
            for (const auto& [scalars, samples] : scratch.shared) shared[scalars] += samples;
        });
        return ColumnVolume::fromTiles(dimension_, std::move(tiles));
    }

private:
    struct Scratch {
        std::vector<Run> whole, next;
        SharedSamples shared;
    };

    ColumnTileData tile(std::int32_t iBegin, std::int32_t jBegin, std::int32_t width, std::int32_t height,
                        Scratch& scratch) const {
        std::vector<const Part*> meeting;
        for (const Part& part : parts_) {
            const Vec3i n = part.columns->dimension();
            if (part.begin.x < iBegin + width && iBegin < part.begin.x + n.x && part.begin.y < jBegin + height &&
                jBegin < part.begin.y + n.y)
                meeting.push_back(&part);
        }
        ColumnTileBuilder builder(width);
        std::vector<std::uint16_t> row(static_cast<std::size_t>(width));
        for (std::int32_t j = jBegin; j < jBegin + height; ++j) {
            if (meeting.empty() && j > jBegin) {
                builder.repeatRow();
                continue;
            }
            for (std::int32_t x = 0; x < width; ++x)
                row[std::size_t(x)] = builder.addColumn(column(meeting, iBegin + x, j, scratch));
            builder.addRow(row);
        }
        return builder.finish();
    }

    std::span<const Run> column(const std::vector<const Part*>& meeting, std::int32_t i, std::int32_t j,
                                Scratch& scratch) const {
        scratch.whole.assign(1, {static_cast<std::uint32_t>(dimension_.z), 0});
        for (const Part* part : meeting) {
            const Vec3i n = part->columns->dimension();
            const std::int32_t x = i - part->begin.x, y = j - part->begin.y;
            if (x < 0 || y < 0 || x >= n.x || y >= n.y) continue;
            lay(*part, part->columns->column(x, y), scratch);
        }
        return scratch.whole;
    }

    // Adds the runs of a part where no earlier part fills the column.
    static void lay(const Part& part, std::span<const Run> runs, Scratch& scratch) {
        auto& [whole, next, shared] = scratch;
        if (runs.size() == 1 && runs[0].scalar == 0) return;
        next.clear();
        std::uint32_t from = 0;
        std::size_t under = 0;
        const auto low = static_cast<std::uint32_t>(part.begin.z);
        for (const Run& over : whole)
            while (from < over.end) {
                Scalar scalar = 0;
                std::uint32_t end = over.end;
                if (from < low) {
                    end = std::min(end, low);
                } else {
                    while (under < runs.size() && runs[under].end + low <= from) ++under;
                    if (under < runs.size()) {
                        end = std::min(end, runs[under].end + low);
                        scalar = runs[under].scalar == 0 ? 0 : runs[under].scalar + part.before;
                    }
                }
                if (over.scalar != 0 && scalar != 0) shared[{over.scalar, scalar}] += end - from;
                if (over.scalar != 0) scalar = over.scalar;
                if (!next.empty() && next.back().scalar == scalar)
                    next.back().end = end;
                else
                    next.push_back({end, scalar});
                from = end;
            }
        std::swap(whole, next);
    }

    std::vector<Part> parts_;
    Vec3i dimension_;
};

// The labels of `from`, with numbers behind those of `into`.
void appendLabels(volume::LabelTable& into, const volume::LabelTable& from, Scalar before) {
    const auto first = static_cast<std::uint32_t>(into.labels.size());
    for (volume::Label label : from.labels) {
        if (label.parent != volume::kNoLabel) label.parent += first;
        label.subtreeEnd += first;
        for (std::uint32_t& group : label.groups) group += first;
        if (label.count > 0) label.first += before;
        into.labels.push_back(std::move(label));
    }
    for (volume::Overlap overlap : from.overlaps) {
        overlap.a += first;
        overlap.b += first;
        into.overlaps.push_back(overlap);
    }
}

// Adds the samples that several parts fill. The labels of different parts have no other overlaps.
void addOverlaps(const SharedSamples& shared, volume::LabelTable& table) {
    if (shared.empty()) return;
    const std::vector<std::uint32_t> labelOf = table.labelOfScalar();
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> samplesOf;
    for (const auto& [scalars, samples] : shared)
        samplesOf[{labelOf[scalars.first], labelOf[scalars.second]}] += samples;
    for (const auto& [labels, samples] : samplesOf)
        table.overlaps.push_back({labels.first, labels.second, samples, false});
    std::sort(table.overlaps.begin(), table.overlaps.end(), [](const volume::Overlap& p, const volume::Overlap& q) {
        return std::pair(p.a, p.b) < std::pair(q.a, q.b);
    });
}

// Adds planes of a part. \param begin  of its first sample in the whole
void addPlanes(const std::vector<volume::FacePlane>& planes, Vec3i begin, std::vector<volume::FacePlane>& to) {
    for (volume::FacePlane face : planes) {
        face.plane.offset -= dot(face.plane.normal, toDouble(begin));
        for (int axis = 0; axis < 3; ++axis) {
            const auto place = static_cast<std::size_t>(axis);
            face.min[place] = static_cast<std::uint16_t>(face.min[place] + begin[axis]);
            face.max[place] = static_cast<std::uint16_t>(face.max[place] + begin[axis]);
        }
        to.push_back(face);
    }
}

// Adds the faces of a part. \param first  number of its first label in the whole
void addFootprints(const volume::SemanticVolume& from, std::uint32_t first, volume::SemanticVolume& to) {
    using Parts = volume::VectorParts;
    const Parts& faces = from.footprints;
    if (faces.triangles.empty()) return;
    Parts& all = to.footprints;
    const auto points = static_cast<std::uint32_t>(all.points.size());
    const double reach = double(1 << 30) * all.unit;
    for (std::uint32_t p = 0; p < faces.points.size(); ++p) {
        const Vec3d place = faces.position(p, from.grid.origin()) - to.grid.origin();
        Vec3i& point = all.points.emplace_back();
        for (int axis = 0; axis < 3; ++axis)
            point[axis] = static_cast<std::int32_t>(std::lround(std::clamp(place[axis], -reach, reach) / all.unit));
    }
    for (const Parts::Triangle& triangle : faces.triangles)
        all.triangles.push_back(
            {triangle.label + first,
             {triangle.corners[0] + points, triangle.corners[1] + points, triangle.corners[2] + points}});
}

// The unit in which the faces of all parts fit 31 bits.
double footprintUnit(const volume::Grid& grid) {
    const Vec3d size = scaled(toDouble(grid.dimension()), grid.spacing());
    double unit = volume::VectorParts::kFinestUnit;
    while (unit < volume::VectorParts::kCoarsestUnit && std::max(size.x, size.y) * 1.1 > unit * double(1 << 30))
        unit *= 2;
    return unit;
}

// One table of all labels, each id once below its parent, and the columns of each volume with its numbers.
volume::LabelTable unite(std::span<const volume::SemanticVolume> volumes, std::vector<ColumnVolume>& columns) {
    using Key = std::pair<std::string, std::string>;  // of a label without parent the second is empty
    const auto keyOf = [](const volume::LabelTable& table, const volume::Label& label) {
        return label.parent == volume::kNoLabel ? Key{label.id, {}} : Key{table.labels[label.parent].id, label.id};
    };
    std::map<Key, volume::Label> sorted;
    for (const volume::SemanticVolume& volume : volumes)
        for (const volume::Label& label : volume.labels.labels) {
            const auto [at, isNew] = sorted.emplace(keyOf(volume.labels, label), label);
            if (isNew) continue;
            volume::Label& own = at->second;
            const double sum = own.volume + label.volume;
            if (own.count == 0 && label.count > 0) own = label;
            own.volume = sum;
        }
    volume::LabelTable table;
    std::uint32_t root = 0;
    Scalar next = 1;
    for (auto& [key, label] : sorted) {
        const auto number = static_cast<std::uint32_t>(table.labels.size());
        if (key.second.empty()) root = number;
        label.parent = key.second.empty() ? volume::kNoLabel : root;
        label.first = label.count > 0 ? next : 0;
        next += label.count;
        label.subtreeEnd = number + 1;
        table.labels.push_back(label);
        table.labels[root].subtreeEnd = number + 1;
    }
    for (const volume::SemanticVolume& volume : volumes) {
        std::vector<Scalar> newOf(volume.labels.scalarCount(), 0);
        for (const volume::Label& label : volume.labels.labels)
            if (label.count > 0) newOf[label.first] = sorted.at(keyOf(volume.labels, label)).first;
        columns.push_back(volume::replaceScalars(volume.columns, newOf));
    }
    return table;
}

}  // namespace

Result<volume::SemanticVolume> joinVolumes(std::span<const volume::SemanticVolume> volumes, bool isByClass) {
    const volume::SemanticVolume& first = volumes.front();
    const Vec3d spacing = first.grid.spacing();
    std::vector<Part> parts;
    Vec3i low, high;
    volume::SemanticVolume result;
    Scalar before = 0;
    std::vector<ColumnVolume> united;
    if (isByClass) result.labels = unite(volumes, united);
    for (std::size_t n = 0; n < volumes.size(); ++n) {
        const volume::SemanticVolume& volume = volumes[n];
        Part part{isByClass ? &united[n] : &volume.columns, {}, before};
        for (int axis = 0; axis < 3; ++axis) {
            const double steps = (volume.grid.origin()[axis] - first.grid.origin()[axis]) / spacing[axis];
            if (!volume.grid.isAxisParallel() || volume.grid.spacing()[axis] != spacing[axis] ||
                std::abs(steps) > 1e8 || std::abs(steps - std::round(steps)) > 0.01)
                return Error(Code::BadArgument, "the tiles do not lie on one lattice");
            part.begin[axis] = static_cast<std::int32_t>(std::lround(steps));
            const std::int32_t end = part.begin[axis] + volume.grid.dimension()[axis];
            low[axis] = parts.empty() ? part.begin[axis] : std::min(low[axis], part.begin[axis]);
            high[axis] = parts.empty() ? end : std::max(high[axis], end);
        }
        parts.push_back(part);
        if (isByClass) continue;
        const Scalar scalars = volume.labels.scalarCount();
        if (scalars > volume::kMaxScalarCount - before)
            return Error(Code::TooManyLabels,
                         fmt::format("the parts have more than {} scalars; take fewer tiles", volume::kMaxScalarCount));
        appendLabels(result.labels, volume.labels, before);
        before += scalars - 1;
    }
    for (Part& part : parts) part.begin = part.begin - low;
    const Vec3d origin = first.grid.origin() + scaled(toDouble(low), spacing);
    const auto grid = volume::Grid::fromParts(high - low, spacing, origin, first.grid.axes());
    if (!grid) return Error(Code::GridTooLarge, grid.error().message() + "; take fewer tiles, or a coarser detail");
    result.grid = *grid;
    result.crsName = first.crsName;
    result.modelName = first.modelName;
    for (std::size_t n = 0; n < volumes.size(); ++n) addPlanes(volumes[n].planes, parts[n].begin, result.planes);
    result.footprints.unit = footprintUnit(result.grid);
    std::uint32_t firstLabel = 0;
    for (const volume::SemanticVolume& volume : volumes) {
        if (!isByClass) addFootprints(volume, firstLabel, result);
        firstLabel += static_cast<std::uint32_t>(volume.labels.labels.size());
    }
    SharedSamples shared;
    result.columns = Joiner(std::move(parts), high - low).run(shared);
    if (!isByClass) addOverlaps(shared, result.labels);
    const auto counts = result.columns.countVoxels(result.labels.scalarCount());
    for (volume::Label& label : result.labels.labels) {
        label.voxels = 0;
        for (Scalar s = 0; s < label.count; ++s) label.voxels += counts[label.first + s];
    }
    return result;
}

volume::VectorParts joinTriangles(std::span<const volume::SemanticVolume> volumes, const volume::Grid& grid) {
    volume::VectorParts joined;
    constexpr double kMostUnits = 1 << 30;  // points are 32-bit integers
    const Vec3i n = grid.dimension();
    const double extent = std::max({n.x, n.y, n.z}) * grid.spacing().x;
    for (const volume::SemanticVolume& tile : volumes) joined.unit = std::max(joined.unit, tile.vectors.unit);
    while (extent > kMostUnits * joined.unit) joined.unit *= 2;
    std::uint32_t labels = 0;
    for (const volume::SemanticVolume& tile : volumes) {
        const auto points = static_cast<std::uint32_t>(joined.points.size());
        for (std::uint32_t p = 0; p < tile.vectors.points.size(); ++p) {
            const Vec3d at = tile.vectors.position(p, tile.grid.origin() - grid.origin()) / joined.unit;
            joined.points.push_back({static_cast<std::int32_t>(std::lround(at.x)),
                                     static_cast<std::int32_t>(std::lround(at.y)),
                                     static_cast<std::int32_t>(std::lround(at.z))});
        }
        for (volume::VectorParts::Triangle triangle : tile.vectors.triangles) {
            triangle.label += labels;
            for (std::uint32_t& corner : triangle.corners) corner += points;
            joined.triangles.push_back(triangle);
        }
        labels += static_cast<std::uint32_t>(tile.labels.labels.size());
    }
    return joined;
}

}  // namespace svt::city
