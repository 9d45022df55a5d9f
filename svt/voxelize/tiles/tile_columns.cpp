#include <svt/voxelize/tiles/tile_columns.hpp>

#include <algorithm>
#include <bit>
#include <tuple>
#include <utility>

namespace svt::voxelize {
namespace {

constexpr int kColumnCacheBits = 10;
constexpr std::size_t kStride = 8;  // columns are written in blocks of this size

// Index of the lowest set bit above `bit`, or `end` if there is none.
std::int32_t nextBit(std::uint64_t bits, std::int32_t bit, std::int32_t end) noexcept {
    const std::uint64_t above = bit + 1 < 64 ? bits >> (bit + 1) << (bit + 1) : 0;
    return above != 0 ? std::countr_zero(above) : end;
}

}  // namespace

TileColumns::TileColumns(std::span<const PrioritizedClaim> claims, const HeightPlanes& heightPlanes)
    : heightPlanes_(heightPlanes), profiles_(claims), builder_(1), columnCache_(std::size_t{1} << kColumnCacheBits) {
    volume::Scalar most = 0;
    for (const PrioritizedClaim& claim : claims) most = std::max(most, claim.scalar);
    usedScalars_.assign(std::size_t{most} + 1, 0);
}

std::uint32_t TileColumns::findStack(const PlanInterval& interval) {
    const auto members = plan_.boundariesOf(interval);
    return stackIndex_.findOrAdd(
        interval.hash,
        [&](std::uint32_t number) {
            const BoundaryStack& known = stacks_[number];
            return known.hash == interval.hash && known.memberCount == members.size() &&
                   std::equal(members.begin(), members.end(), members_.begin() + known.firstMember);
        },
        [&] { return addStack(interval, members); });
}

std::uint32_t TileColumns::addStack(const PlanInterval& interval, std::span<const std::uint64_t> members) {
    BoundaryStack stack;
    stack.hash = interval.hash;
    stack.firstMember = static_cast<std::uint32_t>(members_.size());
    stack.memberCount = static_cast<std::uint32_t>(members.size());
    stack.firstHeightPlane = static_cast<std::uint32_t>(stackHeightPlanes_.size());
    stack.firstSloped = static_cast<std::uint32_t>(sloped_.size());
    stack.firstHeight = static_cast<std::uint32_t>(heights_.size());
    members_.insert(members_.end(), members.begin(), members.end());
    const std::size_t firstCode = stackCodes_.size();
    stackCodes_.resize(firstCode + members.size());
    // Sorted, so that boundaries of one height plane are adjacent and flat height planes come bottom up.
    ascending_.assign(members.begin(), members.end());
    std::sort(ascending_.begin(), ascending_.end());
    for (std::size_t m = 0; m < members.size(); ++m) {
        const Boundary boundary = Boundary::unpack(ascending_[m]);
        const bool isSameHeightPlane = m > 0 && boundary.heightPlane == stackHeightPlanes_.back().heightPlane;
        if (!isSameHeightPlane) {
            if (heightPlanes_.isSloped(boundary.heightPlane)) {
                const HeightPlane& heightPlane = heightPlanes_[boundary.heightPlane];
                stack.slopesX = stack.slopesX || heightPlane.slopeX != 0;
                stack.slopesY = stack.slopesY || heightPlane.slopeY != 0;
                sloped_.push_back({boundary.heightPlane, stack.heightPlaneCount, 0});
            }
            order_.push_back(stack.heightPlaneCount++);
            stackHeightPlanes_.push_back({boundary.heightPlane, static_cast<std::uint32_t>(firstCode + m), 0});
        }
        stackCodes_[firstCode + m] = ProfileCode{boundary.claim, boundary.isEntry, isSameHeightPlane}.packed();
        ++stackHeightPlanes_.back().codeCount;
    }
    stack.slopedCount = static_cast<std::uint32_t>(sloped_.size()) - stack.firstSloped;
    heights_.resize(heights_.size() + stack.heightPlaneCount + 2, 0);
    heights_.back() = heightPlanes_.depth;
    stacks_.push_back(stack);
    return static_cast<std::uint32_t>(stacks_.size() - 1);
}

// Sorts the height planes of the stack by height and finds the profile of this order. The order of equal heights does
// not matter, since the interval between them is empty.
void TileColumns::sortHeightPlanes(BoundaryStack& stack) {
    std::uint32_t* const order = order_.data() + stack.firstHeightPlane;
    std::int32_t* const heights = heights_.data() + stack.firstHeight + 1;
    const std::uint32_t count = stack.heightPlaneCount;
    constexpr std::uint32_t kShort = 32;
    if (count > kShort) {
        sorted_.clear();
        for (std::uint32_t c = 0; c < count; ++c) sorted_.emplace_back(heights[c], order[c]);
        std::sort(sorted_.begin(), sorted_.end());
        for (std::uint32_t c = 0; c < count; ++c) std::tie(heights[c], order[c]) = sorted_[c];
    } else {
        for (std::uint32_t c = 1; c < count; ++c) {
            const std::uint32_t slot = order[c];
            const std::int32_t height = heights[c];
            std::uint32_t to = c;
            for (; to > 0 && heights[to - 1] > height; --to) {
                order[to] = order[to - 1];
                heights[to] = heights[to - 1];
            }
            order[to] = slot;
            heights[to] = height;
        }
    }
    codes_.resize(stack.memberCount);
    places_.resize(count);
    std::uint32_t* code = codes_.data();
    for (std::uint32_t c = 0; c < count; ++c) {
        const StackHeightPlane& heightPlane = stackHeightPlanes_[stack.firstHeightPlane + order[c]];
        code = std::copy_n(stackCodes_.data() + heightPlane.firstCode, heightPlane.codeCount, code);
        places_[order[c]] = stack.firstHeight + 1 + c;
    }
    for (SlopedHeightPlane& sloped : std::span(sloped_).subspan(stack.firstSloped, stack.slopedCount))
        sloped.height = places_[sloped.slot];
    stack.profile = profiles_.find(codes_);
}

// Computes all heights of the stack at column (i, j) and sorts them.
void TileColumns::computeHeights(BoundaryStack& stack, std::int32_t i, std::int32_t j) {
    for (std::uint32_t c = 0; c < stack.heightPlaneCount; ++c) {
        const std::uint32_t heightPlane = stackHeightPlanes_[stack.firstHeightPlane + c].heightPlane;
        heights_[stack.firstHeight + 1 + c] = heightPlanes_.isSloped(heightPlane)
                                                  ? heightPlanes_[heightPlane].sampleAbove(i, j)
                                                  : static_cast<std::int32_t>(heightPlane);
    }
    sortHeightPlanes(stack);
    stack.isOrdered = true;
}

// Sets the heights of the sloped height planes to those of a step of a line; sorts again if they no longer ascend.
// `heights`: those of the step, with stride kTile.
void TileColumns::setSlopedHeights(BoundaryStack& stack, const std::int32_t* heights) {
    const auto sloped = std::span(sloped_).subspan(stack.firstSloped, stack.slopedCount);
    for (const SlopedHeightPlane& heightPlane : sloped) {
        heights_[heightPlane.height] = *heights;
        heights += kTile;
    }
    bool ascends = true;
    for (const SlopedHeightPlane& heightPlane : sloped) {
        const std::int32_t* height = heights_.data() + heightPlane.height;
        ascends = ascends && height[-1] <= height[0] && height[0] <= height[1];
    }
    if (!ascends) sortHeightPlanes(stack);
}

// Counts the voxels shared by solids in `columns` columns with the current heights of the stack.
void TileColumns::countShared(const BoundaryStack& stack, std::uint64_t columns) {
    profiles_.forEachShared(
        stack.profile, heights_.data() + stack.firstHeight + 1,
        [&](std::uint32_t group, std::uint32_t length) { profiles_.addShared(group, columns * length); });
}

// Stores the shared voxels per column in a cache entry instead; returns false if it has too few places.
bool TileColumns::cacheShared(const BoundaryStack& stack, ColumnCacheEntry& known) const {
    std::size_t count = 0;
    profiles_.forEachShared(stack.profile, heights_.data() + stack.firstHeight + 1,
                            [&](std::uint32_t group, std::uint32_t length) {
                                if (count < ColumnCacheEntry::kMaxShared) known.shared[count] = {group, length};
                                ++count;
                            });
    known.sharedCount = static_cast<std::uint8_t>(std::min(count, ColumnCacheEntry::kMaxShared));
    return count <= ColumnCacheEntry::kMaxShared;
}

// Makes the column with the current heights of the stack and returns its number.
std::uint16_t TileColumns::makeColumn(const BoundaryStack& stack) {
    const std::int32_t* const heights = heights_.data() + stack.firstHeight + 1;
    volume::Run* const first = builder_.beginColumn(std::size_t(stack.heightPlaneCount) + 1);
    volume::Run* end = first;
    std::uint32_t from = 0;
    const auto emit = [&](std::uint32_t to, volume::Scalar scalar) {
        if (to == from) return;
        if (end != first && end[-1].scalar == scalar)
            end[-1].end = to;
        else
            *end++ = {to, scalar};
        from = to;
    };
    for (const ScalarChange& change : profiles_.changes(stack.profile))
        emit(static_cast<std::uint32_t>(heights[change.heightPlane]), change.below);
    emit(static_cast<std::uint32_t>(heightPlanes_.depth), profiles_.topScalar(stack.profile));
    return builder_.endColumn(static_cast<std::size_t>(end - first));
}

// Computes the heights along a line into lines_, from index `place` on. Returns the breaks: bit n is set if some height
// of step n differs from that of step n - 1, and bit 0 always.
std::uint64_t TileColumns::computeLineHeights(const Interval& interval, const Line& line, std::uint32_t place) {
    const BoundaryStack& stack = stacks_[interval.stack];
    const std::size_t needed = place + (std::size_t(stack.slopedCount) + 1) * kTile;
    if (lines_.size() < needed) lines_.resize(needed);
    lineHeightPlanes_.clear();
    for (const SlopedHeightPlane& sloped : std::span(sloped_).subspan(stack.firstSloped, stack.slopedCount)) {
        const HeightPlane& heightPlane = heightPlanes_[sloped.heightPlane];
        lineHeightPlanes_.push_back({heightPlane.base + heightPlane.slopeX * line.i + heightPlane.slopeY * line.j,
                                     line.isAlongX ? heightPlane.slopeX : heightPlane.slopeY, heightPlane.lowest,
                                     heightPlane.highest});
    }
    return heightsAlong(lineHeightPlanes_, line.count, interval.stack, lines_.data() + place) | 1;
}

// Number of the column at a step of the line at index `line`. The caller will use it for `columns` columns.
inline std::uint16_t TileColumns::columnAtStep(std::uint32_t number, std::uint32_t line, std::size_t step,
                                               std::uint64_t columns) {
    const std::int32_t* const hash = lines_.data() + line + step;
    const std::int32_t* const heights = hash + kTile;
    ColumnCacheEntry& known = columnCache_[static_cast<std::uint32_t>(*hash) >> (32 - kColumnCacheBits)];
    bool isKnown = known.stack == number && known.tile == tile_;
    const std::uint32_t slopedCount = stacks_[number].slopedCount;
    for (std::size_t s = 0; s < slopedCount && isKnown; ++s) isKnown = known.heights[s] == heights[s * kTile];
    if (!isKnown) return cacheColumn(number, heights, known, columns);
    known.columns += static_cast<std::uint32_t>(columns);
    return known.column;
}

// Cache miss: makes the column and stores it in the entry `known`, if it fits there.
std::uint16_t TileColumns::cacheColumn(std::uint32_t number, const std::int32_t* heights, ColumnCacheEntry& known,
                                       std::uint64_t columns) {
    BoundaryStack& stack = stacks_[number];
    flushSharedCounts(known);
    known.stack = kNoStack;
    setSlopedHeights(stack, heights);
    const std::uint16_t column = makeColumn(stack);
    if (stack.slopedCount <= ColumnCacheEntry::kMaxSloped && cacheShared(stack, known)) {
        known.stack = number;
        known.tile = tile_;
        known.column = column;
        known.columns = static_cast<std::uint32_t>(columns);
        for (std::size_t s = 0; s < stack.slopedCount; ++s) known.heights[s] = heights[s * kTile];
    } else {
        countShared(stack, columns);
    }
    return column;
}

// Writes the columns of an interval in row y to row_, unless they are those of the row before, which row_ still has.
// Rows [firstRow, endRow) have the same plan.
void TileColumns::makeInterval(const Interval& interval, std::int32_t y, std::int32_t firstRow, std::int32_t endRow) {
    BoundaryStack& stack = stacks_[interval.stack];
    if (!stack.isOrdered) computeHeights(stack, firstColumn_ + interval.begin, firstRow_ + y);
    std::uint16_t* const columns = row_.data() + interval.begin;
    const std::int32_t width = interval.end - interval.begin;
    const std::int32_t step = y - firstRow, rows = endRow - firstRow;
    if (!stack.slopesX && stack.slopesY) {
        if ((interval.breaks >> step & 1) == 0) return;
        const auto count = std::uint64_t(nextBit(interval.breaks, step, rows) - step) * std::uint64_t(width);
        std::fill_n(columns, width, columnAtStep(interval.stack, interval.line, static_cast<std::size_t>(step), count));
        return;
    }
    if (y != firstRow && !stack.slopesY) return;
    const auto count = static_cast<std::uint64_t>(stack.slopesY ? 1 : rows);
    if (!stack.slopesX) {
        countShared(stack, count * std::uint64_t(width));
        if (stack.tile != tile_) {
            stack.tile = tile_;
            stack.column = makeColumn(stack);
        }
        std::fill_n(columns, width, stack.column);
        return;
    }
    std::uint64_t breaks =
        computeLineHeights(interval, {firstColumn_ + interval.begin, firstRow_ + y, width, true}, interval.line);
    std::uint16_t beyond[kStride];
    std::copy_n(columns + width, kStride, beyond);
    while (breaks != 0) {
        const int x = std::countr_zero(breaks);
        breaks &= breaks - 1;
        const int next = breaks != 0 ? std::countr_zero(breaks) : width;
        const std::uint16_t column =
            columnAtStep(interval.stack, interval.line, static_cast<std::size_t>(x), count * std::uint64_t(next - x));
        // Writes whole blocks: a fixed-size copy avoids a mispredicted loop branch for short intervals. The excess is
        // overwritten by the next interval or restored below.
        std::uint16_t* to = columns + x;
        do {
            std::fill_n(to, kStride, column);
            to += kStride;
        } while (to < columns + next);
    }
    std::copy_n(beyond, kStride, columns + width);
}

// Makes the rows [firstRow, endRow), which have the same plan.
void TileColumns::makeRows(std::int32_t firstRow, std::int32_t endRow) {
    const PlanRowIntervals plan = plan_.layOut(firstRow);
    intervals_.resize(plan.intervals.size());
    std::uint64_t changedRows = std::uint64_t{1} << firstRow;
    std::uint32_t line = 0;
    for (std::size_t c = 0; c < intervals_.size(); ++c) {
        Interval& interval = intervals_[c];
        interval = {plan.intervals[c].begin, plan.intervals[c].end,
                    plan.hasSameBoundaries ? interval.stack : findStack(plan.intervals[c]), line, 0};
        const BoundaryStack& stack = stacks_[interval.stack];
        if (stack.slopesY && stack.slopesX) {
            changedRows = ~std::uint64_t{0};
        } else if (stack.slopesY) {
            interval.breaks = computeLineHeights(
                interval, {firstColumn_ + interval.begin, firstRow_ + firstRow, endRow - firstRow, false}, line);
            changedRows |= interval.breaks << firstRow;
            line += static_cast<std::uint32_t>((stack.slopedCount + 1) * kTile);
        }
    }
    for (Interval& interval : intervals_)
        if (stacks_[interval.stack].slopesX) interval.line = line;  // all lines along x share one buffer
    for (std::int32_t y = firstRow; y < endRow; ++y) {
        if ((changedRows >> y & 1) == 0) {
            builder_.repeatRow();
            continue;
        }
        for (const Interval& interval : intervals_) makeInterval(interval, y, firstRow, endRow);
        builder_.addRow(std::span(row_).first(row_.size() - kStride));
    }
}

volume::ColumnTileData TileColumns::make(const TileInput& input) {
    constexpr std::size_t kMaxMembers = std::size_t{1} << 20;
    if (members_.size() + profiles_.size() > kMaxMembers) clearCaches();
    ++tile_;
    firstColumn_ = input.firstColumn;
    firstRow_ = input.firstRow;
    plan_.build(input);
    builder_.start(input.width);
    row_.resize(static_cast<std::size_t>(input.width) + kStride);
    for (std::int32_t y = 0; y < input.height;) {
        const std::int32_t next = nextBit(plan_.newRows(), y, input.height);
        makeRows(y, next);
        y = next;
    }
    volume::ColumnTileData tile = builder_.finish();
    // Every run in the dictionary of a tile is in use, so its scalars are those present.
    for (const volume::Run& run : tile.runs) usedScalars_[run.scalar] = 1;
    return tile;
}

// Counts the voxels shared by solids in all pending uses of a cache entry.
void TileColumns::flushSharedCounts(ColumnCacheEntry& known) {
    for (const auto& shared : std::span(known.shared, known.sharedCount))
        profiles_.addShared(shared.group, std::uint64_t{known.columns} * shared.length);
    known.columns = 0;
}

// Clears all stacks and profiles; their counts go to counts_.
void TileColumns::clearCaches() {
    for (ColumnCacheEntry& known : columnCache_) flushSharedCounts(known);
    std::ranges::fill(columnCache_, ColumnCacheEntry{});
    profiles_.takeCounts(counts_);
    stacks_.clear();
    stackIndex_.clear();
    members_.clear();
    stackHeightPlanes_.clear();
    stackCodes_.clear();
    order_.clear();
    sloped_.clear();
    heights_.clear();
}

OverlapCounts TileColumns::takeCounts() {
    clearCaches();
    return std::exchange(counts_, {});
}

}  // namespace svt::voxelize
