#include <svt/voxelize/lattice/edge_columns.hpp>
#include <svt/voxelize/tiles/tile_plan.hpp>

#include <algorithm>
#include <bit>
#include <cstring>
#include <tuple>
#include <utility>

namespace svt::voxelize {
namespace {

// Mask of bits [0, end), `end` at most 64.
std::uint64_t bitsBelow(std::int32_t end) noexcept {
    return end >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << end) - 1;
}

// Mask of bits [first, end).
std::uint64_t bits(std::int32_t first, std::int32_t end) noexcept { return bitsBelow(end) & ~bitsBelow(first); }

// Mask of bits that differ from the next lower bit.
std::uint64_t changes(std::uint64_t rows) noexcept { return rows ^ rows << 1; }

std::uint64_t scramble(std::uint64_t number) noexcept {
    number = (number + 1) * 0x9E3779B97F4A7C15ull;
    return (number ^ number >> 29) * 0xBF58476D1CE4E5B9ull;
}

const FaceTriangle& triangleOf(const TileInput& input, PartRef part) noexcept {
    return input.objects[part.object].faces.triangles[part.number];
}

}  // namespace

// Returns false if the edge does not affect the tile.
bool TilePlan::placeEdge(const TileInput& input, const FaceTriangle& t, int edge, bool facesDown,
                         PlacedEdge& out) noexcept {
    const int from = edge, to = edge == 2 ? 0 : edge + 1;
    out.first = std::min(t.column(from), t.column(to)) - input.firstColumn;
    if (out.first >= input.width) return false;
    // Inner edges cancel: the triangle beyond touches the tile too, unless the whole edge lies west of the tile.
    const bool isInner = (t.innerEdges >> edge & 1) != 0;
    if (isInner && out.first > 0) return false;
    // In a counter-clockwise triangle, an edge that goes south has the triangle on its east side.
    const bool goesNorth = t.y[from] < t.y[to];
    const int south = goesNorth ? from : to, north = goesNorth ? to : from;
    out.firstRow = std::max(t.row(south) - input.firstRow, 0);
    out.endRow = std::min(t.row(north) - input.firstRow, input.height);
    if (out.firstRow >= out.endRow) return false;
    out.last = std::max(t.column(from), t.column(to)) - input.firstColumn;
    out.isEntry = goesNorth == facesDown;
    out.x0 = t.x[south];
    out.y0 = t.y[south];
    out.x1 = t.x[north];
    out.y1 = t.y[north];
    if (!isInner || out.last <= 0) return true;
    const std::int64_t dx = std::int64_t(out.x1) - out.x0, dy = std::int64_t(out.y1) - out.y0;
    const auto isWest = [&](std::int32_t row) {  // is the edge west of the first sample of the row, or on it?
        const std::int64_t y = std::int64_t(input.firstRow + row) * kQuanta + 1 - out.y0;
        return y * dx <= (std::int64_t(input.firstColumn) * kQuanta + 1 - out.x0) * dy;
    };
    if (!isWest(out.firstRow) || !isWest(out.endRow - 1)) return false;
    out.last = 0;
    return true;
}

// Adds an edge west of the tile. Only the sum of windings matters there.
void TilePlan::addWest(std::uint64_t rows, bool isEntry) {
    std::uint64_t& same = isEntry ? outline_.westIn : outline_.westOut;
    std::uint64_t& opposite = isEntry ? outline_.westOut : outline_.westIn;
    const std::uint64_t cancelled = rows & opposite;
    opposite ^= cancelled;
    if ((same & (rows ^ cancelled)) != 0) outline_.isSimple = false;
    same |= rows ^ cancelled;
}

void TilePlan::addToOutline(const TileInput& input, const PlacedEdge& edge) {
    if (edge.last <= 0) {
        addWest(bits(edge.firstRow, edge.endRow), edge.isEntry);
        return;
    }
    std::uint8_t* columns = edge.isEntry ? outline_.cover.begin : outline_.cover.end;
    std::uint64_t within = 0, turns = 0;  // rows in which the edge is inside the tile, and in which it moves
    if (edge.first == edge.last) {
        within = bits(edge.firstRow, edge.endRow);
        std::memset(columns + edge.firstRow, edge.first, static_cast<std::size_t>(edge.endRow - edge.firstRow));
    } else {
        const EdgeWalk walk(edge.x0, edge.y0, edge.x1, edge.y1, input.firstRow + edge.firstRow);
        std::uint8_t placed[kEdgeSpace];
        const EdgeRows rows = edgeColumns(walk, input.firstColumn, input.width, edge.endRow - edge.firstRow, placed);
        within = rows.within << edge.firstRow;
        turns = rows.moves << edge.firstRow;
        if (rows.within != 0) {  // contiguous rows, since an edge is straight
            const int first = std::countr_zero(rows.within), end = 64 - std::countl_zero(rows.within);
            std::memcpy(columns + edge.firstRow + first, placed + first, static_cast<std::size_t>(end - first));
        }
        if (rows.west != 0) addWest(rows.west << edge.firstRow, edge.isEntry);
    }
    std::uint64_t& met = edge.isEntry ? outline_.begun : outline_.ended;
    if ((met & within) != 0) outline_.isSimple = false;
    met |= within;
    outline_.turns |= (turns & within) | changes(within);
}

// The rare face with several spans in a row: all crossings are sorted and paired by winding.
void TilePlan::addConcaveFace(const TileInput& input, std::span<const PartRef> triangles, Boundary face) {
    crossings_.clear();
    for (const PartRef part : triangles) {
        const FaceTriangle& t = triangleOf(input, part);
        for (int e = 0; e < 3; ++e) {
            PlacedEdge edge;
            if (!placeEdge(input, t, e, face.isEntry, edge)) continue;
            EdgeWalk walk(edge.x0, edge.y0, edge.x1, edge.y1, input.firstRow + edge.firstRow);
            for (std::int32_t row = edge.firstRow; row < edge.endRow; ++row, walk.nextRow())
                crossings_.push_back({static_cast<std::uint8_t>(row),
                                      static_cast<std::uint8_t>(
                                          std::clamp<std::int64_t>(walk.sample() - input.firstColumn, 0, input.width)),
                                      static_cast<std::int8_t>(edge.isEntry ? 1 : -1)});
        }
    }
    std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& p, const Crossing& q) {
        return std::tie(p.row, p.column) < std::tie(q.row, q.column);
    });
    const std::size_t firstCover = covers_.size();
    const auto addSpan = [&](std::uint8_t row, std::size_t number, std::uint8_t begin, std::uint8_t end) {
        if (firstCover + number == covers_.size()) covers_.push_back({0, face.packed(), {}, {}});
        Cover& cover = covers_[firstCover + number];
        cover.rows |= std::uint64_t{1} << row;
        cover.begin[row] = begin;
        cover.end[row] = end;
    };
    for (std::size_t c = 0; c < crossings_.size();) {
        const std::uint8_t row = crossings_[c].row;
        begins_.clear();
        std::size_t ended = 0;
        while (c < crossings_.size() && crossings_[c].row == row) {
            const std::uint8_t column = crossings_[c].column;
            int winding = 0;
            for (; c < crossings_.size() && crossings_[c].row == row && crossings_[c].column == column; ++c)
                winding += crossings_[c].winding;
            for (; winding > 0; --winding) begins_.push_back(column);
            for (; winding < 0 && ended < begins_.size(); ++winding, ++ended)
                addSpan(row, ended, begins_[ended], column);
        }
        for (; ended < begins_.size(); ++ended)
            addSpan(row, ended, begins_[ended], static_cast<std::uint8_t>(input.width));
    }
    for (std::size_t n = firstCover; n < covers_.size(); ++n) {
        const Cover& cover = covers_[n];
        newRows_ |= changes(cover.rows);
        for (std::uint64_t rows = cover.rows & cover.rows << 1; rows != 0; rows &= rows - 1) {
            const int row = std::countr_zero(rows);
            if (cover.begin[row] != cover.begin[row - 1] || cover.end[row] != cover.end[row - 1])
                newRows_ |= std::uint64_t{1} << row;
        }
    }
}

void TilePlan::addFace(const TileInput& input, std::span<const PartRef> triangles) {
    const FaceList& list = input.objects[triangles.front().object].faces;
    const Boundary face = list.faces[list.triangles[triangles.front().number].face];
    outline_.westIn = outline_.westOut = outline_.begun = outline_.ended = outline_.turns = 0;
    outline_.isSimple = true;
    std::memset(outline_.cover.begin, 0, kTile);
    std::memset(outline_.cover.end, input.width, kTile);
    for (const PartRef part : triangles) {
        const FaceTriangle& triangle = list.triangles[part.number];
        for (int e = 0; e < 3; ++e) {
            PlacedEdge edge;
            if (placeEdge(input, triangle, e, face.isEntry, edge)) addToOutline(input, edge);
        }
    }
    const std::uint64_t rows = outline_.westIn | outline_.begun;
    if (!outline_.isSimple || outline_.westOut != 0 || (outline_.westIn & outline_.begun) != 0) {
        addConcaveFace(input, triangles, face);
    } else if (rows != 0) {
        newRows_ |= changes(outline_.westIn) | outline_.turns;
        covers_.push_back(outline_.cover);
        covers_.back().rows = rows;
        covers_.back().boundary = face.packed();
    }
}

void TilePlan::addBox(const TileInput& input, const ClaimedBox& box) {
    const std::int32_t begin = std::max(box.begin - input.firstColumn, 0);
    const std::int32_t end = std::min(box.end - input.firstColumn, input.width);
    const std::int32_t firstRow = std::max(box.firstRow - input.firstRow, 0);
    const std::int32_t endRow = std::min(box.endRow - input.firstRow, input.height);
    if (begin >= end || firstRow >= endRow) return;
    const std::uint64_t rows = bits(firstRow, endRow);
    for (const bool isEntry : {true, false}) {
        const std::int32_t k = std::clamp(isEntry ? box.low : box.high, 0, input.depth);
        const Boundary boundary{static_cast<std::uint32_t>(k), box.claim, isEntry != box.countsAgainst};
        boxCovers_.push_back(
            {rows, boundary.packed(), static_cast<std::uint8_t>(begin), static_cast<std::uint8_t>(end)});
    }
    newRows_ |= changes(rows);
}

void TilePlan::build(const TileInput& input) {
    width_ = input.width;
    covers_.clear();
    boxCovers_.clear();
    newRows_ = 1;
    const auto isSameFace = [&](PartRef p, PartRef q) {
        return p.object == q.object && triangleOf(input, p).face == triangleOf(input, q).face;
    };
    for (std::size_t n = 0; n < input.triangles.size();) {
        const std::size_t first = n;
        while (n < input.triangles.size() && isSameFace(input.triangles[n], input.triangles[first])) ++n;
        addFace(input, input.triangles.subspan(first, n - first));
    }
    for (const PartRef part : input.boxes) addBox(input, input.objects[part.object].boxes[part.number]);

    newRows_ &= bits(0, input.height);
    for (std::vector<Span>& row : rows_) row.clear();
    coverMembers_.clear();
    for (std::uint32_t c = 0; c < covers_.size(); ++c) {
        const Cover& cover = covers_[c];
        coverMembers_.push_back({cover.boundary, scramble(cover.boundary)});
        for (std::uint64_t rows = cover.rows & newRows_; rows != 0; rows &= rows - 1) {
            const int row = std::countr_zero(rows);
            if (cover.begin[row] < cover.end[row]) rows_[row].push_back({c, cover.begin[row], cover.end[row]});
        }
    }
    auto number = static_cast<std::uint32_t>(covers_.size());
    for (const BoxCover& cover : boxCovers_) {
        coverMembers_.push_back({cover.boundary, scramble(cover.boundary)});
        for (std::uint64_t rows = cover.rows & newRows_; rows != 0; rows &= rows - 1)
            rows_[std::countr_zero(rows)].push_back({number, cover.begin, cover.end});
        ++number;
    }
    intervalCount_ = 0;
}

PlanRowIntervals TilePlan::layOut(std::int32_t y) {
    const std::vector<Span>& spans = rows_[y];
    std::uint64_t breaks = 1;  // bit x: an interval begins at column x
    for (const Span& span : spans) {
        breaks |= std::uint64_t{1} << span.begin;
        if (span.end < width_) breaks |= std::uint64_t{1} << span.end;
    }
    const std::size_t previousCount = intervalCount_;
    intervalCount_ = 0;
    std::uint8_t intervalAt[kTile + 1];
    while (breaks != 0) {
        const int begin = std::countr_zero(breaks);
        breaks &= breaks - 1;
        intervalAt[begin] = static_cast<std::uint8_t>(intervalCount_);
        intervals_[intervalCount_++] = {begin, breaks != 0 ? std::countr_zero(breaks) : width_, 0, 0, 0};
    }
    intervalAt[width_] = static_cast<std::uint8_t>(intervalCount_);
    const std::span intervals(intervals_, intervalCount_);
    std::swap(intervalSpans_, previousSpans_);
    intervalSpans_.resize(spans.size());
    bool isKept = intervalCount_ == previousCount && spans.size() == previousSpans_.size();
    for (std::size_t s = 0; s < spans.size(); ++s) {
        intervalSpans_[s] = {spans[s].cover, intervalAt[spans[s].begin], intervalAt[spans[s].end]};
        isKept = isKept && intervalSpans_[s] == previousSpans_[s];
    }
    if (isKept) return {intervals, true};

    std::uint64_t* next[kTile];  // per interval: where its next member is written
    const std::size_t room = spans.size();
    if (members_.size() < intervals.size() * room) members_.resize(intervals.size() * room);
    for (std::size_t interval = 0; interval < intervals.size(); ++interval)
        next[interval] = members_.data() + interval * room;
    for (const IntervalSpan& span : intervalSpans_) {
        const Member member = coverMembers_[span.cover];
        for (std::size_t interval = span.begin; interval < span.end; ++interval) {
            *next[interval]++ = member.boundary;
            intervals[interval].hash += member.hash;
        }
    }
    for (std::size_t interval = 0; interval < intervals.size(); ++interval) {
        intervals[interval].firstMember = static_cast<std::uint32_t>(interval * room);
        intervals[interval].memberCount =
            static_cast<std::uint32_t>(next[interval] - (members_.data() + interval * room));
    }
    return {intervals, false};
}

}  // namespace svt::voxelize
