#include <svt/drawing/field/field_contours.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace svt::drawing {
namespace {

struct Valued {
    PlanePoint at;
    double value = 0;
};
using Triangle = std::array<Valued, 3>;
using Segment = std::pair<PlanePoint, PlanePoint>;

// The four triangles of a cell around its middle, counter-clockwise.
std::array<Triangle, 4> trianglesOf(const RegionGrid& grid, std::size_t column, std::size_t row) {
    std::array<Valued, 4> corners;
    Valued middle;
    for (int n = 0; n < 4; ++n) {
        Valued& corner = corners[static_cast<std::size_t>(n)];
        corner = {grid.corner(column, row, n), grid.value(column, row, n)};
        middle.value += corner.value / 4;
    }
    middle.at = {(corners[0].at.u + corners[2].at.u) / 2, (corners[0].at.v + corners[2].at.v) / 2};
    std::array<Triangle, 4> triangles;
    for (std::size_t n = 0; n < 4; ++n) triangles[n] = {corners[n], corners[(n + 1) % 4], middle};
    return triangles;
}

bool isBefore(PlanePoint a, PlanePoint b) noexcept { return std::tie(a.u, a.v) < std::tie(b.u, b.v); }

// Where an edge has a value; the same point for both directions of the edge.
PlanePoint placeOf(Valued a, Valued b, double value) noexcept {
    if (isBefore(b.at, a.at)) std::swap(a, b);
    const double t = (value - a.value) / (b.value - a.value);
    return {a.at.u + (b.at.u - a.at.u) * t, a.at.v + (b.at.v - a.at.v) * t};
}

// The line of a value through a triangle, with higher values to its left; false: none.
bool lineIn(const Triangle& triangle, double level, Segment& segment) noexcept {
    bool hasStart = false, hasEnd = false;
    for (std::size_t n = 0; n < 3; ++n) {
        const Valued &a = triangle[n], &b = triangle[(n + 1) % 3];
        const bool isAbove = a.value >= level, willBeAbove = b.value >= level;
        if (isAbove == willBeAbove) continue;
        // Around the triangle, the part above begins where the line ends.
        (isAbove ? segment.first : segment.second) = placeOf(a, b, level);
        (isAbove ? hasStart : hasEnd) = true;
    }
    return hasStart && hasEnd && !(segment.first == segment.second);
}

// The part of a triangle with values in [low, high], counter-clockwise.
Piece bandIn(const Triangle& triangle, double low, double high) {
    std::vector<Valued> part(triangle.begin(), triangle.end());
    for (const auto& [level, sign] : {std::pair(low, 1.0), std::pair(high, -1.0)}) {
        std::vector<Valued> kept;
        for (std::size_t n = 0; n < part.size(); ++n) {
            const Valued &a = part[n], &b = part[(n + 1) % part.size()];
            const double sideA = sign * (a.value - level), sideB = sign * (b.value - level);
            if (sideA >= 0) kept.push_back(a);
            if ((sideA > 0 && sideB < 0) || (sideA < 0 && sideB > 0)) kept.push_back({placeOf(a, b, level), level});
        }
        part = std::move(kept);
    }
    Piece piece;
    for (const Valued& point : part) piece.push_back(point.at);
    if (piece.size() < 3) piece.clear();
    return piece;
}

// Joins segments, which share their ends exactly, to polylines.
class LineJoiner {
public:
    void add(PlanePoint from, PlanePoint to) {
        const Key a = keyOf(from), b = keyOf(to);
        if (a == b) return;
        starts_.emplace(a, segments_.size());
        segments_.push_back({from, to, b, false});
        ++ends_[b];
    }
    std::vector<std::vector<PlanePoint>> join() {
        std::vector<std::vector<PlanePoint>> lines;
        // First those with an open start, then closed ones.
        for (const bool isOpen : {true, false})
            for (auto& [key, number] : starts_) {
                if (segments_[number].isUsed || (isOpen && ends_.count(key) != 0)) continue;
                std::vector<PlanePoint>& line = lines.emplace_back();
                line.push_back(segments_[number].from);
                for (std::size_t next = number; next != kNoSegment; next = after(next)) {
                    segments_[next].isUsed = true;
                    line.push_back(segments_[next].to);
                }
                if (keyOf(line.front()) == keyOf(line.back())) line.back() = line.front();
                straighten(line);
            }
        return lines;
    }

private:
    using Key = std::pair<std::int64_t, std::int64_t>;
    static constexpr std::size_t kNoSegment = ~std::size_t{0};
    static Key keyOf(PlanePoint p) noexcept {
        const plane::Point at = onFieldGrid(p);
        return {at.u, at.v};
    }
    struct Part {
        PlanePoint from, to;
        Key end;
        bool isUsed;
    };
    [[nodiscard]] std::size_t after(std::size_t number) const {
        const auto [first, last] = starts_.equal_range(segments_[number].end);
        for (auto next = first; next != last; ++next)
            if (!segments_[next->second].isUsed) return next->second;
        return kNoSegment;
    }
    // Drops points on the straight line between their neighbours, within a unit of the grid.
    static void straighten(std::vector<PlanePoint>& line) {
        std::vector<PlanePoint> kept;
        for (std::size_t n = 0; n < line.size(); ++n) {
            if (kept.size() > 0 && n + 1 < line.size()) {
                const PlanePoint a = kept.back(), b = line[n], c = line[n + 1];
                const double u = c.u - a.u, v = c.v - a.v, length = std::hypot(u, v);
                const double away = std::abs(u * (b.v - a.v) - v * (b.u - a.u));
                const double along = u * (b.u - a.u) + v * (b.v - a.v);
                if (length > 0 && away <= 0.25 * kFieldUnit * length && along > 0 && along < length * length) continue;
            }
            kept.push_back(line[n]);
        }
        line = std::move(kept);
    }

    std::vector<Part> segments_;
    std::multimap<Key, std::size_t> starts_;
    std::map<Key, int> ends_;
};

std::int64_t floorOf(double value) { return static_cast<std::int64_t>(std::floor(value)); }
std::int64_t ceilOf(double value) { return static_cast<std::int64_t>(std::ceil(value)); }

struct CellRange {
    double low, high;
};
CellRange rangeOf(const RegionGrid& grid, std::size_t column, std::size_t row) noexcept {
    CellRange range{kInfinity, -kInfinity};
    for (int n = 0; n < 4; ++n) {
        range.low = std::min(range.low, grid.value(column, row, n));
        range.high = std::max(range.high, grid.value(column, row, n));
    }
    return range;
}

// Adds the part of a cell in one band.
void addCell(const RegionGrid& grid, std::size_t column, std::size_t row, CellRange band,
             const std::vector<Ring>* rings, BandOutline& outline) {
    const double low = band.low, high = band.high;
    const auto [least, most] = rangeOf(grid, column, row);
    if (least >= low && most <= high) {
        if (rings != nullptr) {
            for (const Ring& ring : *rings) outline.add(ring);
        } else {
            outline.add({grid.corner(column, row, 0), grid.corner(column, row, 1), grid.corner(column, row, 2),
                         grid.corner(column, row, 3)});
        }
        return;
    }
    for (const Triangle& triangle : trianglesOf(grid, column, row)) {
        const Piece piece = bandIn(triangle, low, high);
        if (piece.empty()) continue;
        if (rings == nullptr) {
            outline.add(piece);
            continue;
        }
        for (Ring part : *rings) {
            for (std::size_t n = 0; n < piece.size() && !part.empty(); ++n)
                part = clipRing(part, piece[n], piece[(n + 1) % piece.size()]);
            if (!part.empty()) outline.add(part);
        }
    }
}

}  // namespace

void BandOutline::add(const Ring& ring) {
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
        outline.addEdge(onFieldGrid(a), onFieldGrid(b));
        area += ((a.u - ring[0].u) * (b.v - ring[0].v) - (a.v - ring[0].v) * (b.u - ring[0].u)) / 2;
    }
}

void addIsolines(const RegionGrid& grid, double step, std::vector<FieldIsoline>& lines) {
    std::map<std::int64_t, LineJoiner> joiners;
    for (std::size_t row = 0; row < grid.rows(); ++row)
        for (std::size_t column = 0; column < grid.columns(); ++column) {
            const RegionGrid::Place place = grid.placeOf(column, row);
            if (place != RegionGrid::Place::Inside && place != RegionGrid::Place::Border) continue;
            const auto [low, high] = rangeOf(grid, column, row);
            if (ceilOf(low / step) > floorOf(high / step)) continue;
            for (const Triangle& triangle : trianglesOf(grid, column, row))
                for (std::int64_t k = ceilOf(low / step); k <= floorOf(high / step); ++k) {
                    Segment segment;
                    if (!lineIn(triangle, double(k) * step, segment)) continue;
                    if (place == RegionGrid::Place::Inside) {
                        joiners[k].add(segment.first, segment.second);
                        continue;
                    }
                    for (const auto& [from, to] : grid.clip(column, row, segment.first, segment.second))
                        joiners[k].add(from, to);
                }
        }
    for (auto& [k, joiner] : joiners)
        for (auto& line : joiner.join()) lines.push_back({double(k) * step, std::move(line)});
}

void addBands(const RegionGrid& grid, double step, double shift, BandOutlines& bands) {
    for (std::size_t row = 0; row < grid.rows(); ++row)
        for (std::size_t column = 0; column < grid.columns(); ++column) {
            const RegionGrid::Place place = grid.placeOf(column, row);
            if (place != RegionGrid::Place::Inside && place != RegionGrid::Place::Border) continue;
            std::vector<Ring> rings;
            const bool isInside = place == RegionGrid::Place::Inside;
            if (!isInside) rings = grid.ringsIn(column, row);
            const auto [low, high] = rangeOf(grid, column, row);
            const std::int64_t first = floorOf(low / step - shift);
            const std::int64_t last = high > low ? std::max(first, ceilOf(high / step - shift) - 1) : first;
            for (std::int64_t k = first; k <= last; ++k)
                addCell(grid, column, row, {(double(k) + shift) * step, (double(k + 1) + shift) * step},
                        isInside ? nullptr : &rings, bands[k]);
        }
}

void addMissing(const RegionGrid& grid, BandOutline& missing) {
    for (std::size_t row = 0; row < grid.rows(); ++row)
        for (std::size_t column = 0; column < grid.columns(); ++column)
            if (grid.placeOf(column, row) == RegionGrid::Place::Missing && grid.isInComponent(column, row))
                for (const Ring& ring : grid.ringsIn(column, row)) missing.add(ring);
}

}  // namespace svt::drawing
