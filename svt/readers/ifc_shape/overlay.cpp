#include <svt/readers/ifc_shape/overlay.hpp>

#include <svt/plane/rings.hpp>
#include <svt/readers/ifc_shape/curves.hpp>
#include <svt/readers/ifc_shape/welder.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace svt::readers::ifc {
namespace {

using Vertex = std::uint32_t;
using EdgeKey = std::pair<Vertex, Vertex>;  // lower vertex first

struct Net {
    std::uint32_t channel;
    std::int32_t count;  // from the lower to the higher vertex
};

struct BorderEdge {
    Vertex from = 0, to = 0;
    std::vector<Net> nets;
    std::uint8_t left = 0, right = 0;  // states
};

using EdgeMap = std::map<EdgeKey, std::vector<Net>>;

void addEdge(EdgeMap& edges, Vertex from, Vertex to, std::uint32_t channel, std::int32_t count) {
    if (from == to) return;
    std::vector<Net>& nets = edges[std::minmax(from, to)];
    const std::int32_t signedCount = from < to ? count : -count;
    for (Net& net : nets)
        if (net.channel == channel) {
            net.count += signedCount;
            return;
        }
    nets.push_back({channel, signedCount});
}

double cross2(Vec3d a, Vec3d b) noexcept { return a.x * b.y - a.y * b.x; }

class Overlay {
public:
    Overlay(std::span<const OverlaySegment> segments, std::uint32_t channelCount,
            const std::function<std::uint8_t(std::span<const std::int32_t>)>& stateOf)
        : channelCount_(channelCount), stateOf_(stateOf), welder_(kSnap) {
        EdgeMap edges;
        for (const OverlaySegment& s : segments) {
            const Vertex from = welder_.add(s.from), to = welder_.add(s.to);
            addEdge(edges, from, to, s.channel, s.count);
        }
        // Points where two edges cross are snapped, which bends the edges a little: a second pass finds what that
        // changed.
        edges = split(edges);
        edges = split(edges);
        for (auto& [key, nets] : edges) {
            std::erase_if(nets, [](const Net& net) { return net.count == 0; });
            if (!nets.empty()) edges_.push_back({key.first, key.second, std::move(nets), 0, 0});
        }
    }

    [[nodiscard]] std::size_t edgeCount() const noexcept { return edges_.size(); }
    [[nodiscard]] bool isTooMuch() const noexcept { return crossings_ > kMaxCrossings; }

    std::vector<OverlayFace> run() {
        for (BorderEdge& edge : edges_) findStates(edge);
        std::vector<std::uint8_t> states;
        for (const BorderEdge& edge : edges_) {
            states.push_back(edge.left);
            states.push_back(edge.right);
        }
        std::sort(states.begin(), states.end());
        states.erase(std::unique(states.begin(), states.end()), states.end());
        std::vector<OverlayFace> faces;
        for (const std::uint8_t state : states)
            if (state != 0) traceFaces(state, faces);
        return faces;
    }

private:
    [[nodiscard]] Vec3d at(Vertex v) const { return welder_.points()[v]; }

    EdgeMap split(const EdgeMap& edges) {
        struct Item {
            EdgeKey key;
            double low, high, bottom, top;
            std::vector<std::pair<double, Vertex>> cuts;
        };
        std::vector<Item> items;
        for (const auto& [key, nets] : edges) {
            const Vec3d a = at(key.first), b = at(key.second);
            items.push_back({key, std::min(a.x, b.x), std::max(a.x, b.x), std::min(a.y, b.y), std::max(a.y, b.y), {}});
        }
        std::sort(items.begin(), items.end(),
                  [](const Item& p, const Item& q) { return std::tie(p.low, p.key) < std::tie(q.low, q.key); });
        for (std::size_t i = 0; i < items.size(); ++i)
            for (std::size_t j = i + 1; j < items.size() && items[j].low <= items[i].high + kSnap; ++j) {
                if (items[j].bottom > items[i].top + kSnap || items[i].bottom > items[j].top + kSnap) continue;
                cutPair(items[i].key, items[j].key, items[i].cuts, items[j].cuts);
            }
        EdgeMap result;
        for (Item& item : items) {
            std::sort(item.cuts.begin(), item.cuts.end());
            item.cuts.emplace_back(1, item.key.second);
            Vertex last = item.key.first;
            for (const auto& [share, vertex] : item.cuts) {
                for (const Net& net : edges.at(item.key)) addEdge(result, last, vertex, net.channel, net.count);
                if (vertex != last) last = vertex;
            }
        }
        return result;
    }

    using Cuts = std::vector<std::pair<double, Vertex>>;

    // A vertex of one edge that lies within the other.
    bool cutAt(Vertex v, const EdgeKey& edge, Cuts& cuts) const {
        if (v == edge.first || v == edge.second) return true;
        const Vec3d a = at(edge.first), d = at(edge.second) - a, p = at(v) - a;
        const double size = dot(d, d), share = dot(p, d) / size;
        if (share <= 0 || share >= 1 || std::abs(cross2(d, p)) > kSnap * std::sqrt(size)) return false;
        cuts.emplace_back(share, v);
        return true;
    }

    void cutPair(const EdgeKey& e, const EdgeKey& f, Cuts& cutsE, Cuts& cutsF) {
        bool isTouching = cutAt(e.first, f, cutsF);
        isTouching = cutAt(e.second, f, cutsF) || isTouching;
        isTouching = cutAt(f.first, e, cutsE) || isTouching;
        isTouching = cutAt(f.second, e, cutsE) || isTouching;
        if (isTouching) return;
        const Vec3d a = at(e.first), d = at(e.second) - a, c = at(f.first), g = at(f.second) - c;
        const double denominator = cross2(d, g);
        if (denominator == 0) return;
        const double s = cross2(c - a, g) / denominator, t = cross2(c - a, d) / denominator;
        if (!(s > 0 && s < 1 && t > 0 && t < 1)) return;
        if (++crossings_ > kMaxCrossings) return;
        const Vertex v = welder_.add(a + d * s);
        if (v != e.first && v != e.second) cutsE.emplace_back(s, v);
        if (v != f.first && v != f.second) cutsF.emplace_back(t, v);
    }

    // The winding numbers on both sides of an edge, by a ray from its middle across it.
    void findStates(BorderEdge& edge) {
        const Vec3d a = at(edge.from), b = at(edge.to), middle = (a + b) * 0.5;
        const bool isSteep = std::abs(b.y - a.y) >= std::abs(b.x - a.x);
        // Coordinate along the ray and across it.
        const auto along = [&](Vec3d p) { return isSteep ? p.x : p.y; };
        const auto across = [&](Vec3d p) { return isSteep ? p.y : p.x; };
        windings_.assign(channelCount_, 0);
        const double m = across(middle), reach = along(middle);
        for (const BorderEdge& other : edges_) {
            if (&other == &edge) continue;
            const Vec3d p = at(other.from), q = at(other.to);
            const bool isLow = across(p) <= m;
            if (isLow == (across(q) <= m)) continue;
            const double share = (m - across(p)) / (across(q) - across(p));
            if (along(p) + (along(q) - along(p)) * share <= reach) continue;
            // Upwards across a ray to the right, or leftwards across a ray upwards, is counter-clockwise.
            const std::int32_t sign = isLow == isSteep ? 1 : -1;
            for (const Net& net : other.nets) windings_[net.channel] += sign * net.count;
        }
        const std::uint8_t beyond = stateOf_(windings_);
        // Beyond a steep edge that rises is its right side; beyond a flat one that runs to the right its left side.
        const bool isBeyondLeft = isSteep ? b.y < a.y : b.x > a.x;
        for (const Net& net : edge.nets) windings_[net.channel] += isBeyondLeft ? -net.count : net.count;
        const std::uint8_t before = stateOf_(windings_);
        edge.left = isBeyondLeft ? beyond : before;
        edge.right = isBeyondLeft ? before : beyond;
    }

    using Ring = std::vector<Vertex>;

    void traceFaces(std::uint8_t state, std::vector<OverlayFace>& faces) {
        // Directed edges with the state on their left, by the vertex that they leave.
        std::vector<std::pair<Vertex, Vertex>> directed;
        for (const BorderEdge& edge : edges_) {
            if (edge.left == state && edge.right != state) directed.emplace_back(edge.from, edge.to);
            if (edge.right == state && edge.left != state) directed.emplace_back(edge.to, edge.from);
        }
        std::sort(directed.begin(), directed.end());
        std::vector<bool> isUsed(directed.size(), false);
        std::vector<Ring> rings;
        for (std::size_t start = 0; start < directed.size(); ++start) {
            if (isUsed[start]) continue;
            Ring ring;
            std::size_t e = start;
            for (;;) {
                isUsed[e] = true;
                ring.push_back(directed[e].first);
                const std::size_t next = nextEdge(directed, isUsed, e);
                if (next == directed.size()) break;
                e = next;
            }
            // Left open if rounding broke the loop; the closing test of the result detects it.
            if (directed[e].second != directed[start].first) continue;
            plane::splitAtRepeats(
                ring, [](Vertex v) { return v; }, [&](Ring part) { rings.push_back(std::move(part)); });
        }
        group(rings, state, faces);
    }

    // The first unused edge clockwise from the way back among those that leave the end of `e`. The region on the left
    // stays on the left and never crosses itself.
    [[nodiscard]] std::size_t nextEdge(const std::vector<std::pair<Vertex, Vertex>>& directed,
                                       const std::vector<bool>& isUsed, std::size_t e) const {
        const auto [from, to] = directed[e];
        const Vec3d back = at(from) - at(to);
        std::size_t best = directed.size();
        double bestAngle = 10;
        for (auto it = std::lower_bound(directed.begin(), directed.end(), std::pair(to, Vertex{0}));
             it != directed.end() && it->first == to; ++it) {
            const auto i = static_cast<std::size_t>(it - directed.begin());
            if (isUsed[i]) continue;
            const Vec3d out = at(it->second) - at(to);
            double angle = std::atan2(-cross2(back, out), dot(back, out));  // clockwise
            if (angle <= 0) angle += 6.283185307179586;
            if (angle < bestAngle) {
                bestAngle = angle;
                best = i;
            }
        }
        return best;
    }

    [[nodiscard]] std::vector<Vec3d> pointsOf(const Ring& ring) const {
        std::vector<Vec3d> points;
        for (const Vertex v : ring) points.push_back(at(v));
        return points;
    }

    // Each hole to the smallest exterior ring around it.
    void group(const std::vector<Ring>& rings, std::uint8_t state, std::vector<OverlayFace>& faces) const {
        const std::size_t first = faces.size();
        std::vector<double> areas;
        std::vector<std::vector<Vec3d>> holes;
        for (const Ring& ring : rings) {
            if (ring.size() < 3) continue;
            std::vector<Vec3d> points = pointsOf(ring);
            const double area = twiceArea(points);
            if (area > 0) {
                faces.push_back({{std::move(points)}, state});
                areas.push_back(area);
            } else if (area < 0) {
                holes.push_back(std::move(points));
            }
        }
        for (std::vector<Vec3d>& hole : holes) {
            const Vec3d probe = (hole[0] + hole[1]) * 0.5;
            std::size_t best = faces.size();
            for (std::size_t f = first; f < faces.size(); ++f)
                if (contains(faces[f].rings[0], probe) &&
                    (best == faces.size() || areas[f - first] < areas[best - first]))
                    best = f;
            if (best < faces.size()) faces[best].rings.push_back(std::move(hole));
        }
    }

    static bool contains(const std::vector<Vec3d>& ring, Vec3d p) noexcept {
        bool isInside = false;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec3d a = ring[i], b = ring[(i + 1) % ring.size()];
            if ((a.y <= p.y) != (b.y <= p.y) && a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y)) > p.x)
                isInside = !isInside;
        }
        return isInside;
    }

    static constexpr std::size_t kMaxCrossings = 1'000'000;

    std::uint32_t channelCount_;
    std::size_t crossings_ = 0;
    const std::function<std::uint8_t(std::span<const std::int32_t>)>& stateOf_;
    Welder welder_;
    std::vector<BorderEdge> edges_;
    std::vector<std::int32_t> windings_;
};

}  // namespace

std::vector<OverlayFace> overlay(std::span<const OverlaySegment> segments, std::uint32_t channelCount,
                                 const std::function<std::uint8_t(std::span<const std::int32_t>)>& stateOf,
                                 std::uint64_t& budget) {
    // All pairs of segments may have to be looked at, then all pairs of pieces.
    const auto take = [&](std::uint64_t steps) {
        budget = steps > budget ? 0 : budget - steps;
        return budget > 0;
    };
    if (!take(std::uint64_t(segments.size()) * segments.size() / 4)) return {};
    Overlay cut(segments, channelCount, stateOf);
    if (cut.isTooMuch()) budget = 0;
    if (!take(std::uint64_t(cut.edgeCount()) * (cut.edgeCount() + channelCount))) return {};
    return cut.run();
}

}  // namespace svt::readers::ifc
