#include <svt/voxelize/tile_plan.hpp>

#include <algorithm>
#include <bit>

namespace svt::voxelize {
namespace {

constexpr std::int32_t kTile = 64;

// Bits [first, end).
std::uint64_t bits(std::int32_t first, std::int32_t end) noexcept {
    const std::uint64_t below = end >= kTile ? ~std::uint64_t{0} : (std::uint64_t{1} << end) - 1;
    return below & ~std::uint64_t{0} << first;
}

std::uint64_t scramble(std::uint64_t number) noexcept {
    number = (number + 1) * 0x9E3779B97F4A7C15ull;
    return (number ^ number >> 29) * 0xBF58476D1CE4E5B9ull;
}

}  // namespace

void TilePlan::addFace(std::int64_t base, std::int64_t slopeX, std::int64_t slopeY, std::int32_t lowest,
                       std::int32_t highest, BoundaryCode code) {
    faces_.push_back({base, slopeX, slopeY, lowest, highest, code.packed()});
    if (faceHashes_.size() < faces_.size()) faceHashes_.push_back(scramble(faces_.size()));
    hasTwin_.push_back(0);
}

void TilePlan::addStretch(std::int32_t firstRow, std::int32_t endRow, std::int32_t column, std::int8_t winding) {
    newRows_ |= std::uint64_t{1} << firstRow;
    if (endRow < kTile) newRows_ |= std::uint64_t{1} << endRow;
    if (column >= width_) return;  // a cover that does not end within the tile ends at its side
    stretches_.push_back({static_cast<std::uint32_t>(faces_.size() - 1), static_cast<std::uint8_t>(firstRow),
                          static_cast<std::uint8_t>(endRow), static_cast<std::uint8_t>(column), winding});
}

void TilePlan::addEdge(const TileInput& input, const FaceTriangle& t, int edge, std::int8_t sign) {
    int low = edge, high = edge == 2 ? 0 : edge + 1;
    // Counter-clockwise, an edge that goes south has the triangle to its east.
    const bool goesNorth = t.y[low] < t.y[high];
    const auto winding = static_cast<std::int8_t>(goesNorth == (sign > 0) ? 1 : -1);
    if (!goesNorth) std::swap(low, high);
    const auto firstRow =
        std::max(static_cast<std::int32_t>(firstSampleAbove(t.y[low])) - input.firstRow, std::int32_t{0});
    const auto endRow = std::min(static_cast<std::int32_t>(firstSampleAbove(t.y[high])) - input.firstRow, input.height);
    if (firstRow >= endRow) return;
    const auto [west, east] = std::minmax(t.x[low], t.x[high]);
    const auto first = static_cast<std::int32_t>(firstSampleAbove(west)) - input.firstColumn;
    const auto last = static_cast<std::int32_t>(firstSampleAbove(east)) - input.firstColumn;
    // The triangle beyond an inner edge touches the tile too, unless all of the edge lies west of it.
    if (last <= 0) {
        addStretch(firstRow, endRow, 0, winding);
        return;
    }
    if ((t.innerEdges >> edge & 1) != 0 || first >= input.width) return;
    if (first == last) {
        addStretch(firstRow, endRow, first, winding);
        return;
    }
    EdgeWalk walk(t.x[low], t.y[low], t.x[high], t.y[high], input.firstRow + firstRow);
    const auto column = [&] {
        return static_cast<std::int32_t>(std::clamp<std::int64_t>(walk.sample() - input.firstColumn, 0, input.width));
    };
    std::int32_t begin = firstRow, current = column();
    for (std::int32_t row = firstRow + 1; row < endRow; ++row) {
        walk.nextRow();
        const std::int32_t next = column();
        if (next == current) continue;
        addStretch(begin, row, current, winding);
        begin = row;
        current = next;
    }
    addStretch(begin, endRow, current, winding);
}

void TilePlan::addTriangle(const TileInput& input, const FaceTriangle& triangle, std::int8_t sign) {
    if (faces_.back().slopeY != 0)
        slopedRows_ |= bits(std::max(triangle.firstRow - input.firstRow, 0),
                            std::min(triangle.endRow - input.firstRow, input.height));
    for (int edge = 0; edge < 3; ++edge) addEdge(input, triangle, edge, sign);
}

void TilePlan::addBox(const TileInput& input, const ClaimedBox& box) {
    const std::int32_t begin = std::max(box.begin - input.firstColumn, 0);
    const std::int32_t end = std::min(box.end - input.firstColumn, input.width);
    const std::int32_t firstRow = std::max(box.firstRow - input.firstRow, 0);
    const std::int32_t endRow = std::min(box.endRow - input.firstRow, input.height);
    if (begin >= end || firstRow >= endRow) return;
    const std::int32_t low = std::clamp(box.low, 0, input.depth), high = std::clamp(box.high, 0, input.depth);
    addFace(0, 0, 0, low, low, {box.claim, true});
    hasTwin_.back() = 1;
    addStretch(firstRow, endRow, begin, 1);
    addStretch(firstRow, endRow, end, -1);
    addFace(0, 0, 0, high, high, {box.claim, false});
}

void TilePlan::build(const TileInput& input) {
    width_ = input.width;
    faces_.clear();
    hasTwin_.clear();
    stretches_.clear();
    newRows_ = 1;
    slopedRows_ = 0;
    std::uint32_t current = 0xFFFFFFFFu;
    for (const std::uint32_t index : input.triangleIndices) {
        const FaceTriangle& triangle = input.triangles[index];
        const ScanFace& face = input.faces[triangle.face];
        if (triangle.face != current) {
            current = triangle.face;
            // Sample k stands at quanta 512 k + 1, and the one strictly above is wanted.
            const Height& height = face.height.height;
            const std::int64_t base = height.base + height.slopeX * input.firstColumn + height.slopeY * input.firstRow +
                                      (std::int64_t{1} << TileFace::kBits) - (std::int64_t{1} << Height::kBits);
            addFace(base, height.slopeX, height.slopeY, std::clamp(face.height.lowest, 0, input.depth),
                    std::clamp(face.height.highest, 0, input.depth), {face.claim, face.sign > 0});
        }
        addTriangle(input, triangle, face.sign);
    }
    for (const std::uint32_t index : input.boxIndices) addBox(input, input.boxes[index]);

    newRows_ &= bits(0, input.height);
    for (std::uint64_t rows = newRows_; rows != 0; rows &= rows - 1) rows_[std::countr_zero(rows)].clear();
    for (const EdgeStretch& stretch : stretches_)
        for (std::uint64_t rows = newRows_ & bits(stretch.firstRow, stretch.endRow); rows != 0; rows &= rows - 1)
            rows_[std::countr_zero(rows)].push_back({stretch.face, stretch.column, stretch.winding});
}

void TilePlan::addSpan(std::uint32_t face, std::int32_t begin, std::int32_t end) {
    breaks_ |= std::uint64_t{1} << begin;
    if (end < width_) breaks_ |= std::uint64_t{1} << end;
    spans_.push_back({face, begin, end});
    if (hasTwin_[face] != 0) spans_.push_back({face + 1, begin, end});
}

// Where the edges of one face cross a row, to the stretches that it covers.
void TilePlan::addSpansOf(std::span<EdgeCrossing> crossings) {
    const std::uint32_t face = crossings.front().face;
    if (crossings.size() == 1) {
        addSpan(face, crossings[0].column, width_);
        return;
    }
    if (crossings.size() == 2 && crossings[0].winding + crossings[1].winding == 0) {
        const auto [begin, end] = std::minmax(crossings[0].column, crossings[1].column);
        if (begin < end) addSpan(face, begin, end);
        return;
    }
    std::sort(crossings.begin(), crossings.end(),
              [](const EdgeCrossing& p, const EdgeCrossing& q) { return p.column < q.column; });
    begins_.clear();
    std::size_t ended = 0;
    for (std::size_t c = 0; c < crossings.size();) {
        const std::int32_t column = crossings[c].column;
        int cover = 0;
        for (; c < crossings.size() && crossings[c].column == column; ++c) cover += crossings[c].winding;
        for (; cover > 0; --cover) begins_.push_back(column);
        for (; cover < 0 && ended < begins_.size(); ++cover) addSpan(face, begins_[ended++], column);
    }
    for (; ended < begins_.size(); ++ended) addSpan(face, begins_[ended], width_);
}

std::span<const PlanCell> TilePlan::layOut(std::int32_t y) {
    std::vector<EdgeCrossing>& crossings = rows_[y];
    spans_.clear();
    breaks_ = 1;
    for (std::size_t c = 0; c < crossings.size();) {
        const std::size_t first = c;
        while (c < crossings.size() && crossings[c].face == crossings[first].face) ++c;
        addSpansOf(std::span(crossings).subspan(first, c - first));
    }

    cells_.clear();
    std::uint8_t cellAt[kTile + 1];
    for (std::uint64_t breaks = breaks_; breaks != 0;) {
        const int begin = std::countr_zero(breaks);
        breaks &= breaks - 1;
        cellAt[begin] = static_cast<std::uint8_t>(cells_.size());
        cells_.push_back({begin, breaks != 0 ? std::countr_zero(breaks) : width_,
                          static_cast<std::uint32_t>(cells_.size() * spans_.size()), 0, 0});
    }
    cellAt[width_] = static_cast<std::uint8_t>(cells_.size());
    if (members_.size() < cells_.size() * spans_.size()) members_.resize(cells_.size() * spans_.size());
    for (const Span& span : spans_) {
        const std::uint64_t hash = faceHashes_[span.face];
        for (std::size_t c = cellAt[span.begin]; c < cellAt[span.end]; ++c) {
            PlanCell& cell = cells_[c];
            members_[cell.firstMember + cell.faceCount++] = span.face;
            cell.hash += hash;
        }
    }
    return cells_;
}

}  // namespace svt::voxelize
