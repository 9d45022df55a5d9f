#include <svt/analyze/merged_boxes.hpp>

#include <svt/volume/label_table.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace svt::analyze {
namespace {

using volume::Run;

// Voxels of one group in a row of columns: x [beginX, endX), z [beginZ, endZ).
struct Strip {
    std::int32_t beginX, beginZ, endZ;
    std::uint32_t group;
    std::int32_t endX = 0;
    [[nodiscard]] auto key() const noexcept { return std::tie(beginX, beginZ, endX, endZ, group); }
};

// The intervals of a column that are of a group, bottom up; neighbours of one group are one.
void readIntervals(std::span<const Run> runs, std::span<const std::uint32_t> groupOfScalar, std::vector<Strip>& out) {
    out.clear();
    std::uint32_t begin = 0;
    for (const Run& run : runs) {
        const std::uint32_t group = groupOfScalar[run.scalar];
        const auto from = static_cast<std::int32_t>(begin), to = static_cast<std::int32_t>(run.end);
        if (group != volume::kNoLabel) {
            if (!out.empty() && out.back().endZ == from && out.back().group == group)
                out.back().endZ = to;
            else
                out.push_back({0, from, to, group});
        }
        begin = run.end;
    }
}

class BoxMerger {
public:
    BoxMerger(const volume::ColumnVolume& columns, std::span<const std::uint32_t> groupOfScalar, std::size_t maxBoxes)
        : columns_(columns), groupOfScalar_(groupOfScalar), maxBoxes_(maxBoxes) {}

    bool run() {
        const Vec3i size = columns_.dimension();
        for (std::int32_t j = 0; j < size.y; ++j) {
            if (j > 0 && isRepeated(j)) continue;
            readRow(j);
            if (!growOrClose(j)) return false;
        }
        row_.clear();
        return growOrClose(size.y);
    }

    std::vector<GroupBox> take() {
        std::sort(boxes_.begin(), boxes_.end(), [](const GroupBox& a, const GroupBox& b) {
            return std::tie(a.group, a.box.begin.z, a.box.begin.y, a.box.begin.x) <
                   std::tie(b.group, b.box.begin.z, b.box.begin.y, b.box.begin.x);
        });
        return std::move(boxes_);
    }

private:
    // Rows that a tile stores once are equal; this is what most rows of a building are.
    [[nodiscard]] bool isRepeated(std::int32_t j) const {
        constexpr std::int32_t kTile = volume::ColumnVolume::kTileSize;
        if (j % kTile == 0) return false;
        for (std::int32_t x = 0; x < columns_.tilesX(); ++x) {
            const volume::ColumnTile& tile =
                columns_.tiles()[static_cast<std::size_t>(x + columns_.tilesX() * (j / kTile))];
            const auto row = static_cast<std::size_t>(j % kTile);
            if (tile.rowOf[row] != tile.rowOf[row - 1]) return false;
        }
        return true;
    }

    void readRow(std::int32_t j) {
        row_.clear();
        open_.clear();
        const std::int32_t width = columns_.dimension().x;
        std::span<const Run> before;
        for (std::int32_t i = 0; i < width; ++i) {
            const std::span<const Run> runs = columns_.column(i, j);
            if (runs.data() == before.data()) continue;
            before = runs;
            readIntervals(runs, groupOfScalar_, intervals_);
            joinColumn(i);
        }
        for (Strip& strip : open_) close(strip, width);
        std::sort(row_.begin(), row_.end(), [](const Strip& a, const Strip& b) { return a.key() < b.key(); });
    }

    // Both lists are bottom up: an open strip continues if the column has the same interval.
    void joinColumn(std::int32_t i) {
        next_.clear();
        std::size_t at = 0;
        for (Strip interval : intervals_) {
            while (at < open_.size() && open_[at].beginZ < interval.beginZ) close(open_[at++], i);
            interval.beginX = i;
            if (at < open_.size() && open_[at].beginZ == interval.beginZ) {
                if (open_[at].endZ == interval.endZ && open_[at].group == interval.group)
                    interval.beginX = open_[at].beginX;
                else
                    close(open_[at], i);
                ++at;
            }
            next_.push_back(interval);
        }
        while (at < open_.size()) close(open_[at++], i);
        open_.swap(next_);
    }

    void close(Strip strip, std::int32_t endX) {
        strip.endX = endX;
        row_.push_back(strip);
    }

    // Boxes grow where row j has the same strip; the others end before it.
    bool growOrClose(std::int32_t j) {
        std::vector<std::pair<Strip, std::int32_t>> grown;
        grown.reserve(row_.size());
        std::size_t at = 0;
        for (const Strip& strip : row_) {
            while (at < growing_.size() && growing_[at].first.key() < strip.key()) addBox(growing_[at++], j);
            const bool isSame = at < growing_.size() && growing_[at].first.key() == strip.key();
            grown.emplace_back(strip, isSame ? growing_[at++].second : j);
        }
        while (at < growing_.size()) addBox(growing_[at++], j);
        growing_ = std::move(grown);
        return boxes_.size() + growing_.size() <= maxBoxes_;
    }

    void addBox(const std::pair<Strip, std::int32_t>& grown, std::int32_t endY) {
        const auto& [strip, beginY] = grown;
        boxes_.push_back({strip.group, {{strip.beginX, beginY, strip.beginZ}, {strip.endX, endY, strip.endZ}}});
    }

    const volume::ColumnVolume& columns_;
    std::span<const std::uint32_t> groupOfScalar_;
    std::size_t maxBoxes_;
    std::vector<Strip> intervals_, open_, next_, row_;
    std::vector<std::pair<Strip, std::int32_t>> growing_;  // with the row in which they began
    std::vector<GroupBox> boxes_;
};

}  // namespace

Result<std::vector<GroupBox>> mergeBoxes(const volume::ColumnVolume& columns,
                                         std::span<const std::uint32_t> groupOfScalar, std::size_t maxBoxes) {
    BoxMerger merger(columns, groupOfScalar, maxBoxes);
    if (!merger.run())
        return Error(Code::BadArgument,
                     fmt::format("the volume makes more than {} boxes; make it coarser by --level 1, take a part of it "
                                 "by --select or --box, or give --max-boxes",
                                 maxBoxes));
    return merger.take();
}

}  // namespace svt::analyze
