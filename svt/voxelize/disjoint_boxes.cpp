#include <svt/voxelize/disjoint_boxes.hpp>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace svt::voxelize {
namespace {

// A voxel of a row, in the order of x, then z.
constexpr std::uint32_t packVoxel(std::int32_t i, std::int32_t k) noexcept {
    return static_cast<std::uint32_t>(i) << 16 | static_cast<std::uint32_t>(k);
}

auto rowOrder(const ClaimedBox& box) noexcept { return std::tie(box.low, box.high, box.begin, box.end); }

class RowJoiner {
public:
    explicit RowJoiner(std::vector<ClaimedBox>& disjoint) : disjoint_(disjoint) {}

    // The next row, from `boxes` that may overlap. Returns its count of voxels.
    std::uint64_t addRow(std::span<const ClaimedBox> boxes) {
        if (boxes.size() == 1) {
            row_.assign(1, boxes.front());
        } else {
            makeRuns(boxes);
            joinRuns();
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
    // Runs along z, one voxel wide, in row_.
    void makeRuns(std::span<const ClaimedBox> boxes) {
        voxels_.clear();
        for (const ClaimedBox& box : boxes)
            for (std::int32_t i = box.begin; i < box.end; ++i)
                for (std::int32_t k = box.low; k < box.high; ++k) voxels_.push_back(packVoxel(i, k));
        std::sort(voxels_.begin(), voxels_.end());
        voxels_.erase(std::unique(voxels_.begin(), voxels_.end()), voxels_.end());
        row_.clear();
        for (std::size_t v = 0; v < voxels_.size(); ++v) {
            if (v > 0 && voxels_[v] == voxels_[v - 1] + 1 && voxels_[v] >> 16 == voxels_[v - 1] >> 16) {
                ++row_.back().high;
                continue;
            }
            const auto i = static_cast<std::int32_t>(voxels_[v] >> 16);
            const auto k = static_cast<std::int32_t>(voxels_[v] & 0xFFFFu);
            row_.push_back({boxes.front().firstRow, boxes.front().endRow, i, i + 1, k, k + 1, boxes.front().claim});
        }
    }

    // Equal runs side by side become one box.
    void joinRuns() {
        std::sort(row_.begin(), row_.end(),
                  [](const ClaimedBox& p, const ClaimedBox& q) { return rowOrder(p) < rowOrder(q); });
        std::size_t kept = 0;
        for (std::size_t r = 1; r < row_.size(); ++r) {
            if (row_[kept].low == row_[r].low && row_[kept].high == row_[r].high && row_[kept].end == row_[r].begin)
                row_[kept].end = row_[r].end;
            else
                row_[++kept] = row_[r];
        }
        row_.resize(kept + 1);
    }

    std::vector<ClaimedBox>& disjoint_;
    std::vector<std::size_t> previous_, current_;  // boxes that reach the row before, and this one; by rowOrder
    std::vector<std::uint32_t> voxels_;
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
