#include <svt/mesh/polygons/edges.hpp>

#include <svt/mesh/polygons/edge_uses.hpp>
#include <svt/plane/box_tree.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <unordered_map>

namespace svt::mesh {
namespace {

constexpr std::size_t kMaxDoubledVisits = std::size_t{1} << 28;  // of removeDoubledFaces()

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

// How often each edge of triangles is used, per direction.
class EdgeCounts {
public:
    explicit EdgeCounts(const std::vector<Triangle>& triangles) : edgeOf_(triangles.size() * 3) {
        const std::vector<EdgeUse> uses = collectEdgeUses(triangles);
        forEachEdge(uses, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const auto& corners = triangles[uses[i].triangle].corners;
                for (std::size_t c = 0; c < 3; ++c) {
                    const std::uint32_t a = corners[c], b = corners[(c + 1) % 3];
                    if (std::min(a, b) == uses[i].low && std::max(a, b) == uses[i].high)
                        edgeOf_[uses[i].triangle * std::size_t{3} + c] = {
                            static_cast<std::uint32_t>(counts_.size() / 2), a < b};
                }
            }
            counts_.insert(counts_.end(), 2, 0);
            for (std::size_t i = begin; i < end; ++i) ++counts_[counts_.size() - (uses[i].isForward ? 1 : 2)];
        });
    }

    // Uses of edge c of triangle t in its direction, and against it.
    [[nodiscard]] int forward(std::uint32_t t, std::uint32_t c) const { return counts_[place(t, c, true)]; }
    [[nodiscard]] int backward(std::uint32_t t, std::uint32_t c) const { return counts_[place(t, c, false)]; }

    void remove(std::uint32_t t) {
        for (std::uint32_t c = 0; c < 3; ++c) --counts_[place(t, c, true)];
    }

private:
    struct Side {
        std::uint32_t edge;
        bool isForward;
    };
    [[nodiscard]] std::size_t place(std::uint32_t t, std::uint32_t c, bool isAlong) const {
        const Side& side = edgeOf_[t * std::size_t{3} + c];
        return side.edge * std::size_t{2} + (side.isForward == isAlong ? 1 : 0);
    }

    std::vector<Side> edgeOf_;  // per triangle, three
    std::vector<int> counts_;   // per edge: uses from high to low, and from low to high
};

// Tests whether triangles are covered by others.
class Cover {
public:
    Cover(const std::vector<Vec3d>& vertices, const std::vector<Triangle>& others)
        : vertices_(vertices), others_(others), tree_(boxesOf(vertices, others)) {}

    // True if the centroid of `triangle` lies in one of the others that is coplanar and faces the same way.
    [[nodiscard]] bool contains(const Triangle& triangle) const {
        const Vec3d middle = (corner(triangle, 0) + corner(triangle, 1) + corner(triangle, 2)) / 3.0;
        const Vec3d unit = normalized(normalOf(triangle));
        return tree_.visit([&](const Box3d& box) { return box.contains(middle); },
                           [&](std::uint32_t i) { return isIn(middle, unit, others_[i]); });
    }

private:
    static constexpr double kSamePlane = 1e-4;

    // As large as isIn() can hold in: normals may differ by 8 degrees, of which the tangent is 0.14.
    static std::vector<Box3d> boxesOf(const std::vector<Vec3d>& vertices, const std::vector<Triangle>& triangles) {
        std::vector<Box3d> boxes(triangles.size());
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            for (const std::uint32_t c : triangles[t].corners) boxes[t].add(vertices[c]);
            const double margin = 2 * kSamePlane + 0.2 * length(boxes[t].size());
            boxes[t].min = boxes[t].min - Vec3d{margin, margin, margin};
            boxes[t].max = boxes[t].max + Vec3d{margin, margin, margin};
        }
        return boxes;
    }

    [[nodiscard]] Vec3d corner(const Triangle& t, std::size_t c) const { return vertices_[t.corners[c]]; }
    [[nodiscard]] Vec3d normalOf(const Triangle& t) const {
        return cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
    }

    [[nodiscard]] bool isIn(Vec3d middle, Vec3d unit, const Triangle& other) const {
        if (std::abs(dot(middle - corner(other, 0), unit)) > kSamePlane) return false;
        if (!(dot(normalized(normalOf(other)), unit) > 0.99)) return false;
        for (std::size_t c = 0; c < 3; ++c) {
            const Vec3d edge = corner(other, (c + 1) % 3) - corner(other, c);
            if (dot(cross(edge, middle - corner(other, c)), unit) < -1e-9 * length(edge)) return false;
        }
        return true;
    }

    const std::vector<Vec3d>& vertices_;
    const std::vector<Triangle>& others_;
    plane::BoxTree tree_;
};

void flip(Triangle& triangle) { std::swap(triangle.corners[1], triangle.corners[2]); }

// Signed crossings of the ray from `point` towards +z with a triangle: -1, 0 or 1. A ray through an edge is not
// resolved; that is good enough for a containment test.
int crossingAlongZ(Vec3d point, const std::vector<Vec3d>& vertices, const Triangle& triangle) {
    const auto& c = triangle.corners;
    const Vec3d p[3] = {vertices[c[0]] - point, vertices[c[1]] - point, vertices[c[2]] - point};
    bool isInside[2] = {true, true};
    for (int e = 0; e < 3; ++e) {
        const Vec3d &a = p[e], &b = p[(e + 1) % 3];
        const double side = a.x * b.y - b.x * a.y;
        if (side < 0) isInside[0] = false;
        if (side >= 0) isInside[1] = false;
    }
    if (!isInside[0] && !isInside[1]) return 0;
    const Vec3d normal = cross(p[1] - p[0], p[2] - p[0]);
    if (normal.z == 0 || !(dot(normal, p[0]) / normal.z > 0)) return 0;
    return normal.z > 0 ? 1 : -1;
}

// The components of a mesh, and which of them enclose a point.
class Components {
public:
    Components(const std::vector<Vec3d>& vertices, const std::vector<Triangle>& triangles)
        : vertices_(vertices), triangles_(triangles) {
        const std::vector<std::uint32_t> component = findComponents(triangles);
        const std::size_t count =
            component.empty() ? 0 : std::size_t{1} + *std::max_element(component.begin(), component.end());
        members_.resize(count);
        volume_.resize(count);
        bounds_.resize(count);
        trees_.resize(count);
        for (std::uint32_t t = 0; t < triangles.size(); ++t) members_[component[t]].push_back(t);
        std::vector<Triangle> part;
        for (std::size_t c = 0; c < count; ++c) {
            part.clear();
            for (const std::uint32_t t : members_[c]) {
                part.push_back(triangles[t]);
                for (const std::uint32_t corner : triangles[t].corners) bounds_[c].add(vertices[corner]);
            }
            volume_[c] = signedVolume(vertices, part);
        }
    }

    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(members_.size()); }
    [[nodiscard]] const std::vector<std::uint32_t>& members(std::uint32_t c) const { return members_[c]; }
    [[nodiscard]] double volume(std::uint32_t c) const { return volume_[c]; }

    // True if a component larger than `c` encloses it.
    [[nodiscard]] bool isEnclosed(std::uint32_t c) {
        const Vec3d probe = pointInside(c);
        if (!boundsTree_) boundsTree_.emplace(bounds_);
        return boundsTree_->visit([&](const Box3d& box) { return box.contains(probe); },
                                  [&](std::uint32_t other) {
                                      return other != c && std::abs(volume_[other]) > std::abs(volume_[c]) &&
                                             windingAlongZ(probe, other) != 0;
                                  });
    }

private:
    // A point between the faces of `c`. A point of a face is not enough: the faces of a court lie on those of its house.
    [[nodiscard]] Vec3d pointInside(std::uint32_t c) const {
        const auto cornerOf = [&](std::uint32_t t, std::size_t n) { return vertices_[triangles_[t].corners[n]]; };
        const auto normalOf = [&](std::uint32_t t) {
            return cross(cornerOf(t, 1) - cornerOf(t, 0), cornerOf(t, 2) - cornerOf(t, 0));
        };
        const std::uint32_t widest = *std::max_element(
            members_[c].begin(), members_[c].end(),
            [&](std::uint32_t a, std::uint32_t b) { return std::abs(normalOf(a).z) < std::abs(normalOf(b).z); });
        Vec3d point = (cornerOf(widest, 0) + cornerOf(widest, 1) + cornerOf(widest, 2)) / 3.0;
        const Vec3d below{point.x, point.y, bounds_[c].min.z - 1};
        std::vector<double> heights;
        for (const std::uint32_t t : members_[c]) {
            if (crossingAlongZ(below, vertices_, triangles_[t]) == 0) continue;
            const Vec3d normal = normalOf(t);
            heights.push_back(below.z + dot(normal, cornerOf(t, 0) - below) / normal.z);
        }
        std::sort(heights.begin(), heights.end());
        double widestGap = 0;
        for (std::size_t n = 0; n + 1 < heights.size(); n += 2) {
            if (heights[n + 1] - heights[n] <= widestGap) continue;
            widestGap = heights[n + 1] - heights[n];
            point.z = (heights[n] + heights[n + 1]) / 2;
        }
        return point;
    }
    [[nodiscard]] int windingAlongZ(Vec3d point, std::uint32_t c) {
        const std::vector<std::uint32_t>& members = members_[c];
        if (!trees_[c]) {
            std::vector<Box3d> boxes(members.size());
            for (std::size_t i = 0; i < members.size(); ++i)
                for (const std::uint32_t corner : triangles_[members[i]].corners) boxes[i].add(vertices_[corner]);
            trees_[c].emplace(std::move(boxes));
        }
        int winding = 0;
        trees_[c]->forEach(
            [&](const Box3d& box) {
                return point.x >= box.min.x && point.x <= box.max.x && point.y >= box.min.y && point.y <= box.max.y &&
                       point.z <= box.max.z;
            },
            [&](std::uint32_t i) { winding += crossingAlongZ(point, vertices_, triangles_[members[i]]); });
        return winding;
    }

    const std::vector<Vec3d>& vertices_;
    const std::vector<Triangle>& triangles_;
    std::vector<std::vector<std::uint32_t>> members_;
    std::vector<double> volume_;
    std::vector<Box3d> bounds_;
    std::optional<plane::BoxTree> boundsTree_;          // made on first use
    std::vector<std::optional<plane::BoxTree>> trees_;  // of the triangles of each component, the same
};

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

std::uint32_t removeDoubledFaces(const std::vector<Vec3d>& vertices, std::vector<Triangle>& triangles) {
    EdgeCounts uses(triangles);
    std::vector<std::uint8_t> isGone(triangles.size(), 0);
    std::uint32_t removed = 0;
    // Each pass may make the next triangle of a chain superfluous; long chains against the order are cut short.
    const std::size_t maxPasses = 8 + kMaxDoubledVisits / (triangles.size() + 1);
    bool hasChanged = true;
    for (std::size_t pass = 0; hasChanged && pass < maxPasses; ++pass) {
        hasChanged = false;
        for (std::uint32_t t = 0; t < triangles.size(); ++t) {
            if (isGone[t]) continue;
            int excess = 0;
            bool isDoubled = false;
            for (std::uint32_t c = 0; c < 3; ++c) {
                const int forward = uses.forward(t, c), backward = uses.backward(t, c);
                excess += forward > backward;
                isDoubled = isDoubled || (forward > backward && (backward > 0 || removed != 0));
            }
            if (excess < 2 || !isDoubled) continue;
            uses.remove(t);
            isGone[t] = 1;
            ++removed;
            hasChanged = true;
        }
    }
    if (removed == 0) return 0;
    std::vector<Triangle> kept;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (!isGone[t]) kept.push_back(triangles[t]);
    if (kept.empty() || findOpenEdges(kept).size() >= findOpenEdges(triangles).size()) return 0;
    const Cover cover(vertices, kept);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        if (isGone[t] && !cover.contains(triangles[t])) return 0;
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
    Components components(vertices, triangles);
    std::vector<std::uint32_t> inward;
    for (std::uint32_t c = 0; c < components.count(); ++c)
        // A void, inside a larger component, must face inwards.
        if (components.volume(c) < 0 && !components.isEnclosed(c)) inward.push_back(c);
    std::uint32_t flipped = 0;
    for (const std::uint32_t c : inward) {
        for (const std::uint32_t t : components.members(c)) flip(triangles[t]);
        flipped += static_cast<std::uint32_t>(components.members(c).size());
    }
    return flipped;
}

std::vector<std::vector<std::uint32_t>> findBoundaryLoops(const std::vector<OpenEdge>& edges) {
    // The missing face uses the open edges in reverse direction.
    std::multimap<std::uint32_t, std::uint32_t> next;
    for (const OpenEdge& edge : edges) next.emplace(edge.to, edge.from);
    std::vector<std::vector<std::uint32_t>> loops;
    std::unordered_map<std::uint32_t, std::size_t> placeInPath;
    while (!next.empty()) {
        std::vector<std::uint32_t> path{next.begin()->first};
        placeInPath.clear();
        placeInPath[path[0]] = 0;
        for (;;) {
            const auto step = next.find(path.back());
            if (step == next.end()) break;
            const std::uint32_t corner = step->second;
            next.erase(step);
            const auto [seen, isNew] = placeInPath.emplace(corner, path.size());
            if (isNew) {
                path.push_back(corner);
                continue;
            }
            // The path has closed a loop: emit it, and continue from the corner where it began.
            const auto begin = path.begin() + static_cast<std::ptrdiff_t>(seen->second);
            loops.emplace_back(begin, path.end());
            for (auto it = begin + 1; it != path.end(); ++it) placeInPath.erase(*it);
            path.erase(begin + 1, path.end());
        }
    }
    return loops;
}

}  // namespace svt::mesh
