#include <svt/mesh/polygons/edges.hpp>

#include <svt/plane/box_tree.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <queue>
#include <tuple>

namespace svt::mesh {
namespace {

// Fraction of `point` along a-b if it lies within `distance` of the interior of the edge; else < 0.
double fractionOnEdge(Vec3d point, Vec3d a, Vec3d b, double distance) {
    const Vec3d along = b - a;
    const double squared = dot(along, along);
    if (!(squared > 0)) return -1;
    const double t = dot(point - a, along) / squared;
    const double margin = distance / std::sqrt(squared);
    if (t <= margin || t >= 1 - margin) return -1;
    return length(point - (a + along * t)) <= distance ? t : -1;
}

struct EdgeCut {
    std::uint32_t from, to, point;
    double fraction;
};

// True if the box, grown by `distance`, meets the edge a-b. Slab test (Kay & Kajiya 1986).
bool isNearEdge(const Box3d& box, Vec3d a, Vec3d b, double distance) {
    double low = 0, high = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double along = b[axis] - a[axis];
        const double toMin = box.min[axis] - distance - a[axis], toMax = box.max[axis] + distance - a[axis];
        if (std::abs(along) < distance) {
            // The fractions would be imprecise; the box of the edge decides.
            if (toMin > std::max(0.0, along) || toMax < std::min(0.0, along)) return false;
            continue;
        }
        low = std::max(low, std::min(toMin / along, toMax / along));
        high = std::min(high, std::max(toMin / along, toMax / along));
    }
    return low <= high;
}

// Finds ends of open edges that lie on other open edges, in rounds. A pair that was apart in one round is not tested
// again in the next.
class CutFinder {
public:
    CutFinder(const std::vector<Vec3d>& vertices, double distance) : vertices_(vertices), distance_(distance) {}

    // Returns nothing if there are more than `maxCuts` cuts, because edges overlap often.
    std::optional<std::vector<EdgeCut>> find(const std::vector<OpenEdge>& open, std::size_t maxCuts) {
        std::vector<std::uint32_t> points;
        std::vector<Key> keys;
        for (const OpenEdge& edge : open) {
            points.push_back(edge.from);
            points.push_back(edge.to);
            keys.push_back(std::minmax(edge.from, edge.to));
        }
        makeUnique(points);
        makeUnique(keys);
        std::vector<std::uint32_t> newPoints;
        std::set_difference(points.begin(), points.end(), points_.begin(), points_.end(),
                            std::back_inserter(newPoints));
        std::vector<Key> newKeys, oldKeys;
        for (const Key& key : keys)
            (std::binary_search(uncut_.begin(), uncut_.end(), key) ? oldKeys : newKeys).push_back(key);

        std::vector<EdgeCut> cuts;
        if (!addCuts(newKeys, points, maxCuts, cuts) || !addCuts(oldKeys, newPoints, maxCuts, cuts))
            return std::nullopt;
        std::sort(cuts.begin(), cuts.end(), [](const EdgeCut& p, const EdgeCut& q) {
            return std::tie(p.from, p.to, p.fraction, p.point) < std::tie(q.from, q.to, q.fraction, q.point);
        });
        uncut_.clear();
        for (const Key& key : keys) {
            const auto at = std::lower_bound(cuts.begin(), cuts.end(), key, [](const EdgeCut& cut, const Key& wanted) {
                return Key{cut.from, cut.to} < wanted;
            });
            if (at == cuts.end() || Key{at->from, at->to} != key) uncut_.push_back(key);
        }
        points_ = std::move(points);
        return cuts;
    }

private:
    using Key = std::pair<std::uint32_t, std::uint32_t>;  // of an edge: the lower vertex, the higher

    template <class Values>
    static void makeUnique(Values& values) {
        std::sort(values.begin(), values.end());
        values.erase(std::unique(values.begin(), values.end()), values.end());
    }

    bool addCuts(const std::vector<Key>& keys, const std::vector<std::uint32_t>& points, std::size_t maxCuts,
                 std::vector<EdgeCut>& cuts) const {
        if (keys.empty() || points.empty()) return true;
        std::vector<Box3d> boxes;
        for (const std::uint32_t point : points) boxes.push_back({vertices_[point], vertices_[point]});
        const plane::BoxTree tree(std::move(boxes));
        for (const auto& [from, to] : keys) {
            const Key key{from, to};
            const Vec3d a = vertices_[from], b = vertices_[to];
            const bool isTooMany = tree.visit(
                // Twice the distance, so that rounding leaves nothing out.
                [&](const Box3d& box) { return isNearEdge(box, a, b, 2 * distance_); },
                [&](std::uint32_t i) {
                    if (points[i] == key.first || points[i] == key.second) return false;
                    const double fraction = fractionOnEdge(vertices_[points[i]], a, b, distance_);
                    if (fraction > 0) cuts.push_back({key.first, key.second, points[i], fraction});
                    return cuts.size() > maxCuts;
                });
            if (isTooMany) return false;
        }
        return true;
    }

    const std::vector<Vec3d>& vertices_;
    double distance_;
    std::vector<std::uint32_t> points_;  // of the round before
    std::vector<Key> uncut_;             // edges of the round before on which no point lay
};

// A point on the border of a triangle, and a mask of the edges that it lies on (bit 0: from corner 0 to 1, ...).
struct BorderPoint {
    std::uint32_t vertex;
    unsigned edges;
};

// The corners of a triangle and the cut points of its edges, as a ring.
std::vector<BorderPoint> ringWithCuts(const Triangle& triangle, const std::vector<EdgeCut>& cuts) {
    std::vector<BorderPoint> ring;
    for (unsigned c = 0; c < 3; ++c) {
        const std::uint32_t a = triangle.corners[c];
        const std::uint32_t b = triangle.corners[(c + 1) % 3];
        ring.push_back({a, 1u << c | 1u << (c + 2) % 3});
        const auto key = std::minmax(a, b);
        auto range = std::equal_range(
            cuts.begin(), cuts.end(), EdgeCut{key.first, key.second, 0, 0},
            [](const EdgeCut& p, const EdgeCut& q) { return std::tie(p.from, p.to) < std::tie(q.from, q.to); });
        const std::size_t begin = ring.size();
        for (auto it = range.first; it != range.second; ++it) ring.push_back({it->point, 1u << c});
        if (a > b) std::reverse(ring.begin() + static_cast<std::ptrdiff_t>(begin), ring.end());
    }
    return ring;
}

// Triangulates a triangle with additional points on its border by ear clipping, largest ear first, of equal ones the
// first of the ring. An ear must not lie on one edge, and the remaining points must not either, so that no triangle is
// degenerate.
class EarClipper {
public:
    EarClipper(const std::vector<Vec3d>& vertices, const std::vector<BorderPoint>& ring)
        : vertices_(vertices), ring_(ring), before_(ring.size()), after_(ring.size()), turn_(ring.size(), 0) {
        const auto n = static_cast<std::uint32_t>(ring.size());
        for (std::uint32_t i = 0; i < n; ++i) {
            before_[i] = i == 0 ? n - 1 : i - 1;
            after_[i] = i + 1 == n ? 0 : i + 1;
            for (unsigned e = 0; e < 3; ++e) notOn_[e] += isOff(i, e) ? 1 : 0;
        }
        for (std::uint32_t i = 0; i < n; ++i) offer(i);
    }

    void clip(const Triangle& source, std::vector<Triangle>& out) {
        const auto emit = [&](std::uint32_t i) {
            out.push_back(source);
            out.back().corners = {ring_[before_[i]].vertex, ring_[i].vertex, ring_[after_[i]].vertex};
        };
        for (std::size_t left = ring_.size(); left > 3; --left) {
            const std::uint32_t ear = takeEar();
            emit(ear);
            if (ear == first_) first_ = after_[ear];
            for (unsigned e = 0; e < 3; ++e) notOn_[e] -= isOff(ear, e) ? 1 : 0;
            const std::uint32_t before = before_[ear], after = after_[ear];
            after_[before] = after;
            before_[after] = before;
            turn_[ear] = kGone;
            offer(before);
            offer(after);
        }
        emit(after_[first_]);
    }

private:
    static constexpr std::uint32_t kGone = 0xFFFFFFFFu;

    struct Ear {
        double area;
        std::uint32_t point, turn;
        friend bool operator<(const Ear& a, const Ear& b) {
            return a.area != b.area ? a.area < b.area : a.point > b.point;
        }
    };

    [[nodiscard]] bool isOff(std::uint32_t i, unsigned edge) const { return (ring_[i].edges >> edge & 1u) == 0; }

    // True if all points but this one lie on one edge. It stays true for the points that are left.
    [[nodiscard]] bool isRestFlat(std::uint32_t i) const {
        for (unsigned e = 0; e < 3; ++e)
            if (notOn_[e] == (isOff(i, e) ? 1u : 0u)) return true;
        return false;
    }

    // Earlier offers for this point no longer count.
    void offer(std::uint32_t i) {
        ++turn_[i];
        const BorderPoint &a = ring_[before_[i]], &b = ring_[i], &c = ring_[after_[i]];
        if ((a.edges & b.edges & c.edges) != 0) return;
        const double area =
            length(cross(vertices_[b.vertex] - vertices_[a.vertex], vertices_[c.vertex] - vertices_[a.vertex]));
        if (area >= 0) ears_.push({area, i, turn_[i]});
    }

    std::uint32_t takeEar() {
        while (!ears_.empty()) {
            const Ear best = ears_.top();
            ears_.pop();
            if (best.turn == turn_[best.point] && !isRestFlat(best.point)) return best.point;
        }
        return first_;
    }

    const std::vector<Vec3d>& vertices_;
    const std::vector<BorderPoint>& ring_;
    std::vector<std::uint32_t> before_, after_;  // neighbours in the ring
    std::vector<std::uint32_t> turn_;            // per point: number of its last offer
    std::priority_queue<Ear> ears_;
    std::size_t notOn_[3] = {0, 0, 0};  // per edge: count of points of the ring that are not on it
    std::uint32_t first_ = 0;           // of the points that are left
};

}  // namespace

std::uint32_t cutAtTJunctions(std::vector<Vec3d>& vertices, std::vector<Triangle>& triangles, double distance,
                              bool* isUnfinished, std::size_t mostCuts) {
    // A split can expose another point on an edge; a few rounds settle all.
    constexpr int kMaxRounds = 8;
    // A point on a hundred edges is not a T-junction, but a heap of faces.
    constexpr std::size_t kLeastMaxCuts = 1 << 20, kMaxCutsPerEdge = 16;
    std::uint32_t count = 0;
    if (isUnfinished != nullptr) *isUnfinished = false;
    CutFinder finder(vertices, distance);
    for (int round = 0;; ++round) {
        const std::vector<OpenEdge> open = findOpenEdges(triangles);
        if (open.empty()) break;
        const std::size_t left = mostCuts - std::min<std::size_t>(mostCuts, count);
        const auto cuts = finder.find(open, std::min(left, std::max(kLeastMaxCuts, kMaxCutsPerEdge * open.size())));
        if (cuts && cuts->empty()) break;
        if (!cuts || round == kMaxRounds) {
            if (isUnfinished != nullptr) *isUnfinished = true;
            break;
        }
        count += static_cast<std::uint32_t>(cuts->size());
        std::vector<Triangle> result;
        result.reserve(triangles.size() + cuts->size() * 2);
        for (const Triangle& triangle : triangles) {
            const std::vector<BorderPoint> ring = ringWithCuts(triangle, *cuts);
            if (ring.size() == 3)
                result.push_back(triangle);
            else
                EarClipper(vertices, ring).clip(triangle, result);
        }
        triangles = std::move(result);
    }
    return count;
}

}  // namespace svt::mesh
