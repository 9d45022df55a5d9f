#include <svt/drawing/beyond/merge_lines.hpp>

#include <svt/core/parallel.hpp>
#include <svt/drawing/beyond/line_parts.hpp>
#include <svt/drawing/beyond/plane_index.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace svt::drawing {
namespace {

constexpr double kSameLine = 1e-4;   // metres
constexpr double kParallel = 0.02;   // sine
constexpr double kStraight = 1e-3;   // sine: pieces that go on
constexpr double kSpeck = 3e-3;      // metres: shorter isolated lines are dropped
constexpr double kSamePoint = 1e-5;  // metres

double lengthOfLine(const BeyondLine& line) noexcept {
    return std::hypot(line.to.u - line.from.u, line.to.v - line.from.v);
}

auto placeOf(const BeyondLine& line) noexcept {
    return std::tuple(line.from.u, line.from.v, line.to.u, line.to.v, line.label);
}

// The lines of the cut in the drawing: borders of components, and sheets.
std::vector<BeyondLine> linesOfCut(const SectionDrawing& drawing, const volume::LabelTable& table) {
    std::vector<BeyondLine> lines;
    const auto isSpace = [&](std::uint32_t label) {
        return label == volume::kNoLabel || model::isSpace(table.labels[label].className);
    };
    const auto add = [&](const std::vector<PlanePoint>& points) {
        for (std::size_t n = 0; n + 1 < points.size(); ++n) lines.push_back({points[n], points[n + 1], 0, {}});
    };
    for (const SectionBorder& border : drawing.borders)
        if (!isSpace(border.left) || !isSpace(border.right)) add(border.points);
    for (const SectionLine& line : drawing.lines)
        if (table.labels[line.label].className != "ClosureSurface") add(line.points);
    return lines;
}

// The part of `line` that lies on `other`.
bool partOn(const BeyondLine& line, const BeyondLine& other, LinePart& part) noexcept {
    const double length = lengthOfLine(line), otherLength = lengthOfLine(other);
    if (!(otherLength > 0)) return false;
    const double eu = (other.to.u - other.from.u) / otherLength, ev = (other.to.v - other.from.v) / otherLength;
    const double du = line.to.u - line.from.u, dv = line.to.v - line.from.v;
    const double turn = eu * dv - ev * du;
    if (std::abs(turn) > kParallel * length) return false;
    const double off = eu * (line.from.v - other.from.v) - ev * (line.from.u - other.from.u);
    const double along = eu * (line.from.u - other.from.u) + ev * (line.from.v - other.from.v);
    const double change = eu * du + ev * dv;
    return clipPart(part, off + kSameLine, turn) && clipPart(part, kSameLine - off, -turn) &&
           clipPart(part, along + kSameLine, change) && clipPart(part, otherLength + kSameLine - along, -change) &&
           part.to > part.from;
}

// Keeps the first of lines that overlap. The first `fixed` lines are not checked.
std::vector<BeyondLine> withoutDoubles(const std::vector<BeyondLine>& lines, std::size_t fixed, int threads) {
    std::vector<PlanePoint> corners;
    std::vector<std::uint32_t> starts{0};
    for (const BeyondLine& line : lines) {
        corners.push_back(line.from);
        corners.push_back(line.to);
        starts.push_back(static_cast<std::uint32_t>(corners.size()));
    }
    const PlaneIndex index(corners, starts, 2 * kSameLine);
    std::vector<std::vector<LinePart>> left(lines.size() - fixed);
    parallelFor(left.size(), 64, threads, [&](std::size_t begin, std::size_t end) {
        PlaneIndex::Seen seen;
        std::vector<LinePart> covered;
        for (std::size_t n = begin; n < end; ++n) {
            const BeyondLine& line = lines[fixed + n];
            covered.clear();
            index.visitNear(line.from, line.to, seen, [&](std::uint32_t item) {
                LinePart part;
                if (item >= fixed + n || !partOn(line, lines[item], part)) return true;
                // A line that begins where the other ends keeps all of its length.
                if ((part.to - part.from) * lengthOfLine(line) > 2 * kSameLine) covered.push_back(part);
                return true;
            });
            left[n] = partsLeft({0, 1}, covered, kShortestPiece / lengthOfLine(line));
        }
    });
    std::vector<BeyondLine> kept;
    for (std::size_t n = 0; n < left.size(); ++n) {
        const BeyondLine& line = lines[fixed + n];
        const auto at = [&](double t) {
            if (t <= 0) return line.from;
            if (t >= 1) return line.to;
            return PlanePoint{line.from.u + (line.to.u - line.from.u) * t, line.from.v + (line.to.v - line.from.v) * t};
        };
        for (const LinePart& part : left[n]) kept.push_back({at(part.from), at(part.to), line.label, line.kind});
    }
    return kept;
}

// One end of a line, by a rounded place.
struct BeyondEnd {
    std::int64_t u = 0, v = 0;
    std::uint32_t line = 0;
    bool isTo = false;
    [[nodiscard]] auto place() const noexcept { return std::tuple(u, v); }
};

// Joins lines that go on in the same direction. Each end is joined once at most. Short lines at which no other ends are
// what is left of steps between faces that should be one; they are left out.
std::vector<BeyondLine> joined(const std::vector<BeyondLine>& lines) {
    constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    std::vector<BeyondEnd> ends;
    for (std::uint32_t n = 0; n < lines.size(); ++n)
        for (const bool isTo : {false, true}) {
            const PlanePoint p = isTo ? lines[n].to : lines[n].from;
            ends.push_back({std::llround(p.u / kSamePoint), std::llround(p.v / kSamePoint), n, isTo});
        }
    std::sort(ends.begin(), ends.end(), [](const BeyondEnd& a, const BeyondEnd& b) {
        return std::tuple(a.u, a.v, a.line, a.isTo) < std::tuple(b.u, b.v, b.line, b.isTo);
    });
    std::vector<std::uint32_t> next(2 * lines.size(), kNone);  // end 2 n + isTo: the end that it is joined with
    const auto goesOn = [&](const BeyondEnd& a, const BeyondEnd& b) {
        const BeyondLine &x = lines[a.line], &y = lines[b.line];
        if (a.line == b.line || x.label != y.label || x.kind != y.kind) return false;
        const double s = a.isTo ? 1 : -1, t = b.isTo ? -1 : 1;
        const double xu = (x.to.u - x.from.u) * s, xv = (x.to.v - x.from.v) * s;
        const double yu = (y.to.u - y.from.u) * t, yv = (y.to.v - y.from.v) * t;
        return xu * yu + xv * yv > 0 &&
               std::abs(xu * yv - xv * yu) < kStraight * std::hypot(xu, xv) * std::hypot(yu, yv);
    };
    std::vector<std::uint8_t> isAlone(next.size(), 0);
    for (std::size_t first = 0; first < ends.size();) {
        std::size_t end = first;
        while (end < ends.size() && ends[end].place() == ends[first].place()) ++end;
        if (end == first + 1) isAlone[2 * ends[first].line + (ends[first].isTo ? 1 : 0)] = 1;
        for (std::size_t a = first; a < end; ++a)
            for (std::size_t b = a + 1; b < end; ++b) {
                const std::uint32_t x = 2 * ends[a].line + (ends[a].isTo ? 1 : 0),
                                    y = 2 * ends[b].line + (ends[b].isTo ? 1 : 0);
                if (next[x] != kNone || next[y] != kNone || !goesOn(ends[a], ends[b])) continue;
                next[x] = y;
                next[y] = x;
            }
        first = end;
    }
    std::vector<std::uint8_t> isDone(lines.size(), 0);
    std::vector<BeyondLine> result;
    const auto pointOf = [&](std::uint32_t end) { return (end & 1) != 0 ? lines[end / 2].to : lines[end / 2].from; };
    for (std::uint32_t start = 0; start < next.size(); ++start) {
        if (next[start] != kNone || isDone[start / 2] != 0) continue;
        std::uint32_t end = start ^ 1u;
        isDone[start / 2] = 1;
        while (next[end] != kNone) {
            isDone[next[end] / 2] = 1;
            end = next[end] ^ 1u;
        }
        const BeyondLine line{pointOf(start), pointOf(end), lines[start / 2].label, lines[start / 2].kind};
        if (isAlone[start] == 0 || isAlone[end] == 0 || lengthOfLine(line) >= kSpeck) result.push_back(line);
    }
    return result;
}

}  // namespace

std::vector<BeyondLine> mergeLines(std::vector<BeyondLine> lines, const SectionDrawing& drawing,
                                   const volume::LabelTable& table, int threads) {
    for (BeyondLine& line : lines)
        if (std::tuple(line.to.u, line.to.v) < std::tuple(line.from.u, line.from.v)) std::swap(line.from, line.to);
    std::sort(lines.begin(), lines.end(), [](const BeyondLine& a, const BeyondLine& b) {
        if (a.kind != b.kind) return a.kind < b.kind;
        const double x = lengthOfLine(a), y = lengthOfLine(b);
        return x != y ? x > y : placeOf(a) < placeOf(b);
    });
    std::vector<BeyondLine> all = linesOfCut(drawing, table);
    const std::size_t fixed = all.size();
    all.insert(all.end(), lines.begin(), lines.end());
    std::vector<BeyondLine> merged = joined(withoutDoubles(all, fixed, threads));
    for (BeyondLine& line : merged)
        if (std::tuple(line.to.u, line.to.v) < std::tuple(line.from.u, line.from.v)) std::swap(line.from, line.to);
    std::sort(merged.begin(), merged.end(), [](const BeyondLine& a, const BeyondLine& b) {
        return std::tuple(a.kind, a.label) != std::tuple(b.kind, b.label)
                   ? std::tuple(a.kind, a.label) < std::tuple(b.kind, b.label)
                   : placeOf(a) < placeOf(b);
    });
    return merged;
}

}  // namespace svt::drawing
