#include <svt/plane/arrangement.hpp>

#include <svt/core/hash.hpp>
#include <svt/plane/square_grid.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace svt::plane {
namespace {

// Nodes, and the search for the node near a point: by lists of the nodes whose cells share a hash.
class NodeSet {
public:
    explicit NodeSet(std::int32_t tolerance) : tolerance_(tolerance), lastOf_(kFirstLists, kNone) {}

    // The nearest node within the tolerance, or a new one.
    std::uint32_t nodeAt(Point p) {
        Wide least = Wide(tolerance_) * tolerance_;
        std::uint32_t best = kNone;
        const Point low = cellOf({p.u - tolerance_, p.v - tolerance_}),
                    high = cellOf({p.u + tolerance_, p.v + tolerance_});
        for (std::int64_t u = low.u; u <= high.u; ++u)
            for (std::int64_t v = low.v; v <= high.v; ++v)
                for (std::uint32_t n = lastOf_[listOf({u, v})]; n != kNone; n = before_[n]) {
                    const Point step = p - points_[n];
                    const Wide distance = dot(step, step);
                    if (distance > least || (distance == least && n > best)) continue;
                    least = distance;
                    best = n;
                }
        return best != kNone ? best : add(p);
    }

    [[nodiscard]] const std::vector<Point>& points() const noexcept { return points_; }

private:
    static constexpr std::size_t kFirstLists = 64;
    static constexpr std::int64_t kCell = 8;  // tolerances: wide enough that most searches visit one or two cells

    std::uint32_t add(Point p) {
        points_.push_back(p);
        before_.push_back(kNone);
        if (points_.size() > lastOf_.size()) {
            lastOf_.assign(2 * lastOf_.size(), kNone);
            for (std::uint32_t n = 0; n + 1 < points_.size(); ++n) link(n);
        }
        const auto added = static_cast<std::uint32_t>(points_.size() - 1);
        link(added);
        return added;
    }
    void link(std::uint32_t n) noexcept {
        std::uint32_t& last = lastOf_[listOf(cellOf(points_[n]))];
        before_[n] = last;
        last = n;
    }
    [[nodiscard]] Point cellOf(Point p) const noexcept {
        const std::int64_t side = kCell * tolerance_;
        const auto along = [&](std::int64_t at) { return at >= 0 ? at / side : -1 - (-1 - at) / side; };
        return {along(p.u), along(p.v)};
    }
    [[nodiscard]] std::size_t listOf(Point cell) const noexcept {
        const std::uint64_t hash = mixHash(mixHash(0, std::uint64_t(cell.u)), std::uint64_t(cell.v));
        return static_cast<std::size_t>(hash >> 32) & (lastOf_.size() - 1);
    }

    std::int64_t tolerance_;
    std::vector<Point> points_;
    std::vector<std::uint32_t> lastOf_, before_;  // by list: its last node, or kNone; by node: the one before
};

// A piece of a segment between two nodes; from < to as points.
struct NodePair {
    std::uint32_t from = 0, to = 0;
    std::uint32_t claim = 0;
    std::int32_t winding = 0;
    bool isLine = false;
    bool isNew = true;  // made in the last round
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
        // A node keeps the place of its first point, so the order counts.
        for (const ClaimSegment& s : segments)
            for (const Point p : {s.to, s.from}) static_cast<void>(nodes_.nodeAt(p));
        // Only now is the nearest node of a point the same for all its segments, so that rings stay closed.
        pairs_.reserve(segments.size());
        for (const ClaimSegment& s : segments) {
            const std::uint32_t from = nodes_.nodeAt(s.from), to = nodes_.nodeAt(s.to);
            addPair(from, to, {from, to, s.claim, s.winding, s.winding == 0, true}, true);
        }
        merge();
    }

    bool run() {
        constexpr std::size_t kUsualRounds = 40, kMostPairs = 20'000'000;
        std::size_t pairs = 0;  // of all rounds
        for (std::size_t round = 0; round < kUsualRounds || pairs < kMostPairs; ++round) {
            if (!split()) return true;
            pairs += pairs_.size();
        }
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

    // Adds a part of `whole`.
    void addPair(std::uint32_t from, std::uint32_t to, const NodePair& whole, bool isNew) {
        if (from == to) return;
        if (pointOf(to) < pointOf(from))
            pairs_.push_back({to, from, whole.claim, -whole.winding, whole.isLine, isNew});
        else
            pairs_.push_back({from, to, whole.claim, whole.winding, whole.isLine, isNew});
    }

    // Merges coinciding edges. Borders of a claim that cancel each other disappear.
    void merge() {
        const auto key = [](const NodePair& p) { return std::tuple(p.from, p.to, p.claim, p.isLine); };
        std::sort(pairs_.begin(), pairs_.end(), [&](const NodePair& a, const NodePair& b) { return key(a) < key(b); });
        std::size_t kept = 0;
        for (std::size_t begin = 0, end = 0; begin < pairs_.size(); begin = end) {
            NodePair sum = pairs_[begin];
            for (end = begin + 1; end < pairs_.size() && key(pairs_[end]) == key(sum); ++end) {
                sum.winding += pairs_[end].winding;
                sum.isNew = sum.isNew || pairs_[end].isNew;
            }
            if (sum.isLine || sum.winding != 0) pairs_[kept++] = sum;
        }
        pairs_.resize(kept);
    }

    // One round: cuts all edges at the nodes that they pass, and where they cross. False if nothing was cut. Edges and
    // nodes of earlier rounds have met before.
    bool split() {
        if (pairs_.empty()) return false;
        splits_.clear();
        Box box;
        for (const Point p : nodes_.points()) box.add(p);
        const SquareGrid grid(box, std::min(2.0 * double(pairs_.size()), double(1 << 22)), 65536, 8.0 * reach_);
        SquareLists pairsIn, nodesIn;
        for (std::uint32_t n = 0; n < pairs_.size(); ++n)
            static_cast<void>(
                grid.forSegment(pointOf(pairs_[n].from), pointOf(pairs_[n].to), reach_, [&](std::size_t square) {
                    pairsIn.add(square, n);
                    return true;
                }));
        const auto nodeCount = static_cast<std::uint32_t>(nodes_.points().size());
        for (std::uint32_t n = 0; n < nodeCount; ++n) nodesIn.add(grid.squareOf(pointOf(n)), n);
        pairsIn.finish(grid.count());
        nodesIn.finish(grid.count());
        for (std::size_t square = 0; square < grid.count(); ++square) meetIn(pairsIn.of(square), nodesIn.of(square));
        firstNewNode_ = nodeCount;
        if (splits_.empty()) return false;
        applySplits();
        return true;
    }

    void meetIn(std::span<const std::uint32_t> pairs, std::span<const std::uint32_t> nodes) {
        for (const std::uint32_t node : nodes)
            for (const std::uint32_t pair : pairs)
                if (pairs_[pair].isNew || node >= firstNewNode_) meetNode(pair, node);
        for (std::size_t i = 0; i < pairs.size(); ++i)
            for (std::size_t j = i + 1; j < pairs.size(); ++j)
                if (pairs_[pairs[i]].isNew || pairs_[pairs[j]].isNew) meetPair(pairs[i], pairs[j]);
    }

    void addSplit(std::uint32_t pair, std::uint32_t node) {
        const NodePair& p = pairs_[pair];
        if (node == p.from || node == p.to) return;
        splits_.push_back({pair, node, dot(pointOf(p.to) - pointOf(p.from), pointOf(node) - pointOf(p.from))});
    }

    void meetNode(std::uint32_t pair, std::uint32_t node) {
        const NodePair& p = pairs_[pair];
        if (node == p.from || node == p.to) return;
        if (!isBesideBox(pointOf(node), pointOf(p.from), pointOf(p.to))) return;
        const Point along = pointOf(p.to) - pointOf(p.from), to = pointOf(node) - pointOf(p.from);
        const Wide at = dot(along, to), whole = dot(along, along);
        if (at <= 0 || at >= whole) return;
        const double off = static_cast<double>(cross(along, to));
        if (off * off <= double(reach_) * double(reach_) * static_cast<double>(whole)) addSplit(pair, node);
    }

    // Whether a point can lie within the reach of a segment; from < to, so u ascends.
    [[nodiscard]] bool isBesideBox(Point p, Point from, Point to) const noexcept {
        const std::int64_t around = reach_ + 1;
        return p.u >= from.u - around && p.u <= to.u + around && p.v >= std::min(from.v, to.v) - around &&
               p.v <= std::max(from.v, to.v) + around;
    }

    void meetPair(std::uint32_t first, std::uint32_t second) {
        const NodePair &p = pairs_[first], &q = pairs_[second];
        if (p.from == q.from || p.from == q.to || p.to == q.from || p.to == q.to) return;
        const Point a = pointOf(p.from), b = pointOf(p.to), c = pointOf(q.from), d = pointOf(q.to);
        // Most pairs of a square lie apart, which a few comparisons show; from < to, so u ascends.
        if (a.u > d.u || c.u > b.u) return;
        if (std::min(a.v, b.v) > std::max(c.v, d.v) || std::min(c.v, d.v) > std::max(a.v, b.v)) return;
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
            const bool isSplit = next < splits_.size() && splits_[next].pair == n;
            for (; next < splits_.size() && splits_[next].pair == n; ++next) {
                addPair(from, splits_[next].node, before[n], true);
                from = splits_[next].node;
            }
            addPair(from, before[n].to, before[n], isSplit);
        }
        merge();
    }

    // Half of the distance that nodes keep from each other. An edge routed through a node then has so obtuse a corner
    // that the new edges do not come near each other's ends. So the rounds come to an end.
    std::int32_t reach_;
    NodeSet nodes_;
    std::uint32_t firstNewNode_ = 0;  // nodes from here on were made in the last round
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
