#include <svt/drawing/section/section_rings.hpp>

#include <svt/plane/rings.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

namespace svt::drawing {
namespace {

using volume::kNoLabel;

// An edge between two labels; from < to.
struct BorderEdge {
    plane::Point from, to;
    std::uint32_t left = kNoLabel, right = kNoLabel;
};

// Finds the labels on both sides of each edge; edges between equal labels cancel.
std::vector<BorderEdge> cancel(std::vector<PieceEdge> edges) {
    struct Side {
        plane::Point from, to;
        std::uint32_t label = 0;
        std::int32_t isLeft = 0;
    };
    std::vector<Side> sides;
    sides.reserve(edges.size());
    for (const PieceEdge& edge : edges) {
        const bool isForward = edge.from < edge.to;
        sides.push_back({isForward ? edge.from : edge.to, isForward ? edge.to : edge.from, edge.label, isForward});
    }
    edges = {};
    std::ranges::sort(sides, [](const Side& a, const Side& b) {
        return std::tie(a.from, a.to, a.label, a.isLeft) < std::tie(b.from, b.to, b.label, b.isLeft);
    });
    std::vector<BorderEdge> borders;
    std::vector<std::uint32_t> left, right;
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        left.clear();
        right.clear();
        while (end < sides.size() && sides[end].from == sides[begin].from && sides[end].to == sides[begin].to) {
            const std::uint32_t label = sides[end].label;
            std::int32_t count = 0;
            for (; end < sides.size() && sides[end].from == sides[begin].from && sides[end].to == sides[begin].to &&
                   sides[end].label == label;
                 ++end)
                count += sides[end].isLeft != 0 ? 1 : -1;
            for (; count > 0; --count) left.push_back(label);
            for (; count < 0; ++count) right.push_back(label);
        }
        for (std::size_t n = 0; n < std::max(left.size(), right.size()); ++n)
            borders.push_back({sides[begin].from, sides[begin].to, n < left.size() ? left[n] : kNoLabel,
                               n < right.size() ? right[n] : kNoLabel});
    }
    return borders;
}

// One end of an edge.
struct EdgeEnd {
    plane::Point point;
    std::uint32_t edge = 0;
    bool isStart = true;
};

class EdgeJoiner {
public:
    explicit EdgeJoiner(std::vector<BorderEdge> edges) : edges_(std::move(edges)), isUsed_(edges_.size(), 0) {
        ends_.reserve(2 * edges_.size());
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            ends_.push_back({edges_[e].from, e, true});
            ends_.push_back({edges_[e].to, e, false});
        }
        std::ranges::sort(ends_, [](const EdgeEnd& a, const EdgeEnd& b) {
            return std::tie(a.point, a.edge) < std::tie(b.point, b.edge);
        });
        endAt_.resize(2 * edges_.size());
        for (std::uint32_t n = 0; n < ends_.size(); ++n) endAt_[2 * ends_[n].edge + (ends_[n].isStart ? 0 : 1)] = n;
    }

    std::vector<DrawingBorder> run() {
        // Borders that start at nodes first; the rest are closed, and start at their smallest point, which is a corner.
        for (const bool isClosed : {false, true})
            for (std::uint32_t n = 0; n < ends_.size(); ++n)
                if (isUsed_[ends_[n].edge] == 0 && (isClosed || isNode(n))) follow(n);
        return std::move(borders_);
    }

private:
    // Whether borders end here: not exactly one border passes through the point.
    [[nodiscard]] bool isNode(std::uint32_t n) const noexcept { return partnerOf(n) == kNoEnd; }

    // The other end at the same point, if there are exactly two and their edges have the same labels on each side.
    [[nodiscard]] std::uint32_t partnerOf(std::uint32_t n) const noexcept {
        std::uint32_t first = n, end = n + 1;
        while (first > 0 && ends_[first - 1].point == ends_[n].point) --first;
        while (end < ends_.size() && ends_[end].point == ends_[n].point) ++end;
        if (end - first != 2) return kNoEnd;
        const std::uint32_t other = first == n ? n + 1 : first;
        const auto [leftOut, rightOut] = sidesFrom(n);
        const auto [leftIn, rightIn] = sidesFrom(other);
        return leftOut == rightIn && rightOut == leftIn ? other : kNoEnd;
    }

    // Labels to the left and right of an edge, looking away from this end.
    [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> sidesFrom(std::uint32_t n) const noexcept {
        const BorderEdge& edge = edges_[ends_[n].edge];
        return ends_[n].isStart ? std::pair(edge.left, edge.right) : std::pair(edge.right, edge.left);
    }

    void follow(std::uint32_t n) {
        DrawingBorder border;
        std::tie(border.left, border.right) = sidesFrom(n);
        border.points.push_back(ends_[n].point);
        while (n != kNoEnd && isUsed_[ends_[n].edge] == 0) {
            isUsed_[ends_[n].edge] = 1;
            const std::uint32_t far = endAt_[2 * ends_[n].edge + (ends_[n].isStart ? 1 : 0)];
            border.points.push_back(ends_[far].point);
            n = partnerOf(far);
        }
        borders_.push_back(std::move(border));
    }

    static constexpr std::uint32_t kNoEnd = 0xFFFFFFFFu;
    std::vector<BorderEdge> edges_;
    std::vector<std::uint8_t> isUsed_;
    std::vector<EdgeEnd> ends_;         // by point
    std::vector<std::uint32_t> endAt_;  // 2 * edge + (start ? 0 : 1) -> index into ends_
    std::vector<DrawingBorder> borders_;
};

// Squared distance of p from a line segment, square drawing units.
double squareDistance(plane::Point p, plane::Point a, plane::Point b) noexcept {
    const plane::Point along = b - a, to = p - a;
    const double length2 = static_cast<double>(dot(along, along));
    const double t = length2 > 0 ? std::clamp(static_cast<double>(dot(along, to)) / length2, 0.0, 1.0) : 0;
    const double u = static_cast<double>(to.u) - t * static_cast<double>(along.u);
    const double v = static_cast<double>(to.v) - t * static_cast<double>(along.v);
    return u * u + v * v;
}

void straighten(DrawingBorder& border, double tolerance) {
    const std::vector<plane::Point>& points = border.points;
    const std::size_t last = points.size() - 1;
    std::vector<std::uint8_t> isKept(points.size(), 0);
    isKept[0] = isKept[last] = 1;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, last}};
    const bool isClosed = points.front() == points.back();
    while (!open.empty()) {
        const auto [from, to] = open.back();
        open.pop_back();
        double worst = -1;
        std::size_t furthest = from;
        for (std::size_t n = from + 1; n < to; ++n)
            if (const double d = squareDistance(points[n], points[from], points[to]); d > worst) {
                worst = d;
                furthest = n;
            }
        const bool isWhole = isClosed && from == 0 && to == last;
        if (furthest == from || (worst <= tolerance * tolerance && !isWhole)) continue;
        isKept[furthest] = 1;
        open.emplace_back(from, furthest);
        open.emplace_back(furthest, to);
    }
    std::vector<plane::Point> kept;
    for (std::size_t n = 0; n < points.size(); ++n)
        if (isKept[n] != 0) kept.push_back(points[n]);
    border.points = std::move(kept);
}

// A border in the direction that has a given label on its left.
struct HalfBorder {
    std::uint32_t border = 0;
    bool isForward = true;
};

// Finds the outer ring that contains a hole. Edges are binned by v, so that a query tests few of them.
class OuterFinder {
public:
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

    explicit OuterFinder(std::span<const DrawingPolygon> polygons) {
        std::size_t edges = 0;
        plane::Box box;
        for (const DrawingPolygon& polygon : polygons) {
            areas_.push_back(twiceSignedArea(polygon.rings.front()));
            edges += polygon.rings.front().size();
            for (const RingPoint& p : polygon.rings.front()) box.add(p.point);
        }
        const auto levels = static_cast<std::int64_t>(std::clamp<std::size_t>(edges / 32, 1, 4096));
        low_ = box.low.v;
        step_ = (box.high.v - low_) / levels + 1;
        levels_.resize(static_cast<std::size_t>(levels));
        for (std::size_t o = 0; o < polygons.size(); ++o) {
            const auto& ring = polygons[o].rings.front();
            for (std::size_t n = 0; n < ring.size(); ++n)
                addEdge({ring[n].point, ring[(n + 1) % ring.size()].point, o});
        }
    }

    // The smallest outer ring around the midpoint of the hole's first edge; rings of one label share no edges.
    [[nodiscard]] std::size_t find(const std::vector<RingPoint>& hole) const {
        // Twice the midpoint, which is an integer point.
        const std::int64_t u = hole[0].point.u + hole[1].point.u, v = hole[0].point.v + hole[1].point.v;
        const std::int64_t level = levelOf((v - (v & 1)) / 2);
        if (level < 0 || level >= std::ssize(levels_)) return kNone;
        std::vector<std::size_t> crossed;
        for (const Edge& edge : levels_[static_cast<std::size_t>(level)])
            if (isCrossed(edge, u, v)) crossed.push_back(edge.outer);
        std::ranges::sort(crossed);
        std::size_t best = kNone;
        for (std::size_t begin = 0, end = 0; begin < crossed.size(); begin = end) {
            while (end < crossed.size() && crossed[end] == crossed[begin]) ++end;
            if ((end - begin) % 2 == 1 && (best == kNone || areas_[crossed[begin]] < areas_[best]))
                best = crossed[begin];
        }
        return best;
    }

private:
    struct Edge {
        plane::Point from, to;
        std::size_t outer = 0;
    };
    [[nodiscard]] std::int64_t levelOf(std::int64_t v) const noexcept { return (v - low_) / step_; }
    void addEdge(const Edge& edge) {
        const auto [from, to] = std::minmax(edge.from.v, edge.to.v);
        for (std::int64_t level = levelOf(from); level <= levelOf(to); ++level)
            levels_[static_cast<std::size_t>(level)].push_back(edge);
    }
    // Whether a ray from (u, v) / 2 in the direction of u crosses the edge.
    static bool isCrossed(const Edge& edge, std::int64_t u, std::int64_t v) noexcept {
        const plane::Point a = edge.from, b = edge.to;
        if ((2 * a.v > v) == (2 * b.v > v)) return false;
        return (cross(b - a, {u - 2 * a.u, v - 2 * a.v}) > 0) == (b.v > a.v);
    }

    std::vector<double> areas_;
    std::int64_t low_ = 0, step_ = 1;
    std::vector<std::vector<Edge>> levels_;
};

class RingMaker {
public:
    explicit RingMaker(const std::vector<DrawingBorder>& borders) : borders_(borders) {}

    std::vector<DrawingPolygon> run() {
        struct Labelled {
            std::uint32_t label = 0;
            HalfBorder half;
        };
        std::vector<Labelled> halves;
        for (std::uint32_t b = 0; b < borders_.size(); ++b) {
            if (borders_[b].left != kNoLabel) halves.push_back({borders_[b].left, {b, true}});
            if (borders_[b].right != kNoLabel) halves.push_back({borders_[b].right, {b, false}});
        }
        std::ranges::stable_sort(halves, {}, &Labelled::label);
        for (std::size_t begin = 0, end = 0; begin < halves.size(); begin = end) {
            halves_.clear();
            for (; end < halves.size() && halves[end].label == halves[begin].label; ++end)
                halves_.push_back(halves[end].half);
            makeLabel(halves[begin].label);
        }
        return std::move(polygons_);
    }

private:
    using LabelRing = std::vector<RingPoint>;

    [[nodiscard]] plane::Point pointOf(HalfBorder half, std::size_t n) const noexcept {
        const auto& points = borders_[half.border].points;
        return points[half.isForward ? n : points.size() - 1 - n];
    }
    [[nodiscard]] std::size_t sizeOf(HalfBorder half) const noexcept { return borders_[half.border].points.size(); }

    void makeLabel(std::uint32_t label) {
        std::vector<std::uint32_t> byStart(halves_.size());
        for (std::uint32_t h = 0; h < halves_.size(); ++h) byStart[h] = h;
        std::ranges::stable_sort(byStart, {}, [&](std::uint32_t h) { return pointOf(halves_[h], 0); });
        std::vector<std::uint8_t> isUsed(halves_.size(), 0);
        rings_.clear();
        for (std::uint32_t first = 0; first < halves_.size(); ++first) {
            LabelRing walk;
            std::uint32_t h = first;
            while (isUsed[h] == 0) {
                isUsed[h] = 1;
                for (std::size_t n = 0; n + 1 < sizeOf(halves_[h]); ++n)
                    walk.push_back({pointOf(halves_[h], n), halves_[h].border});
                const std::uint32_t next = nextOf(h, byStart, isUsed);
                if (next == kNone) break;
                h = next;
            }
            plane::splitAtRepeats(
                walk, [](const RingPoint& step) { return step.point; },
                [&](LabelRing ring) { addRing(std::move(ring)); });
        }
        sortRings(label);
    }

    // The next border: the first one clockwise from h that starts where h ends, which keeps the inside connected.
    [[nodiscard]] std::uint32_t nextOf(std::uint32_t h, const std::vector<std::uint32_t>& byStart,
                                       const std::vector<std::uint8_t>& isUsed) const {
        const std::size_t size = sizeOf(halves_[h]);
        const plane::Point node = pointOf(halves_[h], size - 1);
        const plane::Point back = pointOf(halves_[h], size - 2) - node;
        const auto startOf = [&](std::uint32_t other) { return pointOf(halves_[other], 0); };
        std::uint32_t best = kNone;
        plane::Point bestStep;
        for (auto candidate =
                 std::lower_bound(byStart.begin(), byStart.end(), node,
                                  [&](std::uint32_t other, plane::Point at) { return startOf(other) < at; });
             candidate != byStart.end() && startOf(*candidate) == node; ++candidate) {
            const std::uint32_t other = *candidate;
            if (isUsed[other] != 0) continue;
            const plane::Point step = pointOf(halves_[other], 1) - node;
            if (best == kNone || isClockwiseBefore(back, step, bestStep)) {
                best = other;
                bestStep = step;
            }
        }
        return best;
    }

    // Whether `a` comes before `b`, turning clockwise from `back`. The direction of `back` itself comes last.
    static bool isClockwiseBefore(plane::Point back, plane::Point a, plane::Point b) noexcept {
        const auto half = [&](plane::Point s) {
            const plane::Wide side = cross(back, s);
            return side < 0 ? 0 : side == 0 && dot(back, s) < 0 ? 1 : side > 0 ? 2 : 3;
        };
        const int halfA = half(a), halfB = half(b);
        return halfA != halfB ? halfA < halfB : cross(a, b) < 0;
    }

    void addRing(LabelRing ring) {
        if (ring.size() < 3 || twiceSignedArea(ring) == 0) return;
        const auto lowest = std::ranges::min_element(ring, {}, &RingPoint::point);
        std::rotate(ring.begin(), lowest, ring.end());
        rings_.push_back(std::move(ring));
    }

    // Makes polygons: outer rings (counter-clockwise) with their holes.
    void sortRings(std::uint32_t label) {
        std::ranges::stable_sort(rings_, {}, [](const LabelRing& ring) { return ring.front().point; });
        const std::size_t first = polygons_.size();
        std::vector<LabelRing> holes;
        for (LabelRing& ring : rings_) {
            if (twiceSignedArea(ring) > 0)
                polygons_.push_back({label, {std::move(ring)}});
            else
                holes.push_back(std::move(ring));
        }
        if (holes.empty()) return;
        const OuterFinder finder(std::span<const DrawingPolygon>(polygons_).subspan(first));
        for (LabelRing& hole : holes)
            if (const std::size_t outer = finder.find(hole); outer != OuterFinder::kNone)
                polygons_[first + outer].rings.push_back(std::move(hole));
    }

    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    const std::vector<DrawingBorder>& borders_;
    std::vector<HalfBorder> halves_;  // of the current label
    std::vector<LabelRing> rings_;
    std::vector<DrawingPolygon> polygons_;
};

}  // namespace

std::vector<DrawingBorder> joinEdges(std::vector<PieceEdge> edges) {
    return EdgeJoiner(cancel(std::move(edges))).run();
}

void straighten(std::vector<DrawingBorder>& borders, double tolerance) {
    for (DrawingBorder& border : borders) straighten(border, tolerance);
    std::erase_if(borders, [](const DrawingBorder& border) {
        return border.points.size() < 4 && border.points.front() == border.points.back();
    });
}

std::vector<DrawingPolygon> makePolygons(const std::vector<DrawingBorder>& borders) { return RingMaker(borders).run(); }

double twiceSignedArea(const std::vector<RingPoint>& ring) noexcept {
    double area = 0;
    for (std::size_t n = 1; n + 1 < ring.size(); ++n)
        area += static_cast<double>(cross(ring[n].point - ring.front().point, ring[n + 1].point - ring.front().point));
    return area;
}

}  // namespace svt::drawing
