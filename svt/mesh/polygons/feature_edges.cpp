#include <svt/mesh/feature_edges.hpp>
#include <svt/mesh/polygons/edges.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace svt::mesh {
namespace {

// An edge, and the unit direction from it into one of its triangles, perpendicular to the edge.
struct Wing {
    std::uint32_t low, high;
    Vec3d direction;
    [[nodiscard]] bool isSameEdge(const Wing& other) const { return low == other.low && high == other.high; }
};

// Height of the triangle above its longest side, metres.
double leastHeight(const std::vector<Vec3d>& vertices, const Triangle& triangle) {
    const Vec3d a = vertices[triangle.corners[0]], b = vertices[triangle.corners[1]], c = vertices[triangle.corners[2]];
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    return longest > 0 ? length(cross(b - a, c - a)) / longest : 0;
}

std::vector<Wing> collectWings(const std::vector<Vec3d>& vertices, const std::vector<Triangle>& triangles) {
    std::vector<Wing> wings;
    wings.reserve(triangles.size() * 3);
    for (const Triangle& triangle : triangles)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t a = triangle.corners[c], b = triangle.corners[(c + 1) % 3];
            const Vec3d along = normalized(vertices[b] - vertices[a]);
            const Vec3d inside = vertices[triangle.corners[(c + 2) % 3]] - vertices[a];
            wings.push_back({std::min(a, b), std::max(a, b), normalized(inside - along * dot(inside, along))});
        }
    std::stable_sort(wings.begin(), wings.end(),
                     [](const Wing& p, const Wing& q) { return std::tie(p.low, p.high) < std::tie(q.low, q.high); });
    return wings;
}

// True if all wings are coplanar, with some on both sides of the edge.
bool isFlat(const Wing* begin, const Wing* end, double leastCosine) {
    bool hasOpposite = false;
    for (const Wing* wing = begin + 1; wing != end; ++wing) {
        const double cosine = dot(begin->direction, wing->direction);
        if (std::abs(cosine) < leastCosine) return false;
        hasOpposite = hasOpposite || cosine < 0;
    }
    return hasOpposite;
}

// Joins collinear edges that follow each other.
class Joiner {
public:
    Joiner(const std::vector<Vec3d>& vertices, std::vector<FeatureEdge> edges, double tolerance)
        : vertices_(vertices), edges_(std::move(edges)), tolerance_(tolerance), isUsed_(edges_.size(), 0) {
        sortByLength(edges_);
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            ends_.push_back({edges_[e].from, e});
            ends_.push_back({edges_[e].to, e});
        }
        std::sort(ends_.begin(), ends_.end());
    }

    std::vector<FeatureEdge> join() {
        std::vector<FeatureEdge> joined;
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            if (isUsed_[e] != 0) continue;
            isUsed_[e] = 1;
            const FeatureEdge edge = edges_[e];
            joined.push_back({follow(edge.to, edge.from), follow(edge.from, edge.to)});
        }
        sortByLength(joined);
        return joined;
    }

private:
    void sortByLength(std::vector<FeatureEdge>& edges) const {
        const auto squared = [&](const FeatureEdge& edge) {
            const Vec3d along = vertices_[edge.to] - vertices_[edge.from];
            return dot(along, along);
        };
        for (FeatureEdge& edge : edges)
            if (edge.from > edge.to) std::swap(edge.from, edge.to);
        std::sort(edges.begin(), edges.end(), [&](const FeatureEdge& p, const FeatureEdge& q) {
            return std::tuple(-squared(p), p.from, p.to) < std::tuple(-squared(q), q.from, q.to);
        });
    }

    // Extends the line from `from` through `to`; returns its last vertex.
    std::uint32_t follow(std::uint32_t from, std::uint32_t to) {
        const Vec3d start = vertices_[from], along = normalized(vertices_[to] - start);
        while (true) {
            const std::uint32_t next = nextOn(start, along, to);
            if (next == to) return to;
            to = next;
        }
    }
    std::uint32_t nextOn(Vec3d start, Vec3d along, std::uint32_t at) {
        auto it = std::lower_bound(ends_.begin(), ends_.end(), std::pair<std::uint32_t, std::uint32_t>{at, 0});
        for (; it != ends_.end() && it->first == at; ++it) {
            if (isUsed_[it->second] != 0) continue;
            const FeatureEdge& edge = edges_[it->second];
            const std::uint32_t far = edge.from == at ? edge.to : edge.from;
            const Vec3d step = vertices_[far] - vertices_[at];
            if (dot(step, along) <= 0 || length(cross(step, along)) > 0.01 * length(step)) continue;
            if (length(cross(vertices_[far] - start, along)) > tolerance_) continue;
            isUsed_[it->second] = 1;
            return far;
        }
        return at;
    }

    const std::vector<Vec3d>& vertices_;
    std::vector<FeatureEdge> edges_;
    double tolerance_;
    std::vector<std::uint8_t> isUsed_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ends_;  // vertex, edge
};

}  // namespace

std::vector<FeatureEdge> findFeatureEdges(const ObjectMesh& mesh, const FeatureEdgeOptions& options) {
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.triangles.size());
    // Leave out slivers: they hide the angle between their neighbours. The neighbours are then split to match.
    for (const Triangle& triangle : mesh.triangles)
        if (leastHeight(mesh.vertices, triangle) > options.tolerance) triangles.push_back(triangle);
    std::vector<Vec3d> vertices = mesh.vertices;
    cutAtTJunctions(vertices, triangles, options.tolerance);

    const std::vector<Wing> wings = collectWings(vertices, triangles);
    const double leastCosine = std::cos(options.creaseAngleDegrees * std::numbers::pi / 180);
    std::vector<FeatureEdge> edges;
    for (std::size_t begin = 0; begin < wings.size();) {
        std::size_t end = begin + 1;
        while (end < wings.size() && wings[end].isSameEdge(wings[begin])) ++end;
        if (!isFlat(&wings[begin], wings.data() + end, leastCosine))
            edges.push_back({wings[begin].low, wings[begin].high});
        begin = end;
    }
    return Joiner(vertices, std::move(edges), options.tolerance).join();
}

}  // namespace svt::mesh
