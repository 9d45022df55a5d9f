#include <svt/mesh/polygons/edges.hpp>

#include <algorithm>
#include <map>
#include <numeric>

namespace svt::mesh {
namespace {

// A use of an edge by a triangle: the undirected edge, the triangle, and whether it runs from `low` to `high`.
struct EdgeUse {
    std::uint32_t low, high;
    std::uint32_t triangle;
    bool isForward;
    friend bool operator<(const EdgeUse& a, const EdgeUse& b) {
        if (a.low != b.low) return a.low < b.low;
        if (a.high != b.high) return a.high < b.high;
        return a.triangle < b.triangle;
    }
    [[nodiscard]] bool isSameEdge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

std::vector<EdgeUse> collectEdgeUses(const std::vector<Triangle>& triangles) {
    std::vector<EdgeUse> uses;
    uses.reserve(triangles.size() * 3);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (int c = 0; c < 3; ++c) {
            const std::uint32_t a = triangles[t].corners[std::size_t(c)];
            const std::uint32_t b = triangles[t].corners[std::size_t((c + 1) % 3)];
            uses.push_back({std::min(a, b), std::max(a, b), t, a < b});
        }
    }
    std::sort(uses.begin(), uses.end());
    return uses;
}

template <class F>
void forEachEdge(const std::vector<EdgeUse>& uses, F&& body) {
    for (std::size_t begin = 0; begin < uses.size();) {
        std::size_t end = begin + 1;
        while (end < uses.size() && uses[end].isSameEdge(uses[begin])) ++end;
        body(begin, end);
        begin = end;
    }
}

// Disjoint sets with path halving.
struct UnionFind {
    std::vector<std::uint32_t> parent;
    explicit UnionFind(std::size_t n) : parent(n) { std::iota(parent.begin(), parent.end(), 0u); }
    std::uint32_t find(std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        if (a != b) parent[std::max(a, b)] = std::min(a, b);
    }
};

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

// Finds ends of open edges that lie on other open edges. Points are sorted along x, so that each edge tests only those
// in its x range.
std::vector<EdgeCut> findCuts(const std::vector<Vec3d>& vertices, const std::vector<OpenEdge>& open, double distance) {
    std::vector<std::uint32_t> points;
    for (const OpenEdge& edge : open) {
        points.push_back(edge.from);
        points.push_back(edge.to);
    }
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        return vertices[a].x != vertices[b].x ? vertices[a].x < vertices[b].x : a < b;
    };
    std::sort(points.begin(), points.end(), before);
    points.erase(std::unique(points.begin(), points.end()), points.end());

    std::vector<EdgeCut> cuts;
    std::pair<std::uint32_t, std::uint32_t> previous{0, 0};
    for (const OpenEdge& edge : open) {
        const std::pair<std::uint32_t, std::uint32_t> key = std::minmax(edge.from, edge.to);
        if (key == previous && !cuts.empty()) continue;
        previous = key;
        const Vec3d a = vertices[key.first], b = vertices[key.second];
        const double low = std::min(a.x, b.x) - distance, high = std::max(a.x, b.x) + distance;
        auto it = std::lower_bound(points.begin(), points.end(), low,
                                   [&](std::uint32_t point, double x) { return vertices[point].x < x; });
        for (; it != points.end() && vertices[*it].x <= high; ++it) {
            if (*it == key.first || *it == key.second) continue;
            const double fraction = fractionOnEdge(vertices[*it], a, b, distance);
            if (fraction > 0) cuts.push_back({key.first, key.second, *it, fraction});
        }
    }
    std::sort(cuts.begin(), cuts.end(), [](const EdgeCut& p, const EdgeCut& q) {
        return std::tie(p.from, p.to, p.fraction, p.point) < std::tie(q.from, q.to, q.fraction, q.point);
    });
    cuts.erase(std::unique(cuts.begin(), cuts.end(),
                           [](const EdgeCut& p, const EdgeCut& q) {
                               return p.from == q.from && p.to == q.to && p.point == q.point;
                           }),
               cuts.end());
    return cuts;
}

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

// Triangulates a triangle with additional points on its border by ear clipping, largest ear first. An ear must not lie
// on one edge, and the remaining points must not either, so that no triangle is degenerate.
void emitCutTriangle(const std::vector<Vec3d>& vertices, std::vector<BorderPoint> ring, const Triangle& source,
                     std::vector<Triangle>& out) {
    const auto twiceArea = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return length(cross(vertices[b] - vertices[a], vertices[c] - vertices[a]));
    };
    std::size_t notOn[3] = {0, 0, 0};  // per edge: count of points of the ring that are not on it
    const auto count = [&](const BorderPoint& point, bool isAdded) {
        for (unsigned e = 0; e < 3; ++e)
            if ((point.edges >> e & 1u) == 0) isAdded ? ++notOn[e] : --notOn[e];
    };
    for (const BorderPoint& point : ring) count(point, true);
    const auto isRestFlat = [&](const BorderPoint& without) {
        for (unsigned e = 0; e < 3; ++e)
            if (notOn[e] == ((without.edges >> e & 1u) == 0 ? 1u : 0u)) return true;
        return false;
    };
    while (ring.size() > 3) {
        const std::size_t n = ring.size();
        std::size_t best = 0;
        double bestArea = -1;
        for (std::size_t i = 0; i < n; ++i) {
            const BorderPoint &a = ring[(i + n - 1) % n], &b = ring[i], &c = ring[(i + 1) % n];
            if ((a.edges & b.edges & c.edges) != 0 || isRestFlat(b)) continue;
            const double area = twiceArea(a.vertex, b.vertex, c.vertex);
            if (area > bestArea) {
                bestArea = area;
                best = i;
            }
        }
        Triangle ear = source;
        ear.corners = {ring[(best + n - 1) % n].vertex, ring[best].vertex, ring[(best + 1) % n].vertex};
        out.push_back(ear);
        count(ring[best], false);
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(best));
    }
    Triangle last = source;
    last.corners = {ring[0].vertex, ring[1].vertex, ring[2].vertex};
    out.push_back(last);
}

// True if the centroid of `triangle` lies in one of `others` that is coplanar and faces the same way.
bool isCovered(const std::vector<Vec3d>& vertices, const Triangle& triangle, const std::vector<Triangle>& others) {
    constexpr double kSamePlane = 1e-4;
    const auto corner = [&](const Triangle& t, std::size_t c) { return vertices[t.corners[c]]; };
    const auto normalOf = [&](const Triangle& t) {
        return cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
    };
    const Vec3d middle = (corner(triangle, 0) + corner(triangle, 1) + corner(triangle, 2)) / 3.0;
    const Vec3d unit = normalized(normalOf(triangle));
    return std::any_of(others.begin(), others.end(), [&](const Triangle& other) {
        if (std::abs(dot(middle - corner(other, 0), unit)) > kSamePlane) return false;
        if (!(dot(normalized(normalOf(other)), unit) > 0.99)) return false;
        for (std::size_t c = 0; c < 3; ++c) {
            const Vec3d edge = corner(other, (c + 1) % 3) - corner(other, c);
            if (dot(cross(edge, middle - corner(other, c)), unit) < -1e-9 * length(edge)) return false;
        }
        return true;
    });
}

void flip(Triangle& triangle) { std::swap(triangle.corners[1], triangle.corners[2]); }

// Signed crossings of the ray from `point` towards +z with a component. A ray through an edge is not resolved; that is
// good enough for a containment test.
int windingAlongZ(Vec3d point, const std::vector<Vec3d>& vertices, const std::vector<Triangle>& triangles,
                  const std::vector<std::uint32_t>& members) {
    int winding = 0;
    for (const std::uint32_t t : members) {
        const auto& c = triangles[t].corners;
        const Vec3d p[3] = {vertices[c[0]] - point, vertices[c[1]] - point, vertices[c[2]] - point};
        bool isInside[2] = {true, true};
        for (int e = 0; e < 3; ++e) {
            const Vec3d &a = p[e], &b = p[(e + 1) % 3];
            const double side = a.x * b.y - b.x * a.y;
            if (side < 0) isInside[0] = false;
            if (side >= 0) isInside[1] = false;
        }
        if (!isInside[0] && !isInside[1]) continue;
        const Vec3d normal = cross(p[1] - p[0], p[2] - p[0]);
        if (normal.z == 0) continue;
        if (dot(normal, p[0]) / normal.z > 0) winding += normal.z > 0 ? 1 : -1;
    }
    return winding;
}

}  // namespace

double signedVolume(const std::vector<Vec3d>& vertices, const std::vector<Triangle>& triangles) noexcept {
    if (vertices.empty()) return 0;
    const Vec3d base = vertices[0];
    double volume = 0;
    for (const Triangle& triangle : triangles)
        volume += dot(vertices[triangle.corners[0]] - base,
                      cross(vertices[triangle.corners[1]] - base, vertices[triangle.corners[2]] - base));
    return volume / 6;
}

std::vector<OpenEdge> findOpenEdges(const std::vector<Triangle>& triangles) {
    std::vector<OpenEdge> open;
    const std::vector<EdgeUse> uses = collectEdgeUses(triangles);
    forEachEdge(uses, [&](std::size_t begin, std::size_t end) {
        int net = 0;
        for (std::size_t i = begin; i < end; ++i) net += uses[i].isForward ? 1 : -1;
        const OpenEdge edge =
            net > 0 ? OpenEdge{uses[begin].low, uses[begin].high} : OpenEdge{uses[begin].high, uses[begin].low};
        for (int i = 0; i < std::abs(net); ++i) open.push_back(edge);
    });
    std::sort(open.begin(), open.end(),
              [](const OpenEdge& a, const OpenEdge& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
    return open;
}

std::uint32_t cutAtTJunctions(std::vector<Vec3d>& vertices, std::vector<Triangle>& triangles, double distance) {
    std::uint32_t count = 0;
    // A split can expose another point on an edge; a few rounds settle all.
    for (int round = 0; round < 8; ++round) {
        const std::vector<OpenEdge> open = findOpenEdges(triangles);
        if (open.empty()) break;
        const std::vector<EdgeCut> cuts = findCuts(vertices, open, distance);
        if (cuts.empty()) break;
        count += static_cast<std::uint32_t>(cuts.size());
        std::vector<Triangle> result;
        result.reserve(triangles.size() + cuts.size() * 2);
        for (const Triangle& triangle : triangles) {
            std::vector<BorderPoint> ring = ringWithCuts(triangle, cuts);
            if (ring.size() == 3)
                result.push_back(triangle);
            else
                emitCutTriangle(vertices, std::move(ring), triangle, result);
        }
        triangles = std::move(result);
    }
    return count;
}

std::uint32_t removeDoubledFaces(const std::vector<Vec3d>& vertices, std::vector<Triangle>& triangles) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;  // uses per directed edge
    for (const Triangle& triangle : triangles)
        for (std::size_t c = 0; c < 3; ++c) ++uses[{triangle.corners[c], triangle.corners[(c + 1) % 3]}];
    std::vector<std::uint8_t> isGone(triangles.size(), 0);
    std::uint32_t removed = 0;
    for (bool hasChanged = true; hasChanged;) {
        hasChanged = false;
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            if (isGone[t]) continue;
            int excess = 0;
            bool isDoubled = false;
            for (std::size_t c = 0; c < 3; ++c) {
                const std::uint32_t a = triangles[t].corners[c], b = triangles[t].corners[(c + 1) % 3];
                const auto back = uses.find({b, a});
                const int forward = uses[{a, b}], backward = back == uses.end() ? 0 : back->second;
                excess += forward > backward;
                isDoubled = isDoubled || (forward > backward && (backward > 0 || removed != 0));
            }
            if (excess < 2 || !isDoubled) continue;
            for (std::size_t c = 0; c < 3; ++c) --uses[{triangles[t].corners[c], triangles[t].corners[(c + 1) % 3]}];
            isGone[t] = 1;
            ++removed;
            hasChanged = true;
        }
    }
    if (removed == 0) return 0;
    std::vector<Triangle> kept;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (!isGone[t]) kept.push_back(triangles[t]);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (isGone[t] && !isCovered(vertices, triangles[t], kept)) return 0;
    if (kept.empty() || findOpenEdges(kept).size() >= findOpenEdges(triangles).size()) return 0;
    triangles = std::move(kept);
    return removed;
}

std::vector<std::uint32_t> findComponents(const std::vector<Triangle>& triangles) {
    UnionFind sets(triangles.size());
    const std::vector<EdgeUse> uses = collectEdgeUses(triangles);
    forEachEdge(uses, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin + 1; i < end; ++i) sets.join(uses[begin].triangle, uses[i].triangle);
    });
    std::vector<std::uint32_t> component(triangles.size());
    std::vector<std::uint32_t> number(triangles.size(), 0xFFFFFFFFu);
    std::uint32_t next = 0;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const std::uint32_t root = sets.find(t);
        if (number[root] == 0xFFFFFFFFu) number[root] = next++;
        component[t] = number[root];
    }
    return component;
}

std::uint32_t orientConsistently(std::vector<Triangle>& triangles) {
    const std::vector<EdgeUse> uses = collectEdgeUses(triangles);
    // Neighbours across edges with exactly two uses; `isAgreeing` if these run in opposite directions.
    struct Link {
        std::uint32_t triangle, neighbour;
        bool isAgreeing;
    };
    std::vector<Link> links;
    bool hasConflict = false;
    forEachEdge(uses, [&](std::size_t begin, std::size_t end) {
        if (end - begin != 2) return;
        const bool agrees = uses[begin].isForward != uses[begin + 1].isForward;
        hasConflict = hasConflict || !agrees;
        links.push_back({uses[begin].triangle, uses[begin + 1].triangle, agrees});
        links.push_back({uses[begin + 1].triangle, uses[begin].triangle, agrees});
    });
    if (!hasConflict) return 0;
    std::sort(links.begin(), links.end(), [](const Link& a, const Link& b) {
        return std::tie(a.triangle, a.neighbour) < std::tie(b.triangle, b.neighbour);
    });
    std::vector<std::uint32_t> firstLink(triangles.size() + 1, 0);
    for (const Link& link : links) ++firstLink[link.triangle + 1];
    std::partial_sum(firstLink.begin(), firstLink.end(), firstLink.begin());

    constexpr std::uint8_t kUnseen = 2;
    std::vector<std::uint8_t> turn(triangles.size(), kUnseen);
    std::uint32_t flipped = 0;
    for (std::uint32_t seed = 0; seed < triangles.size(); ++seed) {
        if (turn[seed] != kUnseen) continue;
        std::vector<std::uint32_t> members{seed};
        turn[seed] = 0;
        bool isConsistent = true;
        for (std::size_t i = 0; i < members.size(); ++i) {
            const std::uint32_t t = members[i];
            for (std::uint32_t l = firstLink[t]; l < firstLink[t + 1]; ++l) {
                const std::uint8_t wanted = links[l].isAgreeing ? turn[t] : std::uint8_t(1 - turn[t]);
                std::uint8_t& known = turn[links[l].neighbour];
                if (known == kUnseen) {
                    known = wanted;
                    members.push_back(links[l].neighbour);
                } else if (known != wanted) {
                    isConsistent = false;
                }
            }
        }
        if (!isConsistent) continue;
        std::size_t turned = 0;
        for (const std::uint32_t t : members) turned += turn[t];
        const std::uint8_t toTurn = turned * 2 > members.size() ? 0 : 1;
        for (const std::uint32_t t : members) {
            if (turn[t] != toTurn) continue;
            flip(triangles[t]);
            ++flipped;
        }
    }
    return flipped;
}

std::uint32_t orientOutwards(const std::vector<Vec3d>& vertices, std::vector<Triangle>& triangles) {
    const std::vector<std::uint32_t> component = findComponents(triangles);
    const std::uint32_t count = component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
    std::vector<std::vector<std::uint32_t>> members(count);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) members[component[t]].push_back(t);
    std::vector<double> volume(count, 0);
    std::vector<Box3d> bounds(count);
    std::vector<Triangle> part;
    for (std::uint32_t c = 0; c < count; ++c) {
        part.clear();
        for (const std::uint32_t t : members[c]) {
            part.push_back(triangles[t]);
            for (const std::uint32_t corner : triangles[t].corners) bounds[c].add(vertices[corner]);
        }
        volume[c] = signedVolume(vertices, part);
    }
    std::uint32_t flipped = 0;
    for (std::uint32_t c = 0; c < count; ++c) {
        if (!(volume[c] < 0)) continue;
        // A void, inside a larger component, must face inwards.
        const auto& corners = triangles[members[c][0]].corners;
        const Vec3d probe = (vertices[corners[0]] + vertices[corners[1]] + vertices[corners[2]]) / 3.0;
        bool isVoid = false;
        for (std::uint32_t other = 0; other < count && !isVoid; ++other)
            if (other != c && std::abs(volume[other]) > std::abs(volume[c]) && bounds[other].contains(probe))
                isVoid = windingAlongZ(probe, vertices, triangles, members[other]) != 0;
        if (isVoid) continue;
        for (const std::uint32_t t : members[c]) flip(triangles[t]);
        flipped += static_cast<std::uint32_t>(members[c].size());
    }
    return flipped;
}

std::vector<std::vector<std::uint32_t>> findBoundaryLoops(const std::vector<OpenEdge>& edges) {
    // The missing face uses the open edges in reverse direction.
    std::multimap<std::uint32_t, std::uint32_t> next;
    for (const OpenEdge& edge : edges) next.emplace(edge.to, edge.from);
    std::vector<std::vector<std::uint32_t>> loops;
    while (!next.empty()) {
        std::vector<std::uint32_t> path{next.begin()->first};
        for (;;) {
            const auto step = next.find(path.back());
            if (step == next.end()) break;
            const std::uint32_t corner = step->second;
            next.erase(step);
            const auto seen = std::find(path.begin(), path.end(), corner);
            if (seen == path.end()) {
                path.push_back(corner);
                continue;
            }
            // The path has closed a loop: emit it, and continue from the corner where it began.
            loops.emplace_back(seen, path.end());
            path.erase(seen + 1, path.end());
        }
    }
    return loops;
}

}  // namespace svt::mesh
