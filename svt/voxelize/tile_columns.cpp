#include <svt/voxelize/tile_columns.hpp>

#include <algorithm>
#include <bit>
#include <tuple>

namespace svt::voxelize {
namespace {

constexpr int kKnownBits = 10;
constexpr std::uint32_t kNoSlot = 0xFFFFFFFFu;

// The lowest set bit above `bit`, or `end`.
std::int32_t nextBit(std::uint64_t bits, std::int32_t bit, std::int32_t end) noexcept {
    const std::uint64_t above = bit + 1 < 64 ? bits >> (bit + 1) << (bit + 1) : 0;
    return above != 0 ? std::countr_zero(above) : end;
}

}  // namespace

std::uint32_t TileColumns::findStack(const PlanCell& cell) {
    const auto members = plan_.boundariesOf(cell);
    return stackIndex_.findOrAdd(
        cell.hash,
        [&](std::uint32_t number) {
            const Stack& known = stacks_[number];
            return known.hash == cell.hash && known.memberCount == members.size() &&
                   std::equal(members.begin(), members.end(), members_.begin() + known.firstMember);
        },
        [&] { return addStack(cell, members); });
}

std::uint32_t TileColumns::addStack(const PlanCell& cell, std::span<const std::uint32_t> members) {
    Stack stack;
    stack.hash = cell.hash;
    stack.firstMember = static_cast<std::uint32_t>(members_.size());
    stack.memberCount = static_cast<std::uint32_t>(members.size());
    stack.firstLevel = static_cast<std::uint32_t>(stackLevels_.size());
    stack.firstSloped = static_cast<std::uint32_t>(sloped_.size());
    stack.firstHeight = static_cast<std::uint32_t>(heights_.size());
    members_.insert(members_.end(), members.begin(), members.end());

    const auto boundaries = plan_.boundaries();
    if (slotOf_.size() < plan_.levels().size()) slotOf_.resize(plan_.levels().size(), kNoSlot);
    for (const std::uint32_t member : members) {
        std::uint32_t& slot = slotOf_[boundaries[member].level];
        if (slot == kNoSlot) {
            slot = stack.levelCount++;
            stackLevels_.push_back({boundaries[member].level, 0, 0});
        }
        ++stackLevels_[stack.firstLevel + slot].codeCount;
    }
    auto firstCode = static_cast<std::uint32_t>(stackCodes_.size());
    for (std::uint32_t slot = 0; slot < stack.levelCount; ++slot) {
        StackLevel& stackLevel = stackLevels_[stack.firstLevel + slot];
        stackLevel.firstCode = firstCode;
        firstCode += stackLevel.codeCount;
        stackLevel.codeCount = 0;
        order_.push_back(slot);
        const TileLevel& level = plan_.levels()[stackLevel.level];
        stack.slopesX = stack.slopesX || level.slopeX != 0;
        stack.slopesY = stack.slopesY || level.slopeY != 0;
        if (!level.isFlat()) sloped_.push_back({stackLevel.level, slot, 0});
    }
    stackCodes_.resize(firstCode);
    for (const std::uint32_t member : members) {
        const Boundary& boundary = boundaries[member];
        StackLevel& stackLevel = stackLevels_[stack.firstLevel + slotOf_[boundary.level]];
        const ProfileCode code{boundary.claim, boundary.isEntry, stackLevel.codeCount > 0};
        stackCodes_[stackLevel.firstCode + stackLevel.codeCount++] = code.packed();
    }
    for (const std::uint32_t member : members) slotOf_[boundaries[member].level] = kNoSlot;
    stack.slopedCount = static_cast<std::uint32_t>(sloped_.size()) - stack.firstSloped;
    heights_.resize(heights_.size() + stack.levelCount + 2, 0);
    heights_.back() = depth_;
    stacks_.push_back(stack);
    return static_cast<std::uint32_t>(stacks_.size() - 1);
}

// Sorts the stack's levels by their heights and finds the profile that goes with this order. Which of equal heights
// comes first makes no difference: nothing lies between them.
void TileColumns::orderStack(Stack& stack) {
    std::uint32_t* const order = order_.data() + stack.firstLevel;
    std::int32_t* const heights = heights_.data() + stack.firstHeight + 1;
    const std::uint32_t count = stack.levelCount;
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
    codes_.clear();
    places_.resize(count);
    for (std::uint32_t c = 0; c < count; ++c) {
        const StackLevel& level = stackLevels_[stack.firstLevel + order[c]];
        const auto first = stackCodes_.begin() + level.firstCode;
        codes_.insert(codes_.end(), first, first + level.codeCount);
        places_[order[c]] = stack.firstHeight + 1 + c;
    }
    for (SlopedLevel& sloped : std::span(sloped_).subspan(stack.firstSloped, stack.slopedCount))
        sloped.height = places_[sloped.slot];
    stack.profile = profiles_.find(codes_);
}

// All heights of a stack.
void TileColumns::beginStack(Stack& stack, std::int32_t x, std::int32_t y) {
    for (std::uint32_t c = 0; c < stack.levelCount; ++c) {
        const StackLevel& level = stackLevels_[stack.firstLevel + order_[stack.firstLevel + c]];
        heights_[stack.firstHeight + 1 + c] = plan_.levels()[level.level].sampleAbove(x, y);
    }
    if (runs_.size() < stack.levelCount + 1) runs_.resize(stack.levelCount + 1);
    orderStack(stack);
    if (stack.slopedCount == 0) stack.column = makeColumn(stack);
    stack.isOrdered = true;
}

// Sets the heights of the sloped levels to those at a step of the line.
void TileColumns::moveStack(Stack& stack, std::uint32_t line, std::size_t step) {
    const auto sloped = std::span(sloped_).subspan(stack.firstSloped, stack.slopedCount);
    const std::int32_t* place = lines_.data() + line + step;
    for (const SlopedLevel& level : sloped) {
        heights_[level.height] = *place;
        place += kTile;
    }
    bool ascends = true;
    for (const SlopedLevel& level : sloped) {
        const std::int32_t* height = heights_.data() + level.height;
        ascends = ascends && height[-1] <= height[0] && height[0] <= height[1];
    }
    if (!ascends) orderStack(stack);
}

// Number of the column with the stack's heights.
std::uint16_t TileColumns::makeColumn(const Stack& stack) {
    const std::int32_t* const heights = heights_.data() + stack.firstHeight + 1;
    volume::Run* const first = runs_.data();
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
        emit(static_cast<std::uint32_t>(heights[change.level]), change.below);
    emit(static_cast<std::uint32_t>(depth_), profiles_.topScalar(stack.profile));
    return builder_.addColumn({first, end});
}

// Heights along a line to lines_, from `place` on. Bit i of the result: some height of step i differs from that of the
// step before, or i is 0.
std::uint64_t TileColumns::measureLine(const Stack& stack, const TileLine& line, std::uint32_t place) {
    const std::size_t needed = place + std::size_t(stack.slopedCount) * kTile;
    if (lines_.size() < needed) lines_.resize(needed);
    std::int32_t* heights = lines_.data() + place;
    std::uint64_t breaks = 1;
    for (const SlopedLevel& sloped : std::span(sloped_).subspan(stack.firstSloped, stack.slopedCount)) {
        const TileLevel level = plan_.levels()[sloped.level];
        const std::int64_t step = line.isAlongX ? level.slopeX : level.slopeY;
        std::int64_t height = level.base + level.slopeX * line.x + level.slopeY * line.y;
        std::int32_t previous = level.clamped(height);
        for (std::int32_t i = 0; i < line.count; ++i) {
            const std::int32_t k = level.clamped(height);
            breaks |= std::uint64_t(k != previous) << i;
            heights[i] = previous = k;
            height += step;
        }
        heights += kTile;
    }
    return breaks;
}

// The column at a step of a line, of which there are `columns`.
std::uint16_t TileColumns::makeStep(std::uint32_t number, std::uint32_t line, std::size_t step, std::uint64_t columns) {
    Stack& stack = stacks_[number];
    const auto countShared = [&] {
        profiles_.addColumns(stack.profile, heights_.data() + stack.firstHeight + 1, columns);
    };
    const std::int32_t* const heights = lines_.data() + line + step;
    KnownColumn* known = nullptr;
    if (stack.slopedCount <= KnownColumn::kMostSloped) {
        const std::uint32_t stackKey = firstStack_ + number;
        std::uint32_t key = stackKey;
        for (std::size_t s = 0; s < stack.slopedCount; ++s)
            key = (key + static_cast<std::uint32_t>(heights[s * kTile])) * 0x9E3779B1u;
        known = &known_[key >> (32 - kKnownBits)];
        bool isKnown = known->stack == stackKey;
        for (std::size_t s = 0; s < stack.slopedCount && isKnown; ++s)
            isKnown = known->heights[s] == heights[s * kTile];
        if (isKnown) {
            if (profiles_.isShared(known->profile)) {
                moveStack(stack, line, step);
                countShared();
            }
            return known->column;
        }
        known->stack = stackKey;
        for (std::size_t s = 0; s < stack.slopedCount; ++s) known->heights[s] = heights[s * kTile];
    }
    moveStack(stack, line, step);
    countShared();
    const std::uint16_t column = makeColumn(stack);
    if (known != nullptr) {
        known->column = column;
        known->profile = stack.profile;
    }
    return column;
}

// Columns of a cell in row y, as far as they differ from those of the row before. Rows [firstRow, endRow) have one
// plan.
void TileColumns::makeCell(const Cell& cell, std::int32_t y, std::int32_t firstRow, std::int32_t endRow) {
    Stack& stack = stacks_[cell.stack];
    if (!stack.isOrdered) beginStack(stack, cell.begin, y);
    std::uint16_t* const columns = row_.data() + cell.begin;
    const std::int32_t width = cell.end - cell.begin;
    const std::int32_t step = y - firstRow, rows = endRow - firstRow;
    if (!stack.slopesX && stack.slopesY) {
        if ((cell.breaks >> step & 1) == 0) return;
        const auto count = std::uint64_t(nextBit(cell.breaks, step, rows) - step) * std::uint64_t(width);
        std::fill_n(columns, width, makeStep(cell.stack, cell.line, static_cast<std::size_t>(step), count));
        return;
    }
    if (y != firstRow && !stack.slopesY) return;
    const auto count = static_cast<std::uint64_t>(stack.slopesY ? 1 : rows);
    if (!stack.slopesX) {
        profiles_.addColumns(stack.profile, heights_.data() + stack.firstHeight + 1, count * std::uint64_t(width));
        std::fill_n(columns, width, stack.column);
        return;
    }
    std::uint64_t breaks = measureLine(stack, {cell.begin, y, width, true}, cell.line);
    while (breaks != 0) {
        const int x = std::countr_zero(breaks);
        breaks &= breaks - 1;
        const int next = breaks != 0 ? std::countr_zero(breaks) : width;
        const std::uint16_t column =
            makeStep(cell.stack, cell.line, static_cast<std::size_t>(x), count * std::uint64_t(next - x));
        std::fill(columns + x, columns + next, column);
    }
}

// Rows [firstRow, endRow), which have one plan.
void TileColumns::makeRows(std::int32_t firstRow, std::int32_t endRow) {
    cells_.clear();
    std::uint64_t changedRows = std::uint64_t{1} << firstRow;
    std::uint32_t line = 0;
    for (const PlanCell& planCell : plan_.layOut(firstRow)) {
        Cell cell{planCell.begin, planCell.end, findStack(planCell), line, 0};
        const Stack& stack = stacks_[cell.stack];
        if (stack.slopesY && stack.slopesX) {
            changedRows = ~std::uint64_t{0};
        } else if (stack.slopesY) {
            cell.breaks = measureLine(stack, {cell.begin, firstRow, endRow - firstRow, false}, line);
            changedRows |= cell.breaks << firstRow;
            line += static_cast<std::uint32_t>(stack.slopedCount * kTile);
        }
        cells_.push_back(cell);
    }
    for (Cell& cell : cells_)
        if (stacks_[cell.stack].slopesX) cell.line = line;  // one place for all lines along x
    for (std::int32_t y = firstRow; y < endRow; ++y) {
        if ((changedRows >> y & 1) == 0) {
            builder_.repeatRow();
            continue;
        }
        for (const Cell& cell : cells_) makeCell(cell, y, firstRow, endRow);
        builder_.addRow(row_);
    }
}

volume::ColumnTileData TileColumns::make(const TileInput& input) {
    constexpr std::size_t kMostCodes = std::size_t{1} << 22;
    constexpr std::uint32_t kMostStacks = std::uint32_t{1} << 31;
    if (profiles_.size() > kMostCodes) profiles_.takeCounts(counts_);
    firstStack_ += static_cast<std::uint32_t>(stacks_.size());
    if (known_.empty() || profiles_.size() == 0 || firstStack_ > kMostStacks) {
        known_.assign(std::size_t{1} << kKnownBits, KnownColumn{});
        firstStack_ = 1;
    }
    plan_.build(input);
    builder_.start(input.width);
    depth_ = input.depth;
    stacks_.clear();
    stackIndex_.clear();
    members_.clear();
    stackLevels_.clear();
    stackCodes_.clear();
    order_.clear();
    sloped_.clear();
    heights_.clear();
    row_.resize(static_cast<std::size_t>(input.width));
    for (std::int32_t y = 0; y < input.height;) {
        const std::int32_t next = nextBit(plan_.newRows(), y, input.height);
        makeRows(y, next);
        y = next;
    }
    return builder_.finish();
}

void TileColumns::takeCounts(std::vector<SharedCount>& counts) {
    counts.insert(counts.end(), counts_.begin(), counts_.end());
    counts_.clear();
    profiles_.takeCounts(counts);
}

}  // namespace svt::voxelize
