#include <svt/validate/solids/shell_topology.hpp>

#include <svt/validate/polygons/groups.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace svt::validate {
namespace {

// A use of an edge by a face, or by a triangle.
struct EdgeUse {
    std::uint32_t low, high;  // points
    bool isUp;                // from low to high
    std::uint32_t owner;
    std::uint32_t from, to;  // of triangles: the corners (three each) at the ends of the edge, in its direction
};

std::vector<EdgeUse> sorted(std::vector<EdgeUse> uses) {
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return std::tie(a.low, a.high, a.owner, a.from) < std::tie(b.low, b.high, b.owner, b.from);
    });
    return uses;
}

std::vector<EdgeUse> edgesOfFaces(const Shell& shell) {
    std::vector<EdgeUse> uses;
    for (std::uint32_t f = 0; f < shell.faces.size(); ++f)
        for (const auto& ring : shell.faces[f].rings)
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const std::uint32_t a = ring[i], b = ring[i + 1 == ring.size() ? 0 : i + 1];
                if (a != b) uses.push_back({std::min(a, b), std::max(a, b), a < b, f, 0, 0});
            }
    return sorted(std::move(uses));
}

std::vector<EdgeUse> edgesOfTriangles(const Shell& shell) {
    std::vector<EdgeUse> uses;
    uses.reserve(3 * shell.triangles.size());
    for (std::uint32_t t = 0; t < shell.triangles.size(); ++t)
        for (std::uint32_t i = 0; i < 3; ++i) {
            const std::uint32_t j = (i + 1) % 3, a = shell.triangles[t][i], b = shell.triangles[t][j];
            uses.push_back({std::min(a, b), std::max(a, b), a < b, t, 3 * t + i, 3 * t + j});
        }
    return sorted(std::move(uses));
}

// Calls visit(uses) for each edge.
template <class Visit>
void forEachEdge(const std::vector<EdgeUse>& uses, const Visit& visit) {
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
        while (end < uses.size() && uses[end].low == uses[begin].low && uses[end].high == uses[begin].high) ++end;
        visit(std::span(uses).subspan(begin, end - begin));
    }
}

Defect defectAt(Code code, Vec3d at, std::string message) {
    Defect defect;
    defect.code = code;
    defect.at = at;
    defect.message = std::move(message);
    return defect;
}

Defect defectOfEdge(Code code, const EdgeUse& use, const PointSet& points, std::string message) {
    const Vec3d a = points.world(use.low), b = points.world(use.high);
    Defect defect = defectAt(code, (a + b) * 0.5, std::move(message));
    defect.marks.push_back({a, b});
    return defect;
}

void markFace(Defect& defect, const Face& face, const PointSet& points) {
    defect.polygon = face.polygon;
    for (const auto& ring : face.rings)
        for (std::size_t i = 0; i < ring.size(); ++i)
            defect.marks.push_back({points.world(ring[i]), points.world(ring[i + 1 == ring.size() ? 0 : i + 1])});
}

bool hasRoom(const std::vector<Defect>& defects) { return defects.size() < kLargestDefectCount; }

// Faces that must be turned so that each edge is used once in either direction. False if this is impossible.
struct Turning {
    std::vector<std::uint8_t> isTurned;
    std::vector<std::uint32_t> component;
    bool isPossible = true;
};

Turning findTurning(const Shell& shell, const std::vector<EdgeUse>& uses) {
    struct Neighbour {
        std::uint32_t face;
        bool isOpposed;  // in direction
    };
    std::vector<std::vector<Neighbour>> neighbours(shell.faces.size());
    forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
        if (edge.size() != 2 || edge[0].owner == edge[1].owner) return;
        const bool isOpposed = edge[0].isUp == edge[1].isUp;
        neighbours[edge[0].owner].push_back({edge[1].owner, isOpposed});
        neighbours[edge[1].owner].push_back({edge[0].owner, isOpposed});
    });
    constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    Turning turning{std::vector<std::uint8_t>(shell.faces.size()),
                    std::vector<std::uint32_t>(shell.faces.size(), kNone)};
    std::uint32_t components = 0;
    for (std::uint32_t start = 0; start < shell.faces.size(); ++start) {
        if (turning.component[start] != kNone) continue;
        std::vector<std::uint32_t> open{start}, members{start};
        turning.component[start] = components;
        while (!open.empty()) {
            const std::uint32_t face = open.back();
            open.pop_back();
            for (const Neighbour& next : neighbours[face]) {
                const std::uint8_t wanted = turning.isTurned[face] ^ static_cast<std::uint8_t>(next.isOpposed);
                if (turning.component[next.face] == kNone) {
                    turning.component[next.face] = components;
                    turning.isTurned[next.face] = wanted;
                    open.push_back(next.face);
                    members.push_back(next.face);
                } else if (turning.isTurned[next.face] != wanted) {
                    turning.isPossible = false;
                }
            }
        }
        // The smaller group of faces counts as wrong.
        std::size_t turned = 0;
        for (const std::uint32_t face : members) turned += turning.isTurned[face];
        if (2 * turned > members.size())
            for (const std::uint32_t face : members) turning.isTurned[face] ^= 1;
        ++components;
    }
    return turning;
}

// The triangles around a point, joined across the edges that two of them share, are its umbrellas. A point may have one
// umbrella. Several umbrellas that are all open are gaps of a closed shell, and reported as gaps.
void checkUmbrellas(const Shell& shell, const PointSet& points, const ShellRules& rules, std::vector<Defect>& defects) {
    const std::vector<EdgeUse> uses = edgesOfTriangles(shell);
    Groups groups(3 * shell.triangles.size());
    std::vector<std::uint8_t> hasBorder(3 * shell.triangles.size());
    forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
        const auto low = [](const EdgeUse& use) { return use.isUp ? use.from : use.to; };
        const auto high = [](const EdgeUse& use) { return use.isUp ? use.to : use.from; };
        for (std::size_t i = 1; i < edge.size(); ++i) {
            groups.join(low(edge[0]), low(edge[i]));
            groups.join(high(edge[0]), high(edge[i]));
        }
        if (edge.size() == 1) hasBorder[edge[0].from] = hasBorder[edge[0].to] = 1;
    });
    struct Umbrella {
        std::uint32_t point;
        std::size_t leader;
        bool isOpen;
    };
    std::vector<Umbrella> umbrellas;
    std::vector<std::uint8_t> isOpen(3 * shell.triangles.size());
    for (std::size_t c = 0; c < hasBorder.size(); ++c)
        if (hasBorder[c] != 0) isOpen[groups.leaderOf(c)] = 1;
    for (std::size_t c = 0; c < hasBorder.size(); ++c)
        if (groups.leaderOf(c) == c) umbrellas.push_back({shell.triangles[c / 3][c % 3], c, isOpen[c] != 0});
    std::sort(umbrellas.begin(), umbrellas.end(), [](const Umbrella& a, const Umbrella& b) {
        return std::tie(a.point, a.leader) < std::tie(b.point, b.leader);
    });
    for (std::size_t begin = 0, end = 0; begin < umbrellas.size(); begin = end) {
        bool hasClosed = false;
        for (end = begin; end < umbrellas.size() && umbrellas[end].point == umbrellas[begin].point; ++end)
            hasClosed = hasClosed || !umbrellas[end].isOpen;
        if (end - begin < 2 || (rules.isClosed && !hasClosed) || !hasRoom(defects)) continue;
        defects.push_back(
            defectAt(Code::NonManifold, points.world(umbrellas[begin].point),
                     fmt::format("{} parts of the shell meet in a point without sharing an edge there", end - begin)));
    }
}

// Edges with one face, cut where others end on them, form pairs if they match up to T-junctions.
bool matchWhenCut(const std::vector<EdgeUse>& open, const PointSet& points) {
    constexpr std::size_t kMost = 1000;  // the search is of all pairs
    if (open.size() > kMost) return false;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (const EdgeUse& use : open) {
        const std::uint32_t from = use.isUp ? use.low : use.high, to = use.isUp ? use.high : use.low;
        const Vec3d a = points.units(from), along = points.units(to) - a;
        const double size = length(along);
        std::vector<std::pair<double, std::uint32_t>> stops{{0, from}, {size, to}};
        for (const EdgeUse& other : open)
            for (const std::uint32_t p : {other.low, other.high}) {
                const Vec3d d = points.units(p) - a;
                const double at = dot(d, along) / size;
                if (p == from || p == to || at <= 0 || at >= size) continue;
                if (length(d - along * (at / size)) <= std::max(points.snap, 2.0)) stops.emplace_back(at, p);
            }
        std::sort(stops.begin(), stops.end());
        for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
            const std::uint32_t p = stops[i].second, q = stops[i + 1].second;
            if (p != q) balance[{std::min(p, q), std::max(p, q)}] += p < q ? 1 : -1;
        }
    }
    return std::all_of(balance.begin(), balance.end(), [](const auto& entry) { return entry.second == 0; });
}

}  // namespace

void checkManifold(const Shell& shell, const PointSet& points, const ShellRules& rules, std::vector<Defect>& defects) {
    const std::vector<EdgeUse> uses = edgesOfFaces(shell);
    bool isOpposed = false;
    forEachEdge(uses, [&](std::span<const EdgeUse> edge) {
        isOpposed = isOpposed || (edge.size() == 2 && edge[0].isUp == edge[1].isUp);
        if (edge.size() < 3 || !hasRoom(defects)) return;
        defects.push_back(defectOfEdge(Code::NonManifold, edge[0], points,
                                       fmt::format("an edge is shared by {} faces, more than two", edge.size())));
    });
    if (isOpposed && hasRoom(defects)) {
        const Turning turning = findTurning(shell, uses);
        if (!turning.isPossible)
            defects.push_back(defectAt(Code::NonManifold, points.world(shell.faces.front().rings.front().front()),
                                       "the faces cannot be oriented consistently"));
        for (std::uint32_t f = 0; turning.isPossible && f < shell.faces.size(); ++f) {
            if (turning.isTurned[f] == 0 || !hasRoom(defects)) continue;
            const Face& face = shell.faces[f];
            defects.push_back(defectAt(Code::FaceTurnedOver, points.world(face.rings.front().front()),
                                       "a face has the opposite orientation to its neighbours"));
            markFace(defects.back(), face, points);
        }
    }
    if (defects.empty()) checkUmbrellas(shell, points, rules, defects);
}

void checkOnePiece(const Shell& shell, const PointSet& points, std::vector<Defect>& defects) {
    Groups groups(shell.faces.size());
    forEachEdge(edgesOfFaces(shell), [&](std::span<const EdgeUse> edge) {
        for (std::size_t i = 1; i < edge.size(); ++i) groups.join(edge[0].owner, edge[i].owner);
    });
    std::map<std::size_t, std::size_t> sizes;
    for (std::size_t f = 0; f < shell.faces.size(); ++f) ++sizes[groups.leaderOf(f)];
    if (sizes.size() < 2) return;
    auto largest = sizes.begin();
    for (auto at = sizes.begin(); at != sizes.end(); ++at)
        if (at->second > largest->second) largest = at;
    for (const auto& [leader, size] : sizes) {
        if (leader == largest->first || !hasRoom(defects)) continue;
        const Face& face = shell.faces[leader];
        Defect defect =
            defectAt(Code::ShellDisconnected, points.world(face.rings.front().front()),
                     fmt::format("the shell has {} pieces; one piece of {} faces is not connected to the rest",
                                 sizes.size(), size));
        markFace(defect, face, points);
        defects.push_back(std::move(defect));
    }
}

void checkClosed(const Shell& shell, const PointSet& points, std::vector<Defect>& defects) {
    std::vector<EdgeUse> open;
    forEachEdge(edgesOfFaces(shell), [&](std::span<const EdgeUse> edge) {
        if (edge.size() == 1) open.push_back(edge[0]);
    });
    if (open.empty()) return;
    // One defect per connected border.
    const bool isTight = matchWhenCut(open, points);
    std::map<std::uint32_t, std::size_t> number;
    for (const EdgeUse& use : open)
        for (const std::uint32_t p : {use.low, use.high}) number.emplace(p, number.size());
    Groups groups(number.size());
    for (const EdgeUse& use : open) groups.join(number[use.low], number[use.high]);
    std::map<std::size_t, std::vector<const EdgeUse*>> borders;
    for (const EdgeUse& use : open) borders[groups.leaderOf(number[use.low])].push_back(&use);
    for (const auto& [leader, border] : borders) {
        if (!hasRoom(defects)) return;
        Defect defect = defectOfEdge(
            isTight ? Code::TJunction : Code::ShellNotClosed, *border.front(), points,
            isTight
                ? fmt::format("{} edges match edges of neighbouring faces only in part (T-junctions)", border.size())
                : fmt::format("the shell is open along {} edges", border.size()));
        defect.marks.clear();
        for (const EdgeUse* use : border) defect.marks.push_back({points.world(use->low), points.world(use->high)});
        defect.polygon = shell.faces[border.front()->owner].polygon;
        defects.push_back(std::move(defect));
    }
}

}  // namespace svt::validate
