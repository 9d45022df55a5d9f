#include <svt/plane/edges.hpp>

#include <svt/plane/sweep.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace svt::plane {
namespace {

constexpr int kMaxRounds = 40;

// Where two edges cross: the place, rounded, and the fractions of both.
struct CrossingPlace {
    Point at;
    double t = 0, u = 0;
};

// One sweep from left to right (Shamos and Hoey 1976). Edges that touch or overlap are cut at once, because the place
// is a vertex. Where two edges cross, the sweep records the place and removes one of the edges (isKept()), so that the
// others stay in order. Both edges are cut after the sweep, and the next sweep tests their parts. A sweep that removes
// no edge proves that no edges cross.
class CrossingSweep {
public:
    CrossingSweep(EdgeGraph& graph, std::size_t maxCrossings, const MakePoint& makePoint)
        : graph_(graph),
          maxCrossings_(maxCrossings),
          makePoint_(makePoint),
          firstLater_(graph.vertices.size(), kNone),
          open_(BelowEdge<EndsOf>{{this}}) {}

    // Returns the count of crossings; over `maxCrossings`, nothing is cut.
    std::size_t run() {
        edges_.reserve(graph_.edges.size() + graph_.edges.size() / 4);
        const std::size_t count = graph_.vertices.size();  // new ones are added behind these
        std::size_t next = 0;
        for (std::uint32_t v = 0; v < count; ++v) {
            starting_.clear();
            for (; next < graph_.edges.size() && graph_.edges[next].left == v; ++next) start(graph_.edges[next]);
            for (std::uint32_t later = firstLater_[v]; later != kNone; later = later_[later].next)
                start({v, later_[later].right});
            visit(v);
            if (crossings_ > maxCrossings_) return crossings_;
        }
        cutNoted();
        return crossings_;
    }

private:
    struct SweptEdge {
        Edge ends;
        std::uint32_t cuts = 0;  // number of recorded cuts
    };
    // A cut that is made after the sweep.
    struct Cut {
        std::uint32_t edge, vertex;
    };
    // The rest of an edge that overlaps another edge up to a vertex.
    struct Later {
        std::uint32_t right, next;
    };
    struct EndsOf {
        const CrossingSweep* sweep;
        std::pair<Point, Point> operator()(std::uint32_t edge) const {
            const Edge& ends = sweep->edges_[edge].ends;
            return {sweep->at(ends.left), sweep->at(ends.right)};
        }
    };
    using Open = std::set<std::uint32_t, BelowEdge<EndsOf>>;

    [[nodiscard]] const Point& at(std::uint32_t vertex) const { return graph_.vertices[vertex].at; }
    [[nodiscard]] int side(const Edge& edge, std::uint32_t vertex) const {
        return turn(at(edge.left), at(edge.right), at(vertex));
    }

    void start(Edge ends) {
        starting_.push_back(static_cast<std::uint32_t>(edges_.size()));
        edges_.push_back({ends, 0});
    }

    void visit(std::uint32_t v) {
        auto above = open_.lower_bound(at(v));
        while (above != open_.end() && side(edges_[*above].ends, v) == 0) {
            const std::uint32_t edge = *above;
            above = open_.erase(above);
            const std::uint32_t right = edges_[edge].ends.right;
            if (right == v) continue;
            graph_.isTouching = true;
            if (edges_[edge].cuts != 0) {
                note(edge, v);  // it changes after the sweep, so it leaves it
                continue;
            }
            edges_[edge].ends.right = v;
            start({v, right});
        }
        joinOverlapping(v);
        for (const std::uint32_t edge : starting_) open_.insert(above, edge);
        if (starting_.empty()) {
            if (above != open_.begin() && above != open_.end()) testPair(std::prev(above), above);
            return;
        }
        // Crossing edges may be removed, so the neighbours are looked up again each time.
        const auto first = open_.find(starting_.front());
        if (first != open_.begin()) testPair(std::prev(first), first);
        const auto last = open_.find(starting_.back());
        if (last == open_.end()) return;
        if (std::next(last) != open_.end()) testPair(last, std::next(last));
    }

    // Sorts the edges that start at `v` from below. Among edges in the same direction, the shortest stays if their
    // number is odd; the rests of the others start where it ends.
    void joinOverlapping(std::uint32_t v) {
        std::sort(starting_.begin(), starting_.end(), [&](std::uint32_t a, std::uint32_t b) {
            const int turn = side(edges_[a].ends, edges_[b].ends.right);
            if (turn != 0) return turn > 0;
            const std::uint32_t p = edges_[a].ends.right, q = edges_[b].ends.right;
            return p != q ? p < q : a < b;
        });
        std::size_t kept = 0;
        for (std::size_t begin = 0, end = 0; begin < starting_.size(); begin = end) {
            const std::uint32_t nearest = edges_[starting_[begin]].ends.right;
            for (end = begin + 1; end < starting_.size(); ++end) {
                SweptEdge& edge = edges_[starting_[end]];
                if (side(edges_[starting_[begin]].ends, edge.ends.right) != 0) break;
                graph_.isTouching = true;
                if (edge.ends.right != nearest) {
                    later_.push_back({edge.ends.right, firstLater_[nearest]});
                    firstLater_[nearest] = static_cast<std::uint32_t>(later_.size() - 1);
                }
                edge.ends.right = v;  // without length: it goes when the graph is tidied
            }
            if ((end - begin) % 2 == 1)
                starting_[kept++] = starting_[begin];
            else
                edges_[starting_[begin]].ends.right = v;
        }
        starting_.resize(kept);
    }

    // Removes edges until the two neighbours do not cross.
    void testPair(Open::iterator lower, Open::iterator upper) {
        CrossingPlace place;
        while (crossingOf(edges_[*lower].ends, edges_[*upper].ends, place)) {
            if (++crossings_ > maxCrossings_) return;
            const std::uint32_t vertex = makeVertex(edges_[*lower].ends, edges_[*upper].ends, place);
            note(*lower, vertex);
            note(*upper, vertex);
            if (isKept(*lower, *upper)) {
                upper = open_.erase(upper);
                if (upper == open_.end()) return;
            } else {
                lower = open_.erase(lower);
                if (lower == open_.begin()) return;
                --lower;
            }
        }
    }

    // True if `a` rather than `b` stays in the sweep: the edge that crosses more, otherwise the longer one.
    [[nodiscard]] bool isKept(std::uint32_t a, std::uint32_t b) const {
        if (edges_[a].cuts != edges_[b].cuts) return edges_[a].cuts > edges_[b].cuts;
        const auto squared = [&](std::uint32_t edge) {
            const Point along = at(edges_[edge].ends.right) - at(edges_[edge].ends.left);
            return dot(along, along);
        };
        return squared(a) >= squared(b);
    }

    // True where the insides of two edges cross. An end of one on the other is found when the sweep comes to it.
    [[nodiscard]] bool crossingOf(const Edge& a, const Edge& b, CrossingPlace& place) const {
        if (side(a, b.left) * side(a, b.right) >= 0 || side(b, a.left) * side(b, a.right) >= 0) return false;
        const Point alongA = at(a.right) - at(a.left), alongB = at(b.right) - at(b.left);
        const Point between = at(b.left) - at(a.left);
        const auto whole = static_cast<double>(cross(alongA, alongB));
        place.t = static_cast<double>(cross(between, alongB)) / whole;
        place.u = static_cast<double>(cross(between, alongA)) / whole;
        place.at = {at(a.left).u + std::llround(static_cast<double>(alongA.u) * place.t),
                    at(a.left).v + std::llround(static_cast<double>(alongA.v) * place.t)};
        return true;
    }

    std::uint32_t makeVertex(const Edge& a, const Edge& b, const CrossingPlace& place) {
        graph_.isTouching = true;
        const auto pointsOf = [&](const Edge& edge) {
            return std::pair{graph_.vertices[edge.left].point, graph_.vertices[edge.right].point};
        };
        const std::uint32_t point = makePoint_(pointsOf(a), place.t, pointsOf(b), place.u);
        graph_.vertices.push_back({place.at, point});
        return static_cast<std::uint32_t>(graph_.vertices.size() - 1);
    }

    void note(std::uint32_t edge, std::uint32_t vertex) {
        ++edges_[edge].cuts;
        cuts_.push_back({edge, vertex});
    }

    // The edges of the next sweep.
    void cutNoted() {
        const auto along = [&](const Cut& cut) {
            const Edge& ends = edges_[cut.edge].ends;
            return dot(at(ends.right) - at(ends.left), at(cut.vertex) - at(ends.left));
        };
        std::sort(cuts_.begin(), cuts_.end(), [&](const Cut& a, const Cut& b) {
            if (a.edge != b.edge) return a.edge < b.edge;
            const Wide p = along(a), q = along(b);
            return p != q ? p < q : a.vertex < b.vertex;
        });
        graph_.edges.clear();
        auto cut = cuts_.begin();
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            std::uint32_t from = edges_[e].ends.left;
            for (; cut != cuts_.end() && cut->edge == e; ++cut) {
                graph_.edges.push_back({from, cut->vertex});
                from = cut->vertex;
            }
            graph_.edges.push_back({from, edges_[e].ends.right});
        }
    }

    EdgeGraph& graph_;
    std::size_t maxCrossings_;
    const MakePoint& makePoint_;
    std::vector<SweptEdge> edges_;
    std::vector<Cut> cuts_;
    std::vector<Later> later_;
    std::vector<std::uint32_t> firstLater_;  // per vertex
    std::vector<std::uint32_t> starting_;    // edges that start at the vertex that is visited
    Open open_;                              // the edges that the sweeping line meets
    std::size_t crossings_ = 0;
};

}  // namespace

void EdgeGraph::tidy() {
    std::vector<std::uint32_t> order(vertices.size()), place(vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        if (!(vertices[a].at == vertices[b].at)) return vertices[a].at < vertices[b].at;
        return vertices[a].point < vertices[b].point;
    });
    std::vector<Vertex> sorted;
    sorted.reserve(vertices.size());
    for (const std::uint32_t v : order) {
        if (sorted.empty() || !(sorted.back().at == vertices[v].at))
            sorted.push_back(vertices[v]);
        else
            isTouching = true;
        place[v] = static_cast<std::uint32_t>(sorted.size() - 1);
    }
    vertices = std::move(sorted);
    for (Edge& edge : edges) {
        edge = {place[edge.left], place[edge.right]};
        if (edge.right < edge.left) std::swap(edge.left, edge.right);
    }
    std::erase_if(edges, [](const Edge& edge) { return edge.left == edge.right; });
    std::sort(edges.begin(), edges.end());
    std::size_t kept = 0;
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        for (end = begin; end < edges.size() && edges[end] == edges[begin]; ++end) {
        }
        if (end - begin > 1) isTouching = true;
        if ((end - begin) % 2 == 1) edges[kept++] = edges[begin];
    }
    edges.resize(kept);
}

bool cutCrossings(EdgeGraph& graph, std::size_t maxCrossings, const MakePoint& makePoint) {
    for (int round = 0; round < kMaxRounds; ++round) {
        const std::size_t crossings = CrossingSweep(graph, maxCrossings, makePoint).run();
        if (crossings > maxCrossings) return false;
        maxCrossings -= crossings;
        graph.tidy();
        if (crossings == 0) return true;
    }
    return false;
}

bool meetBeyondEnds(std::span<const std::pair<Point, Point>> edges) {
    EdgeGraph graph;
    for (const auto& [from, to] : edges) {
        const auto first = static_cast<std::uint32_t>(graph.vertices.size());
        graph.vertices.push_back({from, first});
        graph.vertices.push_back({to, first + 1});
        graph.edges.push_back({first, first + 1});
    }
    graph.tidy();
    if (graph.edges.size() != edges.size()) return true;  // without length, or equal
    std::vector<std::uint8_t> uses(graph.vertices.size(), 0);
    for (const Edge& edge : graph.edges)
        if (++uses[edge.left] > 2 || ++uses[edge.right] > 2) return true;
    graph.isTouching = false;  // true for joined ends until here
    return !cutCrossings(graph, 0, {}) || graph.isTouching;
}

}  // namespace svt::plane
