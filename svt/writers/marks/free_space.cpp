#include <svt/writers/marks/free_space.hpp>

#include <svt/drawing/clip_segment.hpp>
#include <svt/model/classes.hpp>
#include <svt/writers/canvas/sheet_canvas.hpp>
#include <svt/writers/drawing/drawing_style.hpp>

#include <algorithm>
#include <cmath>

namespace svt::writers {
namespace {

using drawing::PlanePoint;

constexpr double kCell = 5;         // millimetres
constexpr int kSquares = 5;         // of 1 mm along a cell
constexpr double kRounding = 1e-6;  // millimetres
constexpr double kMostCells = 1e6;  // a cell beyond is one of the border

std::uint64_t keyOf(std::int64_t x, std::int64_t y) noexcept {
    return static_cast<std::uint64_t>(x) << 32 ^ (static_cast<std::uint64_t>(y) & 0xFFFFFFFFu);
}

std::int64_t cellOf(double at) noexcept {
    return static_cast<std::int64_t>(std::floor(std::clamp(at / kCell, -kMostCells, kMostCells)));
}

template <class Visit>
void forCells(const MarkBox& box, const Visit& visit) {
    for (std::int64_t x = cellOf(box.low.u); x <= cellOf(box.high.u); ++x)
        for (std::int64_t y = cellOf(box.low.v); y <= cellOf(box.high.v); ++y) visit(x, y);
}

bool overlap(const MarkBox& a, const MarkBox& b) noexcept {
    return a.low.u < b.high.u && b.low.u < a.high.u && a.low.v < b.high.v && b.low.v < a.high.v;
}

}  // namespace

bool meets(PlanePoint from, PlanePoint to, const MarkBox& box) noexcept {
    return drawing::meetsRectangle(from, to, box.low, box.high);
}

void FreeSpace::add(PlanePoint from, PlanePoint to, Obstacle kind) {
    const auto number = static_cast<std::uint32_t>(segments_.size());
    const MarkBox around{{std::min(from.u, to.u), std::min(from.v, to.v)},
                         {std::max(from.u, to.u), std::max(from.v, to.v)}};
    segments_.push_back({from,
                         to,
                         kind,
                         {{around.low.u - kRounding, around.low.v - kRounding},
                          {around.high.u + kRounding, around.high.v + kRounding}}});
    seenIn_.push_back(0);
    forCells(around, [&](std::int64_t x, std::int64_t y) {
        const double left = double(x) * kCell, low = double(y) * kCell;
        if (!meets(from, to, {{left, low}, {left + kCell, low + kCell}})) return;
        Cell& cell = cells_[keyOf(x, y)];
        cell.segments.push_back(number);
        if (kind == Obstacle::Border) cell.borders |= touchedBits(segments_.back(), x, y);
        if (kind == Obstacle::Line) cell.lines |= touchedBits(segments_.back(), x, y);
    });
}

void FreeSpace::add(const MarkPath& path, Obstacle kind) {
    for (std::size_t n = 0; n + 1 < path.size(); ++n) add(path[n], path[n + 1], kind);
}

FreeSpace::Hits FreeSpace::hitsOf(const MarkBox& box, int mostLines) const {
    Hits hits;
    hits.isTaken = std::any_of(taken_.begin(), taken_.end(), [&](const MarkBox& other) { return overlap(box, other); });
    const auto isDecided = [&] {
        return mostLines != kAll && (hits.isTaken || hits.borders > 0 || hits.lines > mostLines);
    };
    if (isDecided()) return hits;
    near_.clear();
    forCells(box, [&](std::int64_t x, std::int64_t y) {
        const auto cell = cells_.find(keyOf(x, y));
        if (cell == cells_.end()) return;
        near_.push_back(&cell->second);
        if (mostLines == kAll) return;
        const std::uint32_t within = bitsWithin(box, x, y);
        if ((cell->second.borders & within) != 0) hits.borders = 1;
        if (mostLines == 0 && (cell->second.lines & within) != 0) hits.lines = 1;
    });
    if (isDecided()) return hits;
    ++search_;
    for (const Cell* const cell : near_)
        for (const std::uint32_t n : cell->segments) {
            if (std::exchange(seenIn_[n], search_) == search_) continue;
            const Segment& segment = segments_[n];
            if (!overlap(segment.around, box) || !meets(segment.from, segment.to, box)) continue;
            ++(segment.kind == Obstacle::Border ? hits.borders
               : segment.kind == Obstacle::Line ? hits.lines
                                                : hits.light);
            if (isDecided()) return hits;
        }
    return hits;
}

std::uint32_t FreeSpace::touchedBits(const Segment& segment, std::int64_t x, std::int64_t y) noexcept {
    std::uint32_t bits = 0;
    for (int j = 0; j < kSquares; ++j)
        for (int i = 0; i < kSquares; ++i) {
            const PlanePoint low{double(x) * kCell + i + kRounding, double(y) * kCell + j + kRounding};
            const MarkBox square{low, {low.u + 1 - 2 * kRounding, low.v + 1 - 2 * kRounding}};
            if (overlap(segment.around, square) && meets(segment.from, segment.to, square))
                bits |= 1u << (j * kSquares + i);
        }
    return bits;
}

// The squares that lie wholly within a rectangle.
std::uint32_t FreeSpace::bitsWithin(const MarkBox& box, std::int64_t x, std::int64_t y) noexcept {
    const auto limits = [](double low, double high) {
        return std::pair(static_cast<int>(std::clamp(std::ceil(low), 0.0, double(kSquares))),
                         static_cast<int>(std::clamp(std::floor(high), 0.0, double(kSquares))));
    };
    const auto [left, right] = limits(box.low.u - double(x) * kCell, box.high.u - double(x) * kCell);
    const auto [bottom, top] = limits(box.low.v - double(y) * kCell, box.high.v - double(y) * kCell);
    if (left >= right) return 0;
    const std::uint32_t row = ((1u << (right - left)) - 1) << left;
    std::uint32_t bits = 0;
    for (int j = bottom; j < top; ++j) bits |= row << (j * kSquares);
    return bits;
}

bool FreeSpace::crossesTaken(PlanePoint from, PlanePoint to) const noexcept {
    const MarkBox around{{std::min(from.u, to.u) - kRounding, std::min(from.v, to.v) - kRounding},
                         {std::max(from.u, to.u) + kRounding, std::max(from.v, to.v) + kRounding}};
    return std::any_of(taken_.begin(), taken_.end(),
                       [&](const MarkBox& box) { return overlap(around, box) && meets(from, to, box); });
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
