#include <svt/analyze/gaps.hpp>

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <tuple>
#include <unordered_map>

namespace svt::analyze {
namespace {

constexpr std::uint32_t kOutside = 0;

// Union-find; the smaller number becomes the root, so all that is joined with the outside is kOutside.
class Pieces {
public:
    [[nodiscard]] std::uint32_t rootOf(std::uint32_t piece) noexcept {
        while (parent_[piece] != piece) piece = parent_[piece] = parent_[parent_[piece]];
        return piece;
    }
    std::uint32_t add() {
        parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
        return parent_.back();
    }
    void join(std::uint32_t a, std::uint32_t b) noexcept {
        a = rootOf(a);
        b = rootOf(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }
    [[nodiscard]] std::size_t size() const noexcept { return parent_.size(); }

private:
    std::vector<std::uint32_t> parent_{kOutside};
};

// A run of background.
struct AirRun {
    std::uint32_t begin = 0, end = 0, piece = 0;
};

// The background of a row of columns.
struct AirRow {
    std::vector<AirRun> runs;
    std::vector<std::size_t> start;  // first run of each column, and the end
    [[nodiscard]] std::span<AirRun> column(std::size_t i) {
        return std::span(runs).subspan(start[i], start[i + 1] - start[i]);
    }
};

// Joins runs of adjacent columns that share a face; runs of `own` without a piece get that of a neighbour.
void joinWith(std::span<AirRun> own, std::span<const AirRun> neighbors, Pieces& pieces) {
    for (std::size_t a = 0, b = 0; a < own.size() && b < neighbors.size();) {
        if (own[a].begin < neighbors[b].end && neighbors[b].begin < own[a].end) {
            if (own[a].piece == volume::kNoLabel)
                own[a].piece = neighbors[b].piece;
            else
                pieces.join(own[a].piece, neighbors[b].piece);
        }
        if (own[a].end < neighbors[b].end)
            ++a;
        else
            ++b;
    }
}

// Connected component labelling, row by row: calls visit(i, j, run) for each run of background, with a provisional
// number of its piece. Two sweeps give the same numbers.
template <class Visit>
Pieces sweep(const volume::ColumnVolume& columns, std::span<const std::uint32_t> labelOf, const Visit& visit) {
    const Vec3i n = columns.dimension();
    const auto top = static_cast<std::uint32_t>(n.z);
    Pieces pieces;
    AirRow row, below;
    for (std::int32_t j = 0; j < n.y; ++j) {
        std::swap(row, below);
        row.runs.clear();
        row.start.assign(1, 0);
        for (std::int32_t i = 0; i < n.x; ++i) {
            const auto first = static_cast<std::ptrdiff_t>(row.runs.size());
            std::uint32_t begin = 0;
            for (const volume::Run& run : columns.column(i, j)) {
                if (labelOf[run.scalar] == volume::kNoLabel) {
                    if (!row.runs.empty() && std::ssize(row.runs) > first && row.runs.back().end == begin)
                        row.runs.back().end = run.end;
                    else
                        row.runs.push_back({begin, run.end, volume::kNoLabel});
                }
                begin = run.end;
            }
            row.start.push_back(row.runs.size());
            const std::span<AirRun> own = row.column(std::size_t(i));
            if (i > 0) joinWith(own, row.column(std::size_t(i) - 1), pieces);
            if (j > 0) joinWith(own, below.column(std::size_t(i)), pieces);
            const bool isBorder = i == 0 || j == 0 || i == n.x - 1 || j == n.y - 1;
            for (AirRun& run : own) {
                const bool isOpen = isBorder || run.begin == 0 || run.end == top;
                if (run.piece == volume::kNoLabel)
                    run.piece = isOpen ? kOutside : pieces.add();
                else if (isOpen)
                    pieces.join(run.piece, kOutside);
                visit(i, j, run);
            }
        }
    }
    return pieces;
}

// Adds the labels of the column's runs that overlap [begin, end).
void addLabels(std::span<const volume::Run> runs, std::uint32_t begin, std::uint32_t end,
               std::span<const std::uint32_t> labelOf, std::set<std::uint32_t>& labels) {
    auto run = std::upper_bound(runs.begin(), runs.end(), begin,
                                [](std::uint32_t k, const volume::Run& candidate) { return k < candidate.end; });
    for (std::uint32_t from = begin; run != runs.end() && from < end; from = run->end, ++run)
        if (labelOf[run->scalar] != volume::kNoLabel) labels.insert(labelOf[run->scalar]);
}

}  // namespace

std::vector<Gap> findGaps(const volume::ColumnVolume& columns, const volume::LabelTable& labels) {
    const std::vector<std::uint32_t> labelOf = labels.labelOfScalar();
    Pieces pieces = sweep(columns, labelOf, [](std::int32_t, std::int32_t, const AirRun&) {});
    std::vector<Gap> gaps;
    std::unordered_map<std::uint32_t, std::size_t> gapOf;  // by root
    std::vector<std::set<std::uint32_t>> around;
    // A second sweep, since the neighbours of a gap can only be collected once it is known to be enclosed.
    (void)sweep(columns, labelOf, [&](std::int32_t i, std::int32_t j, const AirRun& run) {
        const std::uint32_t root = pieces.rootOf(run.piece);
        if (root == kOutside) return;
        const auto [found, isNew] = gapOf.try_emplace(root, gaps.size());
        if (isNew) {
            gaps.emplace_back();
            around.emplace_back();
        }
        Gap& gap = gaps[found->second];
        gap.voxels += run.end - run.begin;
        gap.box.add({{i, j, std::int32_t(run.begin)}, {i, j, std::int32_t(run.end) - 1}});
        // An enclosed run touches no border, so it has neighbours on all sides.
        addLabels(columns.column(i, j), run.begin - 1, run.end + 1, labelOf, around[found->second]);
        for (const auto& [x, y] : {std::pair{i - 1, j}, {i + 1, j}, {i, j - 1}, {i, j + 1}})
            addLabels(columns.column(x, y), run.begin, run.end, labelOf, around[found->second]);
    });
    for (std::size_t g = 0; g < gaps.size(); ++g) gaps[g].around.assign(around[g].begin(), around[g].end());
    std::sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) {
        if (a.voxels != b.voxels) return a.voxels > b.voxels;
        const auto placeOf = [](const Gap& gap) {
            return std::tuple(gap.box.min.z, gap.box.min.y, gap.box.min.x, gap.box.max.z, gap.box.max.y, gap.box.max.x);
        };
        return placeOf(a) < placeOf(b);
    });
    return gaps;
}

}  // namespace svt::analyze
