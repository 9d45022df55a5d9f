#include <svt/writers/marks/free_space.hpp>

#include <svt/drawing/clip_segment.hpp>
#include <svt/model/classes.hpp>
#include <svt/writers/canvas/sheet_canvas.hpp>
#include <svt/writers/drawing/drawing_style.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace svt::writers {
namespace {

using drawing::PlanePoint;

constexpr double kRounding = 1e-6;  // millimetres
constexpr double kMost = 1e5;       // millimetres: farther than any paper reaches

std::uint64_t keyOf(std::int64_t x, std::int64_t y) noexcept {
    return static_cast<std::uint64_t>(x) << 32 ^ (static_cast<std::uint64_t>(y) & 0xFFFFFFFFu);
}

// The number of the square of `size` millimetres, from a floor or ceiling in squares.
std::int64_t numberOf(double square, double size) noexcept {
    return static_cast<std::int64_t>(std::clamp(square, -kMost / size, kMost / size));
}
std::int64_t cellOf(double at, double size) noexcept { return numberOf(std::floor(at / size), size); }

// The number of a tile, and the square or cell in it.
std::int64_t tileOf(std::int64_t number, std::int64_t perTile) noexcept {
    return number >= 0 ? number / perTile : (number + 1) / perTile - 1;
}

// The bits from first to last, below 64.
std::uint64_t bitsOf(std::int64_t first, std::int64_t last) noexcept {
    const std::uint64_t upTo = last >= 63 ? ~std::uint64_t{0} : (std::uint64_t{1} << (last + 1)) - 1;
    return upTo & ~((std::uint64_t{1} << first) - 1);
}

// The ends along u of the part of a segment between two heights; nothing if there is none.
std::optional<std::pair<double, double>> extentBetween(PlanePoint from, PlanePoint to, double low,
                                                       double high) noexcept {
    const double dv = to.v - from.v;
    double t0 = 0, t1 = 1;
    if (dv == 0) {
        if (from.v < low || from.v > high) return std::nullopt;
    } else {
        const double a = (low - from.v) / dv, b = (high - from.v) / dv;
        t0 = std::max(0.0, std::min(a, b));
        t1 = std::min(1.0, std::max(a, b));
        if (t0 > t1) return std::nullopt;
    }
    const double a = from.u + t0 * (to.u - from.u), b = from.u + t1 * (to.u - from.u);
    return std::pair(std::min(a, b), std::max(a, b));
}

// Calls `visit(x, y)` for the cells of `size` millimetres that a segment may meet, until it returns false.
template <class Visit>
void visitAlong(PlanePoint from, PlanePoint to, double size, const Visit& visit) {
    const std::int64_t last = cellOf(std::max(from.v, to.v) + kRounding, size);
    for (std::int64_t y = cellOf(std::min(from.v, to.v) - kRounding, size); y <= last; ++y) {
        const double low = static_cast<double>(y) * size;
        const auto extent = extentBetween(from, to, low - kRounding, low + size + kRounding);
        if (!extent) continue;
        const std::int64_t end = cellOf(extent->second + kRounding, size);
        for (std::int64_t x = cellOf(extent->first - kRounding, size); x <= end; ++x)
            if (!visit(x, y)) return;
    }
}

bool overlap(const MarkBox& a, const MarkBox& b) noexcept {
    return a.low.u < b.high.u && b.low.u < a.high.u && a.low.v < b.high.v && b.low.v < a.high.v;
}

}  // namespace

bool meets(PlanePoint from, PlanePoint to, const MarkBox& box) noexcept {
    return drawing::meetsRectangle(from, to, box.low, box.high);
}

FreeSpace::Cell& FreeSpace::cellAt(std::int64_t x, std::int64_t y) {
    const std::int64_t tileX = tileOf(x, kCells), tileY = tileOf(y, kCells);
    return tiles_[keyOf(tileX, tileY)]
        .cells[static_cast<std::size_t>((y - tileY * kCells) * kCells + x - tileX * kCells)];
}

const FreeSpace::Tile* FreeSpace::tileAt(std::int64_t x, std::int64_t y) const {
    const auto found = tiles_.find(keyOf(x, y));
    return found == tiles_.end() ? nullptr : &found->second;
}

// Marks squares of one row. Their tiles exist: the segment or text is in cells there.
void FreeSpace::mark(std::int64_t row, Range columns, Squares Tile::*squares) {
    const std::int64_t tileY = tileOf(row, kTile);
    for (std::int64_t x = columns.first; x <= columns.last;) {
        const std::int64_t tileX = tileOf(x, kTile), last = std::min(columns.last, (tileX + 1) * kTile - 1);
        if (const auto tile = tiles_.find(keyOf(tileX, tileY)); tile != tiles_.end())
            (tile->second.*squares)[static_cast<std::size_t>(row - tileY * kTile)] |=
                bitsOf(x - tileX * kTile, last - tileX * kTile);
        x = last + 1;
    }
}

void FreeSpace::markSegment(const Segment& segment, Squares Tile::*squares) {
    const std::int64_t last = cellOf(segment.around.high.v, 1);
    for (std::int64_t row = cellOf(segment.around.low.v, 1); row <= last; ++row) {
        const double low = static_cast<double>(row);
        const auto extent = extentBetween(segment.from, segment.to, low + kRounding, low + 1 - kRounding);
        if (extent)
            mark(row,
                 {numberOf(std::ceil(extent->first - 1 + kRounding), 1),
                  numberOf(std::floor(extent->second - kRounding), 1)},
                 squares);
    }
}

void FreeSpace::add(PlanePoint from, PlanePoint to, Obstacle kind) {
    const auto number = static_cast<std::uint32_t>(segments_.size());
    segments_.push_back({from,
                         to,
                         kind,
                         {{std::min(from.u, to.u) - kRounding, std::min(from.v, to.v) - kRounding},
                          {std::max(from.u, to.u) + kRounding, std::max(from.v, to.v) + kRounding}}});
    seenIn_.push_back(0);
    visitAlong(from, to, kCell, [&](std::int64_t x, std::int64_t y) {
        Cell& cell = cellAt(x, y);
        (kind == Obstacle::Light ? cell.light : cell.segments).push_back(number);
        return true;
    });
    if (kind == Obstacle::Border) markSegment(segments_.back(), &Tile::borders);
    if (kind == Obstacle::Line) markSegment(segments_.back(), &Tile::lines);
}

void FreeSpace::add(const MarkPath& path, Obstacle kind) {
    for (std::size_t n = 0; n + 1 < path.size(); ++n) add(path[n], path[n + 1], kind);
}

void FreeSpace::take(const MarkBox& box) {
    const auto number = static_cast<std::uint32_t>(taken_.size());
    taken_.push_back(box);
    for (std::int64_t y = cellOf(box.low.v, kCell); y <= cellOf(box.high.v, kCell); ++y)
        for (std::int64_t x = cellOf(box.low.u, kCell); x <= cellOf(box.high.u, kCell); ++x)
            cellAt(x, y).taken.push_back(number);
    const Range columns{numberOf(std::ceil(box.low.u), 1), numberOf(std::floor(box.high.u), 1) - 1};
    for (std::int64_t row = numberOf(std::ceil(box.low.v), 1); row < numberOf(std::floor(box.high.v), 1); ++row)
        mark(row, columns, &Tile::taken);
}

// Calls `visit(cell)` for the cells of a rectangle that have something, until it returns false.
template <class Visit>
void FreeSpace::visitCells(const MarkBox& box, const Visit& visit) const {
    const Range columns{cellOf(box.low.u, kCell), cellOf(box.high.u, kCell)},
        rows{cellOf(box.low.v, kCell), cellOf(box.high.v, kCell)};
    for (std::int64_t tileY = tileOf(rows.first, kCells); tileY <= tileOf(rows.last, kCells); ++tileY)
        for (std::int64_t tileX = tileOf(columns.first, kCells); tileX <= tileOf(columns.last, kCells); ++tileX) {
            const Tile* const tile = tileAt(tileX, tileY);
            if (tile == nullptr) continue;
            const std::int64_t left = std::max<std::int64_t>(0, columns.first - tileX * kCells),
                               right = std::min(kCells - 1, columns.last - tileX * kCells),
                               top = std::min(kCells - 1, rows.last - tileY * kCells);
            for (std::int64_t y = std::max<std::int64_t>(0, rows.first - tileY * kCells); y <= top; ++y)
                for (std::int64_t x = left; x <= right; ++x)
                    if (!visit(tile->cells[static_cast<std::size_t>(y * kCells + x)])) return;
        }
}

// Whether a marked square lies wholly within a rectangle. `marksOf(tile, row)` gives the marks.
template <class Marks>
bool FreeSpace::hasSquare(const MarkBox& box, const Marks& marksOf) const {
    const Range columns{numberOf(std::ceil(box.low.u), 1), numberOf(std::floor(box.high.u), 1) - 1},
        rows{numberOf(std::ceil(box.low.v), 1), numberOf(std::floor(box.high.v), 1) - 1};
    if (columns.first > columns.last || rows.first > rows.last) return false;
    for (std::int64_t tileY = tileOf(rows.first, kTile); tileY <= tileOf(rows.last, kTile); ++tileY)
        for (std::int64_t tileX = tileOf(columns.first, kTile); tileX <= tileOf(columns.last, kTile); ++tileX) {
            const Tile* const tile = tileAt(tileX, tileY);
            if (tile == nullptr) continue;
            const std::uint64_t within = bitsOf(std::max<std::int64_t>(0, columns.first - tileX * kTile),
                                                std::min(kTile - 1, columns.last - tileX * kTile));
            const std::int64_t top = std::min(kTile - 1, rows.last - tileY * kTile);
            for (std::int64_t y = std::max<std::int64_t>(0, rows.first - tileY * kTile); y <= top; ++y)
                if ((marksOf(*tile, static_cast<std::size_t>(y)) & within) != 0) return true;
        }
    return false;
}

MarkRaster FreeSpace::marksIn(const MarkBox& box, bool withLines) const {
    const std::int64_t left = tileOf(cellOf(box.low.u, 1), kTile), right = tileOf(cellOf(box.high.u, 1), kTile),
                       low = cellOf(box.low.v, 1), high = cellOf(box.high.v, 1);
    MarkRaster raster{left * kTile, low, static_cast<std::size_t>(right - left + 1), {}};
    raster.rows.resize(raster.words * static_cast<std::size_t>(high - low + 1));
    for (std::int64_t tileY = tileOf(low, kTile); tileY <= tileOf(high, kTile); ++tileY)
        for (std::int64_t tileX = left; tileX <= right; ++tileX) {
            const Tile* const tile = tileAt(tileX, tileY);
            if (tile == nullptr) continue;
            const std::int64_t top = std::min(high, (tileY + 1) * kTile - 1);
            for (std::int64_t row = std::max(low, tileY * kTile); row <= top; ++row) {
                const auto y = static_cast<std::size_t>(row - tileY * kTile);
                raster
                    .rows[static_cast<std::size_t>(row - low) * raster.words + static_cast<std::size_t>(tileX - left)] =
                    tile->borders[y] | tile->taken[y] | (withLines ? tile->lines[y] : 0);
            }
        }
    return raster;
}

bool FreeSpace::isTaken(const MarkBox& box) const {
    if (hasSquare(box, [](const Tile& tile, std::size_t y) { return tile.taken[y]; })) return true;
    bool found = false;
    visitCells(box, [&](const Cell& cell) {
        for (const std::uint32_t n : cell.taken) {
            ++effort_.compared;
            if ((found = overlap(box, taken_[n]))) return false;
        }
        return true;
    });
    return found;
}

bool FreeSpace::isClear(const MarkBox& box, Found& last) const {
    ++effort_.searches;
    const auto meetsTaken = [&](std::uint32_t n) {
        ++effort_.compared;
        return overlap(box, taken_[n]);
    };
    const auto meetsSegment = [&](std::uint32_t n) {
        ++effort_.compared;
        const Segment& segment = segments_[n];
        return overlap(segment.around, box) && meets(segment.from, segment.to, box);
    };
    if (last.taken != Found::kNone && meetsTaken(last.taken)) return false;
    if (last.segment != Found::kNone && meetsSegment(last.segment)) return false;
    if (hasSquare(box, [](const Tile& tile, std::size_t y) { return tile.borders[y] | tile.lines[y] | tile.taken[y]; }))
        return false;
    bool clear = true;
    visitCells(box, [&](const Cell& cell) {
        for (const std::uint32_t n : cell.taken)
            if (meetsTaken(n)) {
                last.taken = n;
                return clear = false;
            }
        for (const std::uint32_t n : cell.segments)
            if (meetsSegment(n)) {
                last.segment = n;
                return clear = false;
            }
        return true;
    });
    return clear;
}

FreeSpace::Hits FreeSpace::hitsOf(const MarkBox& box, int mostLines) const {
    ++effort_.searches;
    Hits hits;
    const auto isDecided = [&] {
        return mostLines != kAll && (hits.isTaken || hits.borders > 0 || hits.lines > mostLines);
    };
    if (mostLines != kAll) {
        if (hasSquare(box, [](const Tile& tile, std::size_t y) { return tile.borders[y]; })) hits.borders = 1;
        if (mostLines == 0 && hasSquare(box, [](const Tile& tile, std::size_t y) { return tile.lines[y]; }))
            hits.lines = 1;
        if (isDecided()) return hits;
    }
    hits.isTaken = isTaken(box);
    if (isDecided()) return hits;
    ++search_;
    visitCells(box, [&](const Cell& cell) {
        for (const auto* const list : {&cell.segments, &cell.light})
            for (const std::uint32_t n : *list) {
                if (std::exchange(seenIn_[n], search_) == search_) continue;
                ++effort_.compared;
                const Segment& segment = segments_[n];
                if (!overlap(segment.around, box) || !meets(segment.from, segment.to, box)) continue;
                ++(segment.kind == Obstacle::Border ? hits.borders
                   : segment.kind == Obstacle::Line ? hits.lines
                                                    : hits.light);
                if (isDecided()) return false;
            }
        return true;
    });
    return hits;
}

bool FreeSpace::crossesTaken(PlanePoint from, PlanePoint to, Found& last) const {
    ++effort_.searches;
    const MarkBox around{{std::min(from.u, to.u) - kRounding, std::min(from.v, to.v) - kRounding},
                         {std::max(from.u, to.u) + kRounding, std::max(from.v, to.v) + kRounding}};
    const auto meetsTaken = [&](std::uint32_t n) {
        ++effort_.compared;
        return overlap(around, taken_[n]) && meets(from, to, taken_[n]);
    };
    if (last.taken != Found::kNone && meetsTaken(last.taken)) return true;
    bool crosses = false;
    std::optional<std::uint64_t> lastKey;
    const Tile* tile = nullptr;
    visitAlong(from, to, kCell, [&](std::int64_t x, std::int64_t y) {
        const std::int64_t tileX = tileOf(x, kCells), tileY = tileOf(y, kCells);
        if (lastKey != keyOf(tileX, tileY)) {
            lastKey = keyOf(tileX, tileY);
            tile = tileAt(tileX, tileY);
        }
        if (tile == nullptr) return true;
        for (const std::uint32_t n :
             tile->cells[static_cast<std::size_t>((y - tileY * kCells) * kCells + x - tileX * kCells)].taken)
            if (meetsTaken(n)) {
                last.taken = n;
                crosses = true;
                return false;
            }
        return true;
    });
    return crosses;
}

FreeSpace freeSpaceOf(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                      double millimetres) {
    FreeSpace space;
    const auto isSpace = [&](std::uint32_t label) {
        return label == volume::kNoLabel || model::isSpace(volume.labels.labels[label].className);
    };
    const auto onPaper = [&](PlanePoint p) { return PlanePoint{p.u * millimetres, p.v * millimetres}; };
    const auto addPath = [&](const std::vector<PlanePoint>& points, Obstacle kind) {
        for (std::size_t n = 0; n + 1 < points.size(); ++n) space.add(onPaper(points[n]), onPaper(points[n + 1]), kind);
    };
    for (const drawing::SectionBorder& border : drawing.borders)
        if (!isSpace(border.left) || !isSpace(border.right)) addPath(border.points, Obstacle::Border);
    for (const drawing::SectionLine& line : drawing.lines) addPath(line.points, Obstacle::Border);
    for (const drawing::BeyondLine& line : drawing.beyond)
        space.add(onPaper(line.from), onPaper(line.to),
                  line.kind == drawing::BeyondKind::Visible ? Obstacle::Line : Obstacle::Light);
    for (const drawing::DoorSwing& door : drawing.doors) {
        for (const auto& line : door.lines) addPath(line, Obstacle::Border);
        for (const auto& arc : door.arcs) addPath(drawing::pointsOf(arc), Obstacle::Border);
    }
    const DimensionMarks dimensions = placeDimensions(drawing, drawnBox(drawing), millimetres);
    for (const DimensionMark& mark : dimensions.marks) {
        space.add(mark.line.from, mark.line.to, Obstacle::Border);
        for (const auto* const lines : {&mark.feet, &mark.ticks})
            for (const MarkLine& line : *lines) space.add(line.from, line.to, Obstacle::Border);
        if (mark.text.text.empty()) continue;
        const double half = 0.5 * widthOnPaper(mark.text.text, mark.text.size) + 0.4, high = mark.text.size;
        const PlanePoint at = mark.text.at;
        if (mark.text.isUpright)
            space.take({{at.u - high, at.v - half}, {at.u + 0.4, at.v + half}});
        else
            space.take({{at.u - half, at.v - 0.4}, {at.u + half, at.v + high}});
    }
    for (const MarkText& text : dimensions.heights) {
        const double half = 0.5 * widthOnPaper(text.text, text.size) + 0.4, high = text.size;
        if (text.isUpright)
            space.take({{text.at.u - high, text.at.v - half}, {text.at.u + 0.4, text.at.v + half}});
        else
            space.take({{text.at.u - half, text.at.v - 0.4}, {text.at.u + half, text.at.v + high}});
    }
    return space;
}

std::pair<double, double> sizeOfLines(const std::vector<std::string>& lines, double size) {
    double width = 0;
    for (const std::string& line : lines) width = std::max(width, widthOnPaper(line, size));
    return {width, size * (1 + kLinePitch * (static_cast<double>(lines.size()) - 1))};
}

}  // namespace svt::writers
