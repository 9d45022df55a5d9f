#include <svt/plane/arrangement.hpp>

#include <svt/plane/square_grid.hpp>
#include <svt/plane/welder.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace svt::plane {
namespace {

// Nodes, and the search for the node near a point.
class NodeSet {
public:
    explicit NodeSet(std::int32_t tolerance) : tolerance_(tolerance) {}

    // The nearest node within the tolerance, or a new one.
    std::uint32_t nodeAt(Point p) {
        Wide least = Wide(tolerance_) * tolerance_;
        const Cell cell{cellOf(p.u), cellOf(p.v), 0}, next{1, 1, 0};
        return nodes_.add(p, cell, cell - next, cell + next, [&](std::uint32_t n, std::uint32_t best) {
            const Point step = p - points()[n];
            const Wide distance = dot(step, step);
            if (distance > least || (distance == least && n > best)) return false;
            least = distance;
            return true;
        });
    }

    [[nodiscard]] const std::vector<Point>& points() const noexcept { return nodes_.points(); }

private:
    [[nodiscard]] std::int64_t cellOf(std::int64_t at) const noexcept {
        return at >= 0 ? at / tolerance_ : -1 - (-1 - at) / tolerance_;
    }

    std::int64_t tolerance_;
    Welder<Point> nodes_;
};

// A piece of a segment between two nodes; from < to as points.
struct NodePair {
    std::uint32_t from = 0, to = 0;
    std::uint32_t claim = 0;
    std::int32_t winding = 0;
    bool isLine = false;
};

// Numbers by square, stored square after square.
class SquareLists {
public:
    void add(std::size_t square, std::uint32_t number) { entries_.push_back({square, number}); }
    void finish(std::size_t squares) {
        first_.assign(squares + 1, 0);
        for (const auto& [square, number] : entries_) ++first_[square + 1];
        for (std::size_t n = 0; n < squares; ++n) first_[n + 1] += first_[n];
        numbers_.resize(entries_.size());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (const auto& [square, number] : entries_) numbers_[next[square]++] = number;
        entries_ = {};
    }
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t square) const noexcept {
        return std::span(numbers_).subspan(first_[square], first_[square + 1] - first_[square]);
    }

private:
    std::vector<std::pair<std::size_t, std::uint32_t>> entries_;
    std::vector<std::size_t> first_;
    std::vector<std::uint32_t> numbers_;
};

class SegmentArranger {
public:
    SegmentArranger(std::span<const ClaimSegment> segments, std::int32_t tolerance)
        : reach_(tolerance / 2), nodes_(tolerance) {
        pairs_.reserve(segments.size());
        for (const ClaimSegment& s : segments)
            addPair(nodes_.nodeAt(s.from), nodes_.nodeAt(s.to), s.claim, s.winding, s.winding == 0);
        merge();
    }

    bool run() {
        constexpr int kMostSteps = 40;
        for (int step = 0; step < kMostSteps; ++step)
            if (!split()) return true;
        return false;
    }

    [[nodiscard]] Arrangement result() const {
        Arrangement all;
        std::vector<std::uint32_t> order(pairs_.size());
        for (std::uint32_t n = 0; n < order.size(); ++n) order[n] = n;
        const auto& points = nodes_.points();
        const auto key = [&](std::uint32_t n) {
            return std::tuple(points[pairs_[n].from], points[pairs_[n].to], pairs_[n].claim, pairs_[n].isLine);
        };
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
        for (const std::uint32_t n : order) {
            const NodePair& pair = pairs_[n];
            const Point from = points[pair.from], to = points[pair.to];
            const auto mark = static_cast<std::uint32_t>(all.marks.size());
            if (all.edges.empty() || all.edges.back().from != from || all.edges.back().to != to)
                all.edges.push_back({from, to, mark, mark});
            all.marks.push_back({pair.claim, pair.isLine ? 0 : pair.winding});
            all.edges.back().endMark = mark + 1;
        }
        return all;
    }

private:
    // An edge that is routed through a node.
    struct Split {
        std::uint32_t pair = 0, node = 0;
        Wide along = 0;
    };

    [[nodiscard]] Point pointOf(std::uint32_t node) const noexcept { return nodes_.points()[node]; }

    void addPair(std::uint32_t from, std::uint32_t to, std::uint32_t claim, std::int32_t winding, bool isLine) {
        if (from == to) return;
        if (pointOf(to) < pointOf(from)) {
            std::swap(from, to);
            winding = -winding;
        }
        pairs_.push_back({from, to, claim, winding, isLine});
    }

    // Merges coinciding edges. Borders of a claim that cancel each other disappear.
    void merge() {
        const auto key = [](const NodePair& p) { return std::tuple(p.from, p.to, p.claim, p.isLine); };
        std::sort(pairs_.begin(), pairs_.end(), [&](const NodePair& a, const NodePair& b) { return key(a) < key(b); });
        std::size_t kept = 0;
        for (std::size_t begin = 0, end = 0; begin < pairs_.size(); begin = end) {
            NodePair sum = pairs_[begin];
            for (end = begin + 1; end < pairs_.size() && key(pairs_[end]) == key(sum); ++end)
                sum.winding += pairs_[end].winding;
            if (sum.isLine || sum.winding != 0) pairs_[kept++] = sum;
        }
        pairs_.resize(kept);
    }

    // One round: cuts all edges at the nodes that they pass, and where they cross. False if nothing was cut.
    bool split() {
        if (pairs_.empty()) return false;
        splits_.clear();
        Box box;
        for (const Point p : nodes_.points()) box.add(p);
        const SquareGrid grid(box, std::min(2.0 * double(pairs_.size()), double(1 << 22)), 65536, 8.0 * reach_);
        SquareLists pairsIn, nodesIn;
        for (std::uint32_t n = 0; n < pairs_.size(); ++n)
            grid.forSegment(pointOf(pairs_[n].from), pointOf(pairs_[n].to), reach_, [&](std::size_t square) {
                pairsIn.add(square, n);
                return true;
            });
        for (std::uint32_t n = 0; n < nodes_.points().size(); ++n) nodesIn.add(grid.squareOf(pointOf(n)), n);
        pairsIn.finish(grid.count());
        nodesIn.finish(grid.count());
        for (std::size_t square = 0; square < grid.count(); ++square) {
            const auto near = pairsIn.of(square);
            for (const std::uint32_t node : nodesIn.of(square))
                for (const std::uint32_t pair : near) meetNode(pair, node);
            for (std::size_t i = 0; i < near.size(); ++i)
                for (std::size_t j = i + 1; j < near.size(); ++j) meetPair(near[i], near[j]);
        }
        if (splits_.empty()) return false;
        applySplits();
        return true;
    }

    void addSplit(std::uint32_t pair, std::uint32_t node) {
        const NodePair& p = pairs_[pair];
        if (node == p.from || node == p.to) return;
        splits_.push_back({pair, node, dot(pointOf(p.to) - pointOf(p.from), pointOf(node) - pointOf(p.from))});
    }

    void meetNode(std::uint32_t pair, std::uint32_t node) {
        const NodePair& p = pairs_[pair];
        if (node == p.from || node == p.to) return;
        const Point along = pointOf(p.to) - pointOf(p.from), to = pointOf(node) - pointOf(p.from);
        const Wide at = dot(along, to), whole = dot(along, along);
        if (at <= 0 || at >= whole) return;
        const double off = static_cast<double>(cross(along, to));
        if (off * off <= double(reach_) * double(reach_) * static_cast<double>(whole)) addSplit(pair, node);
    }

    void meetPair(std::uint32_t first, std::uint32_t second) {
        const NodePair &p = pairs_[first], &q = pairs_[second];
        if (p.from == q.from || p.from == q.to || p.to == q.from || p.to == q.to) return;
        const Point a = pointOf(p.from), b = pointOf(p.to), c = pointOf(q.from), d = pointOf(q.to);
        const Point along = b - a, other = d - c;
        const Wide sideC = cross(along, c - a), sideD = cross(along, d - a);
        if ((sideC > 0) == (sideD > 0) || sideC == 0 || sideD == 0) return;
        const Wide sideA = cross(other, a - c), sideB = cross(other, b - c);
        if ((sideA > 0) == (sideB > 0) || sideA == 0 || sideB == 0) return;
        const double t = static_cast<double>(sideA) / (static_cast<double>(sideA) - static_cast<double>(sideB));
        const auto onGrid = [&](std::int64_t from, std::int64_t step) {
            return static_cast<std::int64_t>(std::floor(double(from) + t * double(step) + 0.5));
        };
        const std::uint32_t node = nodes_.nodeAt({onGrid(a.u, along.u), onGrid(a.v, along.v)});
        addSplit(first, node);
        addSplit(second, node);
    }

    void applySplits() {
        const auto key = [](const Split& s) { return std::tuple(s.pair, s.along, s.node); };
        std::sort(splits_.begin(), splits_.end(), [&](const Split& a, const Split& b) { return key(a) < key(b); });
        splits_.erase(std::unique(splits_.begin(), splits_.end(),
                                  [&](const Split& a, const Split& b) { return key(a) == key(b); }),
                      splits_.end());
        std::vector<NodePair> before = std::move(pairs_);
        pairs_.clear();
        std::size_t next = 0;
        for (std::uint32_t n = 0; n < before.size(); ++n) {
            std::uint32_t from = before[n].from;
            for (; next < splits_.size() && splits_[next].pair == n; ++next) {
                addPair(from, splits_[next].node, before[n].claim, before[n].winding, before[n].isLine);
                from = splits_[next].node;
            }
            addPair(from, before[n].to, before[n].claim, before[n].winding, before[n].isLine);
        }
        merge();
    }

    // Half of the distance that nodes keep from each other. An edge routed through a node then has so obtuse a corner
    // that the new edges do not come near each other's ends. So the rounds come to an end.
    std::int32_t reach_;
    NodeSet nodes_;
    std::vector<NodePair> pairs_;
    std::vector<Split> splits_;
};

}  // namespace

std::optional<Arrangement> arrangeSegments(std::span<const ClaimSegment> segments, std::int32_t tolerance) {
    if (segments.empty()) return Arrangement{};
    SegmentArranger arranger(segments, tolerance);
    if (!arranger.run()) return std::nullopt;
    return arranger.result();
}

}  // namespace svt::plane
