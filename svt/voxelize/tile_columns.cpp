#include <svt/voxelize/tile_columns.hpp>

#include <algorithm>
#include <bit>
#include <tuple>

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
    for (std::size_t slot = cell.hash >> 32 & mask; stackTable_[slot] != 0; slot = (slot + 1) & mask) {
        const Stack& known = stacks_[stackTable_[slot] - 1];
        if (known.hash == cell.hash && known.count == faces.size() &&
            std::equal(faces.begin(), faces.end(), members_.begin() + known.first))
            return stackTable_[slot] - 1;
    }
    return addStack(cell, faces);
}

std::uint32_t TileColumns::addStack(const PlanCell& cell, std::span<const std::uint32_t> faces) {
    Stack stack;
    stack.hash = cell.hash;
    stack.first = static_cast<std::uint32_t>(members_.size());
    stack.count = static_cast<std::uint32_t>(faces.size());
    stack.firstHeight = static_cast<std::uint32_t>(heights_.size());
    stack.firstSloped = static_cast<std::uint32_t>(sloped_.size());
    for (std::uint32_t m = 0; m < faces.size(); ++m) {
        const TileFace& face = plan_.faces()[faces[m]];
        stack.slopesX = stack.slopesX || face.slopeX != 0;
        stack.slopesY = stack.slopesY || face.slopeY != 0;
        if (face.slopeX != 0 || face.slopeY != 0) sloped_.push_back({faces[m], m, 0});
        order_.push_back(m);
    }
    stack.slopedCount = static_cast<std::uint32_t>(sloped_.size()) - stack.firstSloped;
    members_.insert(members_.end(), faces.begin(), faces.end());
    heights_.resize(heights_.size() + faces.size() + 2, 0);
    heights_.back() = depth_;
    stacks_.push_back(stack);

    const std::size_t size = stacks_.size() * 2 > stackTable_.size() ? stackTable_.size() * 2 : stackTable_.size();
    const std::size_t mask = size - 1;
    const auto enter = [&](std::size_t number) {
        std::size_t slot = stacks_[number].hash >> 32 & mask;
        while (stackTable_[slot] != 0) slot = (slot + 1) & mask;
        stackTable_[slot] = static_cast<std::uint32_t>(number + 1);
    };
    const std::size_t number = stacks_.size() - 1;
    if (size == stackTable_.size()) {
        enter(number);
    } else {
        stackTable_.assign(size, 0);
        for (std::size_t s = 0; s <= number; ++s) enter(s);
    }
    return static_cast<std::uint32_t>(number);
}

void TileColumns::layOutRow(std::int32_t y) {
    cells_.clear();
    for (const PlanCell& cell : plan_.layOut(y)) cells_.push_back({cell.begin, cell.end, findStack(cell)});
}

// Sorts the stack's faces by their heights and finds the profile that goes with this order. Which of equal heights
// comes first makes no difference: nothing lies between them.
void TileColumns::orderStack(Stack& stack) {
    std::uint32_t* const order = order_.data() + stack.first;
    std::int32_t* const heights = heights_.data() + stack.firstHeight + 1;
    constexpr std::uint32_t kShort = 64;
    if (stack.count > kShort) {
        pairs_.clear();
        for (std::uint32_t c = 0; c < stack.count; ++c) pairs_.emplace_back(heights[c], order[c]);
        std::sort(pairs_.begin(), pairs_.end());
        for (std::uint32_t c = 0; c < stack.count; ++c) std::tie(heights[c], order[c]) = pairs_[c];
    } else {
        for (std::uint32_t c = 1; c < stack.count; ++c) {
            const std::uint32_t member = order[c];
            const std::int32_t height = heights[c];
            std::uint32_t to = c;
            for (; to > 0 && heights[to - 1] > height; --to) {
                order[to] = order[to - 1];
                heights[to] = heights[to - 1];
            }
            order[to] = member;
            heights[to] = height;
        }
    }
    codes_.resize(stack.count);
    places_.resize(stack.count);
    for (std::uint32_t c = 0; c < stack.count; ++c) {
        codes_[c] = plan_.faces()[members_[stack.first + order[c]]].code;
        places_[order[c]] = stack.firstHeight + 1 + c;
    }
    for (SlopedFace& sloped : std::span(sloped_).subspan(stack.firstSloped, stack.slopedCount))
        sloped.height = places_[sloped.member];
    stack.profile = profiles_.find(codes_);
}

// The first column of a stack: all heights.
void TileColumns::beginStack(Stack& stack, std::int32_t x, std::int32_t y) {
    const std::uint32_t* members = members_.data() + stack.first;
    for (std::uint32_t c = 0; c < stack.count; ++c)
        heights_[stack.firstHeight + 1 + c] = plan_.faces()[members[c]].sampleAbove(x, y);
    if (runs_.size() < stack.count + 1) runs_.resize(stack.count + 1);
    orderStack(stack);
}

// The stack's heights to its column, which stays where they are as before; `columns` of them are made.
void TileColumns::makeColumn(Stack& stack, bool isMoved, std::uint64_t columns) {
    if (isMoved) {
        bool ascends = true;
        for (const SlopedFace& sloped : std::span(sloped_).subspan(stack.firstSloped, stack.slopedCount)) {
            const std::int32_t* height = heights_.data() + sloped.height;
            ascends = ascends && height[-1] <= height[0] && height[0] <= height[1];
        }
        if (!ascends) orderStack(stack);
    }
    const std::int32_t* const heights = heights_.data() + stack.firstHeight + 1;
    profiles_.addColumns(stack.profile, heights, columns);
    if (!isMoved && stack.isMade) return;

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
        emit(static_cast<std::uint32_t>(heights[change.crossing]), change.below);
    emit(static_cast<std::uint32_t>(depth_), profiles_.topScalar(stack.profile));
    stack.column = builder_.addColumn({first, end});
    stack.isMade = true;
}

void TileColumns::makeCell(const Cell& cell, std::int32_t y, std::uint64_t rows) {
    Stack& stack = stacks_[cell.stack];
    if (!stack.isMade) beginStack(stack, cell.begin, y);
    if (stack.slopesX) {
        makeSlopedCell(cell, y, rows);
        return;
    }
    bool isMoved = false;
    for (const SlopedFace& sloped : std::span(sloped_).subspan(stack.firstSloped, stack.slopedCount)) {
        const std::int32_t height = plan_.faces()[sloped.face].sampleAbove(cell.begin, y);
        isMoved = isMoved || heights_[sloped.height] != height;
        heights_[sloped.height] = height;
    }
    makeColumn(stack, isMoved, rows * static_cast<std::uint64_t>(cell.end - cell.begin));
    std::fill(row_.begin() + cell.begin, row_.begin() + cell.end, stack.column);
}

void TileColumns::makeSlopedCell(const Cell& cell, std::int32_t y, std::uint64_t rows) {
    Stack& stack = stacks_[cell.stack];
    const auto sloped = std::span(sloped_).subspan(stack.firstSloped, stack.slopedCount);
    if (slopedHeights_.size() < sloped.size() * kTile) slopedHeights_.resize(sloped.size() * kTile);
    std::uint64_t breaks = std::uint64_t{1} << cell.begin;  // bit x: some height differs from that at x - 1
    std::int32_t* slopedHeights = slopedHeights_.data();
    for (const SlopedFace& one : sloped) {
        const TileFace& face = plan_.faces()[one.face];
        std::int64_t height = face.base + face.slopeX * cell.begin + face.slopeY * y;
        std::int32_t previous = face.clamped(height);
        for (std::int32_t x = cell.begin; x < cell.end; ++x, height += face.slopeX) {
            const std::int32_t k = face.clamped(height);
            breaks |= std::uint64_t(k != previous) << x;
            slopedHeights[x] = previous = k;
        }
        slopedHeights += kTile;
    }
    while (breaks != 0) {
        const int x = std::countr_zero(breaks);
        breaks &= breaks - 1;
        const int next = breaks != 0 ? std::countr_zero(breaks) : cell.end;
        for (std::size_t s = 0; s < sloped.size(); ++s)
            heights_[sloped[s].height] = slopedHeights_[s * kTile + std::size_t(x)];
        makeColumn(stack, true, rows * static_cast<std::uint64_t>(next - x));
        std::fill(row_.begin() + x, row_.begin() + next, stack.column);
    }
}

volume::ColumnTileData TileColumns::make(const TileInput& input) {
    plan_.build(input);
    builder_.start(input.width);
    depth_ = input.depth;
    stacks_.clear();
    members_.clear();
    order_.clear();
    heights_.clear();
    sloped_.clear();
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
