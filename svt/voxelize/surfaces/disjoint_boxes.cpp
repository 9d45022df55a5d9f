#include <svt/voxelize/surfaces/disjoint_boxes.hpp>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace svt::voxelize {
namespace {

// Three numbers below 2^20 in one sort key. Grid coordinates fit, since a dimension is at most 65535.
constexpr std::uint64_t pack(std::int32_t first, std::int32_t second, std::int32_t third) noexcept {
    return static_cast<std::uint64_t>(first) << 40 | static_cast<std::uint64_t>(second) << 20 |
           static_cast<std::uint64_t>(third);
}
constexpr std::int32_t unpack(std::uint64_t packed, int number) noexcept {
    return static_cast<std::int32_t>(packed >> (40 - 20 * number) & 0xFFFFFu);
}

auto rowOrder(const ClaimedBox& box) noexcept { return std::tie(box.low, box.high, box.begin, box.end); }

class RowJoiner {
public:
    explicit RowJoiner(std::vector<ClaimedBox>& disjoint) : disjoint_(disjoint) {}

    // Adds the next row, given by `boxes` that may overlap. Returns its count of voxels.
    std::uint64_t addRow(std::span<const ClaimedBox> boxes) {
        if (boxes.size() == 1) {
            row_.assign(1, boxes.front());
        } else {
            makeRuns(boxes);
            joinRuns(boxes.front());
        }
        std::uint64_t voxels = 0;
        std::size_t match = 0;
        current_.clear();
        for (const ClaimedBox& box : row_) {
            voxels += std::uint64_t(box.end - box.begin) * std::uint64_t(box.high - box.low);
            while (match < previous_.size() && rowOrder(disjoint_[previous_[match]]) < rowOrder(box)) ++match;
            if (match < previous_.size() && rowOrder(disjoint_[previous_[match]]) == rowOrder(box) &&
                disjoint_[previous_[match]].endRow == box.firstRow) {
                current_.push_back(previous_[match]);
                ++disjoint_[previous_[match]].endRow;
            } else {
                current_.push_back(disjoint_.size());
                disjoint_.push_back(box);
            }
        }
        std::swap(previous_, current_);
        return voxels;
    }

private:
    // Merges the boxes into disjoint runs along z, one voxel wide, packed as (low, high, i).
    void makeRuns(std::span<const ClaimedBox> boxes) {
        parts_.clear();
        for (const ClaimedBox& box : boxes)
            for (std::int32_t i = box.begin; i < box.end; ++i) parts_.push_back(pack(i, box.low, box.high));
        std::sort(parts_.begin(), parts_.end());
        runs_.clear();
        for (std::size_t p = 0; p < parts_.size();) {
            const std::int32_t i = unpack(parts_[p], 0), low = unpack(parts_[p], 1);
            std::int32_t high = unpack(parts_[p], 2);
            for (++p; p < parts_.size() && unpack(parts_[p], 0) == i && unpack(parts_[p], 1) <= high; ++p)
                high = std::max(high, unpack(parts_[p], 2));
            runs_.push_back(pack(low, high, i));
        }
    }

    // Merges equal adjacent runs into boxes; row and claim are those of `like`.
    void joinRuns(const ClaimedBox& like) {
        std::sort(runs_.begin(), runs_.end());
        row_.clear();
        for (const std::uint64_t run : runs_) {
            const std::int32_t low = unpack(run, 0), high = unpack(run, 1), i = unpack(run, 2);
            if (!row_.empty() && row_.back().low == low && row_.back().high == high && row_.back().end == i)
                ++row_.back().end;
            else
                row_.push_back({like.firstRow, like.endRow, i, i + 1, low, high, like.claim, like.countsAgainst});
        }
    }

    std::vector<ClaimedBox>& disjoint_;
    std::vector<std::size_t> previous_, current_;  // boxes that end at the row before and at this row, by rowOrder
    std::vector<std::uint64_t> parts_, runs_;
    std::vector<ClaimedBox> row_;
};

}  // namespace

std::uint64_t addDisjoint(std::span<const ClaimedBox> boxes, std::vector<ClaimedBox>& disjoint) {
    if (boxes.empty()) return 0;
    const auto byRow = [](const ClaimedBox& p, const ClaimedBox& q) { return p.firstRow < q.firstRow; };
    const auto [south, north] = std::minmax_element(boxes.begin(), boxes.end(), byRow);
    const std::int32_t firstRow = south->firstRow;
    std::vector<std::size_t> end(static_cast<std::size_t>(north->firstRow - firstRow) + 1, 0);
    const auto numberOf = [&](const ClaimedBox& box) { return static_cast<std::size_t>(box.firstRow - firstRow); };
    for (const ClaimedBox& box : boxes) ++end[numberOf(box)];
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<ClaimedBox> sorted(boxes.size());
    for (std::size_t b = boxes.size(); b > 0; --b) sorted[--end[numberOf(boxes[b - 1])]] = boxes[b - 1];

    RowJoiner joiner(disjoint);
    std::uint64_t voxels = 0;
    for (std::size_t row = 0; row < end.size(); ++row) {
        const std::size_t next = row + 1 < end.size() ? end[row + 1] : sorted.size();
        if (next > end[row]) voxels += joiner.addRow(std::span(sorted).subspan(end[row], next - end[row]));
    }
    return voxels;
}

}  // namespace svt::voxelize
