#include <svt/analyze/contacts/air_pieces.hpp>
#include <svt/analyze/gaps.hpp>

#include <algorithm>
#include <set>
#include <span>
#include <tuple>
#include <unordered_map>

namespace svt::analyze {
namespace {

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
    Pieces pieces = sweepAir(columns, labelOf, [](std::int32_t, std::int32_t, const AirRun&) {});
    std::vector<Gap> gaps;
    std::unordered_map<std::uint32_t, std::size_t> gapOf;  // by root
    std::vector<std::set<std::uint32_t>> around;
    // A second sweep, since the neighbours of a gap can only be collected once it is known to be enclosed.
    (void)sweepAir(columns, labelOf, [&](std::int32_t i, std::int32_t j, const AirRun& run) {
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
