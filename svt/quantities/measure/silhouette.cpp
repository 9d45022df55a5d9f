#include <svt/quantities/measure/silhouette.hpp>

#include <svt/plane/arrangement.hpp>
#include <svt/plane/regions.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace svt::quantities {
namespace {

using plane::Point;

constexpr double kFinest = 0x1p-20;        // metres per unit
constexpr double kReach = 0x1p28;          // units; an arrangement accepts twice as much
constexpr double kMeetingDistance = 8e-6;  // metres
constexpr std::uint32_t kFrame = 3;        // claim of the box around all triangles
enum Side : unsigned { kLeft = 1, kRight = 2, kLow = 4, kHigh = 8 };

// The claims at a place, as bits.
bool isVoid(std::uint32_t claims) noexcept { return (claims & 1U << kFrame) != 0 && (claims & 1U << kSeen) == 0; }
bool isThinner(std::uint32_t claims) noexcept {
    constexpr std::uint32_t kPlate = 1U << kSeen | 1U << kFront | 1U << kBack;
    return (claims & 1U << kFrame) != 0 && (claims & kPlate) != kPlate;
}

struct Edge {
    Point from, to;
    std::uint32_t left = 0, right = 0;
};

// A connected border of one kind of place.
struct Component {
    double twiceArea = 0;
    unsigned sides = 0;  // of the frame that it reaches along an edge
    plane::Box box;
    std::vector<std::size_t> edges;
};

class Finder {
public:
    Finder(std::vector<Edge> edges, plane::Box frame, std::int64_t tolerance, double unit)
        : edges_(std::move(edges)), frame_(frame), tolerance_(tolerance), unit_(unit) {}

    [[nodiscard]] Silhouette find(bool hasNotches) const {
        Silhouette silhouette;
        std::vector<Component> voids = componentsOf(isVoid);
        silhouette.area = areaOf(edges_, [](std::uint32_t claims) { return (claims & 1U << kSeen) != 0; });
        std::vector<char> isInVoid(edges_.size(), 0);
        std::vector<Component> found;
        for (Component& one : voids) {
            const bool isNotch =
                hasNotches && one.sides == kLow && double(one.box.high.v - one.box.low.v) * unit_ >= kLeastNotch;
            if ((one.sides != 0 && !isNotch) || metres2(one.twiceArea) < kLeastVoid) continue;
            for (const std::size_t e : one.edges) isInVoid[e] = 1;
            found.push_back(std::move(one));
        }
        std::sort(found.begin(), found.end(), [](const Component& a, const Component& b) {
            return std::tie(a.box.low.v, a.box.low.u) < std::tie(b.box.low.v, b.box.low.u);
        });
        for (const Component& one : found) silhouette.voids.push_back({metres2(one.twiceArea), std::nullopt});
        findRebates(found, silhouette);
        silhouette.perimeter = perimeterOf(isInVoid);
        return silhouette;
    }

private:
    [[nodiscard]] double metres2(double twiceUnits) const noexcept { return 0.5 * twiceUnits * unit_ * unit_; }

    [[nodiscard]] double twiceOf(const Edge& edge) const noexcept {
        return static_cast<double>(plane::cross(edge.from - frame_.low, edge.to - frame_.low));
    }
    template <class Is>
    [[nodiscard]] double areaOf(const std::vector<Edge>& edges, const Is& is) const {
        double twice = 0;
        for (const Edge& edge : edges)
            if (is(edge.left) != is(edge.right)) twice += is(edge.left) ? twiceOf(edge) : -twiceOf(edge);
        return metres2(twice);
    }

    // The side of the frame on which an edge lies; 0: none.
    [[nodiscard]] unsigned sideOf(const Edge& edge) const noexcept {
        const auto isAt = [&](std::int64_t a, std::int64_t b, std::int64_t at) {
            return std::abs(a - at) <= tolerance_ && std::abs(b - at) <= tolerance_;
        };
        if (isAt(edge.from.v, edge.to.v, frame_.low.v)) return kLow;
        if (isAt(edge.from.v, edge.to.v, frame_.high.v)) return kHigh;
        if (isAt(edge.from.u, edge.to.u, frame_.low.u)) return kLeft;
        return isAt(edge.from.u, edge.to.u, frame_.high.u) ? unsigned{kRight} : 0U;
    }

    // The connected borders of all places of a kind. Pieces of other kinds in a hole make it smaller.
    template <class Is>
    [[nodiscard]] std::vector<Component> componentsOf(const Is& is) const {
        std::map<Point, std::size_t> nodes;
        std::vector<std::size_t> parent;
        const auto rootOf = [&](std::size_t n) {
            while (parent[n] != n) n = parent[n] = parent[parent[n]];
            return n;
        };
        const auto nodeOf = [&](Point p) {
            const auto [at, isNew] = nodes.try_emplace(p, parent.size());
            if (isNew) parent.push_back(parent.size());
            return at->second;
        };
        std::vector<std::pair<std::size_t, std::size_t>> borders;  // edge, node
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            if (is(edges_[e].left) == is(edges_[e].right)) continue;
            const std::size_t a = nodeOf(edges_[e].from), b = nodeOf(edges_[e].to);
            parent[rootOf(a)] = rootOf(b);
            borders.emplace_back(e, a);
        }
        std::map<std::size_t, Component> byRoot;
        for (const auto& [e, node] : borders) {
            const Edge& edge = edges_[e];
            Component& one = byRoot[rootOf(node)];
            one.twiceArea += is(edge.left) ? twiceOf(edge) : -twiceOf(edge);
            one.box.add(edge.from);
            one.box.add(edge.to);
            one.edges.push_back(e);
            const std::uint32_t beyond = is(edge.left) ? edge.right : edge.left;
            if ((beyond & 1U << kFrame) == 0) one.sides |= sideOf(edge);
        }
        std::vector<Component> components, islands;
        for (auto& [root, one] : byRoot) (one.twiceArea > 0 ? components : islands).push_back(std::move(one));
        for (const Component& island : islands)
            if (Component* around = smallestAround(components, island.box)) {
                around->twiceArea += island.twiceArea;
                around->edges.insert(around->edges.end(), island.edges.begin(), island.edges.end());
            }
        return components;
    }

    static Component* smallestAround(std::vector<Component>& components, const plane::Box& box) {
        Component* best = nullptr;
        for (Component& one : components)
            if (one.box.contains(box.low) && one.box.contains(box.high) &&
                (best == nullptr || one.twiceArea < best->twiceArea))
                best = &one;
        return best;
    }

    // Thinner material around a void: reveals, rebates, splays.
    void findRebates(const std::vector<Component>& found, Silhouette& silhouette) const {
        std::vector<Component> thinner = componentsOf(isThinner);
        std::map<const Component*, std::vector<std::size_t>> voidsIn;
        for (std::size_t n = 0; n < found.size(); ++n)
            if (const Component* around = smallestAround(thinner, found[n].box))
                if ((around->sides & ~found[n].sides) == 0) voidsIn[around].push_back(n);
        for (const auto& [around, voids] : voidsIn) {
            double seen = 0;
            for (const std::size_t n : voids) seen += silhouette.voids[n].area;
            const double rebate = std::max(0.0, metres2(around->twiceArea) - seen);
            for (const std::size_t n : voids)
                silhouette.voids[n].rebate = rebate < kLeastVoid ? 0 : rebate * silhouette.voids[n].area / seen;
        }
    }

    // The length of the border between the body with closed voids, and all else.
    [[nodiscard]] double perimeterOf(const std::vector<char>& isInVoid) const {
        double length = 0;
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            const auto isBody = [&](std::uint32_t claims) {
                return (claims & 1U << kSeen) != 0 || (isInVoid[e] != 0 && isVoid(claims));
            };
            if (isBody(edges_[e].left) == isBody(edges_[e].right)) continue;
            const Point side = edges_[e].to - edges_[e].from;
            length += std::hypot(double(side.u), double(side.v)) * unit_;
        }
        return length;
    }

    std::vector<Edge> edges_;
    plane::Box frame_;
    std::int64_t tolerance_;
    double unit_;
};

void addTriangle(const std::array<Point, 3>& corners, std::uint32_t claim, std::vector<plane::ClaimSegment>& segments) {
    const int turn = plane::turn(corners[0], corners[1], corners[2]);
    if (turn == 0) return;
    for (std::size_t n = 0; n < 3; ++n) {
        const Point a = corners[n], b = corners[(n + 1) % 3];
        segments.push_back(turn > 0 ? plane::ClaimSegment{a, b, claim, 1} : plane::ClaimSegment{b, a, claim, 1});
    }
}

}  // namespace

std::optional<Silhouette> silhouetteOf(std::span<const FlatTriangle> triangles, bool hasNotches) {
    FlatPoint low{1e300, 1e300}, high{-1e300, -1e300};
    for (const FlatTriangle& triangle : triangles)
        if (triangle.claim != kBack)
            for (const FlatPoint& p : triangle.corners)
                for (std::size_t a = 0; a < 2; ++a) {
                    low[a] = std::min(low[a], p[a]);
                    high[a] = std::max(high[a], p[a]);
                }
    if (!(low[0] < high[0]) || !(low[1] < high[1])) return std::nullopt;
    double unit = kFinest;
    while (std::max(high[0] - low[0], high[1] - low[1]) / unit > kReach) unit *= 2;
    const auto placed = [&](const FlatPoint& p) -> Point {
        return {std::llround((p[0] - low[0]) / unit), std::llround((p[1] - low[1]) / unit)};
    };
    std::vector<plane::ClaimSegment> segments;
    for (const FlatTriangle& t : triangles) {
        const std::array<Point, 3> corners{placed(t.corners[0]), placed(t.corners[1]), placed(t.corners[2])};
        addTriangle(corners, t.claim, segments);
        if (t.claim == kFront) addTriangle(corners, kSeen, segments);
    }
    const plane::Box frame{{0, 0}, placed(high)};
    const std::array<Point, 4> corners{frame.low, Point{frame.high.u, 0}, frame.high, Point{0, frame.high.v}};
    for (std::size_t n = 0; n < 4; ++n) segments.push_back({corners[n], corners[(n + 1) % 4], kFrame, 1});
    std::optional<plane::Arrangement> arranged;
    auto tolerance = std::max(2, static_cast<std::int32_t>(std::lround(kMeetingDistance / unit)));
    for (int trial = 0; trial < 3 && !arranged; ++trial, tolerance *= 8)
        arranged = plane::arrangeSegments(segments, tolerance);
    if (!arranged) return std::nullopt;
    const auto sides = plane::sweepRegions(*arranged, [](std::span<const plane::ClaimCount> counts) -> std::uint32_t {
        std::uint32_t claims = 0;
        for (const plane::ClaimCount& count : counts)
            if (count.winding > 0) claims |= 1U << count.claim;
        return claims;
    });
    std::vector<Edge> edges;
    for (std::size_t e = 0; e < sides.size(); ++e)
        edges.push_back({arranged->edges[e].from, arranged->edges[e].to, sides[e].left, sides[e].right});
    Silhouette silhouette = Finder(std::move(edges), frame, 2 * std::int64_t{tolerance}, unit).find(hasNotches);
    silhouette.low = low;
    silhouette.high = high;
    return silhouette;
}

}  // namespace svt::quantities
