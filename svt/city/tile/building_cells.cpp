// Detail 1 of a tile: buildings and their classes in cells of 2 x 2 x 2 samples.
#include <svt/city/tile/tile_builder.hpp>
#include <svt/core/parallel.hpp>
#include <svt/volume/volume_part.hpp>

#include <algorithm>

namespace svt::city {
namespace {

using volume::ColumnTileBuilder;
using volume::ColumnTileData;
using volume::ColumnVolume;
using volume::Label;
using volume::Run;
using volume::Scalar;

// The table of detail 1, and the scalar in it for each scalar of detail 0. Scalar 0 is background.
struct Parts {
    volume::LabelTable table;
    std::vector<Scalar> partOf;  // by scalar of detail 0
    std::vector<Scalar> bodyOf;  // by scalar of the table: that of its building
};

// \param at  a root; its classes follow it in the order of their first label
void addBuilding(const volume::LabelTable& from, std::uint32_t at, Parts& parts) {
    std::vector<Label>& labels = parts.table.labels;
    const auto root = static_cast<std::uint32_t>(labels.size());
    const auto add = [&](const Label& label) {
        Label& own = labels.emplace_back();
        own.className = label.className;
        own.color = label.color;
        own.first = static_cast<Scalar>(labels.size());
        own.count = 1;
        parts.bodyOf.push_back(root + 1);
        return static_cast<Scalar>(labels.size());
    };
    add(from.labels[at]);
    labels[root].id = from.labels[at].id;
    labels[root].name = from.labels[at].name;
    labels[root].filling = volume::Filling::Solid;
    for (std::uint32_t l = at; l < from.labels[at].subtreeEnd; ++l) {
        const Label& label = from.labels[l];
        if (label.count == 0) continue;
        const auto known = std::find_if(labels.begin() + root, labels.end(),
                                        [&](const Label& own) { return own.className == label.className; });
        const Scalar part = known != labels.end() ? known->first : add(label);
        for (Scalar s = 0; s < label.count; ++s) parts.partOf[label.first + s] = part;
    }
    labels[root].subtreeEnd = static_cast<std::uint32_t>(labels.size());
    for (std::uint32_t l = root + 1; l < labels.size(); ++l) {
        labels[l].parent = root;
        labels[l].subtreeEnd = l + 1;
        labels[l].filling = volume::Filling::Body;
    }
}

Parts partsOf(const volume::LabelTable& from) {
    Parts parts;
    parts.partOf.assign(from.scalarCount(), 0);
    parts.bodyOf.push_back(0);
    for (std::uint32_t l = 0; l < from.labels.size(); ++l)
        if (from.labels[l].parent == volume::kNoLabel) addBuilding(from, l, parts);
    return parts;
}

// The dominant scalar of a cell's 8 samples.
class Cell {
public:
    explicit Cell(const std::vector<Scalar>& bodyOf) : bodyOf_(bodyOf) {}

    void clear() { count_ = 0; }
    void add(Scalar part, int samples) {
        if (part == 0) return;
        for (std::size_t n = 0; n < count_; ++n)
            if (seen_[n].part == part) {
                seen_[n].samples += samples;
                return;
            }
        seen_[count_++] = {part, samples};
    }
    [[nodiscard]] Scalar shown() const {
        const auto samplesOf = [&](Scalar body) {
            int sum = 0;
            for (std::size_t n = 0; n < count_; ++n)
                if (bodyOf_[seen_[n].part] == body) sum += seen_[n].samples;
            return sum;
        };
        Scalar building = 0;
        int most = 0;
        for (std::size_t n = 0; n < count_; ++n) {
            const Scalar own = bodyOf_[seen_[n].part];
            const int samples = samplesOf(own);
            if (samples < most || (samples == most && own >= building)) continue;
            most = samples;
            building = own;
        }
        Scalar shown = building;
        most = 0;
        for (std::size_t n = 0; n < count_; ++n) {
            const auto& [part, samples] = seen_[n];
            if (bodyOf_[part] != building || part == building) continue;
            if (samples < most || (samples == most && part >= shown)) continue;
            most = samples;
            shown = part;
        }
        return shown;
    }

private:
    struct Seen {
        Scalar part = 0;
        int samples = 0;
    };
    const std::vector<Scalar>& bodyOf_;
    std::array<Seen, 8> seen_{};
    std::size_t count_ = 0;
};

class CellColumns {
public:
    CellColumns(const ColumnVolume& fine, const Parts& parts) : fine_(fine), parts_(parts) {
        const Vec3i n = fine.dimension();
        for (int axis = 0; axis < 3; ++axis) dimension_[axis] = (n[axis] + 1) / 2;
    }

    [[nodiscard]] ColumnVolume run(int threads) const {
        constexpr std::int32_t kSize = ColumnVolume::kTileSize;
        const auto across = static_cast<std::size_t>((dimension_.x + kSize - 1) / kSize);
        const auto along = static_cast<std::size_t>((dimension_.y + kSize - 1) / kSize);
        std::vector<ColumnTileData> tiles(across * along);
        parallelFor(tiles.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
            std::vector<Run> runs;
            for (std::size_t n = begin; n < end; ++n) {
                const auto i = static_cast<std::int32_t>(n % across) * kSize;
                const auto j = static_cast<std::int32_t>(n / across) * kSize;
                const std::int32_t width = std::min(kSize, dimension_.x - i);
                ColumnTileBuilder builder(width);
                std::vector<std::uint16_t> row(static_cast<std::size_t>(width));
                for (std::int32_t y = j; y < std::min(j + kSize, dimension_.y); ++y) {
                    for (std::int32_t x = 0; x < width; ++x) {
                        column(i + x, y, runs);
                        row[std::size_t(x)] = builder.addColumn(runs);
                    }
                    builder.addRow(row);
                }
                tiles[n] = builder.finish();
            }
        });
        return ColumnVolume::fromTiles(dimension_, std::move(tiles));
    }

private:
    struct Walk {
        std::span<const Run> runs;
        std::size_t at = 0;
        // The scalar of sample z, and where its run ends. z never decreases.
        [[nodiscard]] const Run& runAt(std::uint32_t z) {
            while (runs[at].end <= z) ++at;
            return runs[at];
        }
    };

    void column(std::int32_t i, std::int32_t j, std::vector<Run>& runs) const {
        const Vec3i n = fine_.dimension();
        std::array<Walk, 4> walks;
        std::size_t count = 0;
        bool isEmpty = true;
        for (std::int32_t y = 2 * j; y < std::min(2 * j + 2, n.y); ++y)
            for (std::int32_t x = 2 * i; x < std::min(2 * i + 2, n.x); ++x) {
                walks[count].runs = fine_.column(x, y);
                isEmpty = isEmpty && walks[count].runs.size() == 1 && walks[count].runs[0].scalar == 0;
                ++count;
            }
        const auto height = static_cast<std::uint32_t>(dimension_.z), top = static_cast<std::uint32_t>(n.z);
        runs.clear();
        if (isEmpty) {
            runs.push_back({height, 0});
            return;
        }
        Cell cell(parts_.bodyOf);
        for (std::uint32_t k = 0; k < height;) {
            cell.clear();
            std::uint32_t same = top;  // up to here, no column changes
            for (std::size_t c = 0; c < count; ++c) {
                const Run& low = walks[c].runAt(2 * k);
                same = std::min(same, low.end);
                const bool isWhole = low.end >= 2 * k + 2 || 2 * k + 1 >= top;
                cell.add(parts_.partOf[low.scalar], isWhole && 2 * k + 1 < top ? 2 : 1);
                if (!isWhole) cell.add(parts_.partOf[walks[c].runAt(2 * k + 1).scalar], 1);
            }
            const std::uint32_t end = std::max(k + 1, same == top ? height : same / 2);
            const Scalar shown = cell.shown();
            if (!runs.empty() && runs.back().scalar == shown)
                runs.back().end = end;
            else
                runs.push_back({end, shown});
            k = end;
        }
    }

    const ColumnVolume& fine_;
    const Parts& parts_;
    Vec3i dimension_{};
};

// Leaves out classes of buildings that fill no cell. \return new scalars
std::vector<Scalar> dropEmpty(const std::vector<std::uint64_t>& counts, volume::LabelTable& table) {
    std::vector<Scalar> newOf(counts.size(), 0);
    std::vector<Label> kept;
    std::uint32_t root = 0;
    for (Label& label : table.labels) {
        const bool isRoot = label.parent == volume::kNoLabel;
        if (!isRoot && counts[label.first] == 0) continue;
        const auto number = static_cast<std::uint32_t>(kept.size());
        if (isRoot) root = number;
        newOf[label.first] = number + 1;
        label.voxels = counts[label.first];
        label.first = number + 1;
        label.subtreeEnd = number + 1;
        if (!isRoot) label.parent = root;
        kept.push_back(std::move(label));
        kept[root].subtreeEnd = number + 1;
    }
    table.labels = std::move(kept);
    return newOf;
}

}  // namespace

Result<volume::SemanticVolume> buildingsOf(const volume::SemanticVolume& full, int threads) {
    Parts parts = partsOf(full.labels);
    volume::SemanticVolume result;
    const ColumnVolume columns = CellColumns(full.columns, parts).run(threads);
    const Vec3d step = full.grid.spacing();
    SVT_TRY(grid, volume::Grid::fromParts(columns.dimension(), step * 2.0, full.grid.worldFromIndex({0.5, 0.5, 0.5}),
                                          full.grid.axes()));
    result.grid = *grid;
    result.labels = std::move(parts.table);
    const auto counts = columns.countVoxels(result.labels.scalarCount());
    result.columns = volume::replaceScalars(columns, dropEmpty(counts, result.labels));
    result.crsName = full.crsName;
    result.modelName = full.modelName;
    // A building's volume is that of all its cells.
    std::vector<Label>& labels = result.labels.labels;
    for (Label& label : labels) label.volume = double(label.voxels) * result.grid.voxelVolume();
    for (const Label& label : labels)
        if (label.parent != volume::kNoLabel) labels[label.parent].volume += label.volume;
    return result;
}

}  // namespace svt::city
