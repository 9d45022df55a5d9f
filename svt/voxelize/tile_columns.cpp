#include <svt/voxelize/tile_columns.hpp>

#include <algorithm>
#include <bit>

namespace svt::voxelize {
namespace {

constexpr std::int32_t kTile = volume::ColumnVolume::kTileSize;
constexpr std::size_t kStackTable = 256;

// The lowest set bit above `bit`, or `end`.
std::int32_t nextBit(std::uint64_t bits, std::int32_t bit, std::int32_t end) noexcept {
    const std::uint64_t above = bit + 1 < kTile ? bits >> (bit + 1) << (bit + 1) : 0;
    return above != 0 ? std::countr_zero(above) : end;
}

}  // namespace

std::uint32_t TileColumns::findStack(const PlanCell& cell) {
    const auto faces = plan_.facesOf(cell);
    const std::size_t mask = stackTable_.size() - 1;
    std::size_t slot = cell.hash >> 32 & mask;
    for (; stackTable_[slot] != 0; slot = (slot + 1) & mask) {
        const Stack& known = stacks_[stackTable_[slot] - 1];
        if (known.hash == cell.hash && known.count == faces.size() &&
            std::equal(faces.begin(), faces.end(), members_.begin() + known.first))
            return stackTable_[slot] - 1;
    }
    Stack stack;
    stack.hash = cell.hash;
    stack.first = static_cast<std::uint32_t>(members_.size());
    stack.count = static_cast<std::uint32_t>(faces.size());
    for (std::uint32_t m = 0; m < faces.size(); ++m) {
        const TileFace& face = plan_.faces()[faces[m]];
        stack.slopesX = stack.slopesX || face.slopeX != 0;
        stack.slopesY = stack.slopesY || face.slopeY != 0;
        members_.push_back(faces[m]);
        order_.push_back(m);
    }
    stacks_.push_back(stack);
    stackTable_[slot] = static_cast<std::uint32_t>(stacks_.size());
    const auto number = static_cast<std::uint32_t>(stacks_.size() - 1);
    if (stacks_.size() * 2 > stackTable_.size()) {
        stackTable_.assign(stackTable_.size() * 2, 0);
        const std::size_t wider = stackTable_.size() - 1;
        for (std::uint32_t s = 0; s < stacks_.size(); ++s) {
            slot = stacks_[s].hash >> 32 & wider;
            while (stackTable_[slot] != 0) slot = (slot + 1) & wider;
            stackTable_[slot] = s + 1;
        }
    }
    return number;
}

void TileColumns::layOutRow(std::int32_t y) {
    cells_.clear();
    for (const PlanCell& cell : plan_.layOut(y)) cells_.push_back({cell.begin, cell.end, findStack(cell)});
}

// heights_ to sortedHeights_ by the stack's order; false where they do not ascend.
bool TileColumns::sortHeights(const Stack& stack) noexcept {
    const std::uint32_t* order = order_.data() + stack.first;
    std::int32_t previous = 0;
    bool ascends = true;
    for (std::uint32_t c = 0; c < stack.count; ++c) {
        const std::int32_t height = heights_[order[c]];
        ascends = ascends && height >= previous;
        sortedHeights_[c] = previous = height;
    }
    sortedHeights_[stack.count] = depth_;
    return ascends;
}

// The order of the stack's faces at heights_, and the profile that goes with it. Which of equal heights comes
// first makes no difference: nothing lies between them.
void TileColumns::orderStack(Stack& stack) {
    std::uint32_t* order = order_.data() + stack.first;
    constexpr std::uint32_t kShort = 64;
    if (stack.count > kShort) {
        std::stable_sort(order, order + stack.count,
                         [&](std::uint32_t p, std::uint32_t q) { return heights_[p] < heights_[q]; });
    } else {
        for (std::uint32_t c = 1; c < stack.count; ++c) {
            const std::uint32_t moving = order[c];
            std::uint32_t to = c;
            for (; to > 0 && heights_[order[to - 1]] > heights_[moving]; --to) order[to] = order[to - 1];
            order[to] = moving;
        }
    }
    codes_.resize(stack.count);
    for (std::uint32_t c = 0; c < stack.count; ++c) codes_[c] = plan_.faces()[members_[stack.first + order[c]]].code;
    stack.profile = profiles_.find(codes_);
    stack.isOrdered = true;
}

// Number of the column with heights_; `columns` of them are made.
std::uint16_t TileColumns::makeColumn(Stack& stack, std::uint64_t columns) {
    if (!sortHeights(stack) || !stack.isOrdered) {
        orderStack(stack);
        static_cast<void>(sortHeights(stack));
    }
    profiles_.addColumns(stack.profile, std::span(sortedHeights_).first(stack.count + 1), columns);
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
        emit(static_cast<std::uint32_t>(sortedHeights_[change.crossing]), change.below);
    emit(static_cast<std::uint32_t>(depth_), profiles_.topScalar(stack.profile));
    return builder_.addColumn({first, end});
}

void TileColumns::makeCell(const Cell& cell, std::int32_t y, std::uint64_t rows) {
    Stack& stack = stacks_[cell.stack];
    if (runs_.size() < stack.count + 2) {
        runs_.resize(stack.count + 2);
        heights_.resize(stack.count + 2);
        sortedHeights_.resize(stack.count + 2);
    }
    const std::uint32_t* members = members_.data() + stack.first;
    for (std::uint32_t m = 0; m < stack.count; ++m) heights_[m] = plan_.faces()[members[m]].sampleAbove(cell.begin, y);
    if (stack.slopesX) {
        makeSlopedCell(cell, y, rows);
        return;
    }
    const std::uint16_t column = makeColumn(stack, rows * static_cast<std::uint64_t>(cell.end - cell.begin));
    std::fill(row_.begin() + cell.begin, row_.begin() + cell.end, column);
}

void TileColumns::makeSlopedCell(const Cell& cell, std::int32_t y, std::uint64_t rows) {
    Stack& stack = stacks_[cell.stack];
    const std::uint32_t* members = members_.data() + stack.first;
    slopedMembers_.clear();
    slopedHeights_.resize(std::size_t(stack.count) * kTile);
    std::uint64_t breaks = std::uint64_t{1} << cell.begin;  // bit x: some height differs from that at x - 1
    for (std::uint32_t m = 0; m < stack.count; ++m) {
        const TileFace& face = plan_.faces()[members[m]];
        if (face.slopeX == 0) continue;
        std::int32_t* heights = slopedHeights_.data() + slopedMembers_.size() * kTile;
        slopedMembers_.push_back(m);
        std::int64_t height = face.base + face.slopeX * cell.begin + face.slopeY * y;
        std::int32_t previous = heights_[m];
        for (std::int32_t x = cell.begin; x < cell.end; ++x, height += face.slopeX) {
            const std::int32_t k = face.clamped(height);
            breaks |= std::uint64_t(k != previous) << x;
            heights[x] = previous = k;
        }
    }
    while (breaks != 0) {
        const int x = std::countr_zero(breaks);
        breaks &= breaks - 1;
        const int next = breaks != 0 ? std::countr_zero(breaks) : cell.end;
        for (std::size_t s = 0; s < slopedMembers_.size(); ++s)
            heights_[slopedMembers_[s]] = slopedHeights_[s * kTile + std::size_t(x)];
        const std::uint16_t column = makeColumn(stack, rows * static_cast<std::uint64_t>(next - x));
        std::fill(row_.begin() + x, row_.begin() + next, column);
    }
}

volume::ColumnTileData TileColumns::make(const TileInput& input) {
    plan_.build(input);
    builder_.start(input.width);
    depth_ = input.depth;
    stacks_.clear();
    members_.clear();
    order_.clear();
    stackTable_.assign(kStackTable, 0);
    row_.resize(static_cast<std::size_t>(input.width));
    const std::uint64_t newRows = plan_.newRows(), changedRows = newRows | plan_.slopedRows();
    for (std::int32_t y = 0; y < input.height;) {
        const std::int32_t next = nextBit(changedRows, y, input.height);
        const bool isNew = (newRows >> y & 1) != 0;
        if (isNew) layOutRow(y);
        for (const Cell& cell : cells_) {
            const bool slopesY = stacks_[cell.stack].slopesY;
            if (!isNew && !slopesY) continue;
            makeCell(cell, y, static_cast<std::uint64_t>((slopesY ? next : nextBit(newRows, y, input.height)) - y));
        }
        builder_.addRow(row_);
        while (++y < next) builder_.repeatRow();
    }
    return builder_.finish();
}

void TileColumns::takeCounts(std::vector<SharedCount>& counts) { profiles_.takeCounts(counts); }

}  // namespace svt::voxelize
