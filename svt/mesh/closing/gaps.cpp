#include <svt/mesh/closing/gaps.hpp>

#include <svt/mesh/polygons/edges.hpp>
#include <svt/mesh/polygons/triangulate.hpp>
#include <svt/plane/welder.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>

namespace svt::mesh {
namespace {

// An end of open edges, and the largest distance to the place that it is joined with.
struct LooseEnd {
    std::uint32_t vertex;
    double reach;
};

std::vector<LooseEnd> findLooseEnds(const ObjectMesh& mesh, double distance) {
    constexpr double kPartOfEdge = 0.3, kNoEdge = 1e-4;  // shorter edges are noise: their ends are joined
    std::map<std::uint32_t, double> reach;
    for (const OpenEdge& edge : mesh.openEdges) {
        const double edgeLength = length(mesh.vertices[edge.to] - mesh.vertices[edge.from]);
        const double limit = edgeLength > kNoEdge ? std::min(distance, kPartOfEdge * edgeLength) : distance;
        for (const std::uint32_t vertex : {edge.from, edge.to}) {
            double& least = reach.try_emplace(vertex, limit).first->second;
            least = std::min(least, limit);
        }
    }
    std::vector<LooseEnd> ends;
    for (const auto& [vertex, limit] : reach) ends.push_back({vertex, limit});
    std::sort(ends.begin(), ends.end(), [&](const LooseEnd& p, const LooseEnd& q) {
        return std::tuple(mesh.vertices[p.vertex].x, p.vertex) < std::tuple(mesh.vertices[q.vertex].x, q.vertex);
    });
    return ends;
}

// Loose ends by cells of a grid as wide as their longest reach, so that those around a point are found at once.
class EndGrid {
public:
    EndGrid(const ObjectMesh& mesh, const std::vector<LooseEnd>& ends) : mesh_(mesh), ends_(ends) {
        double reach = 0;
        for (const LooseEnd& end : ends) reach = std::max(reach, end.reach);
        perMetre_ = reach > 0 ? 1 / reach : 1;
        for (std::uint32_t e = 0; e < ends.size(); ++e) cells_.add(cellOf(at(e)));
    }

    // Ends behind `e` in the cells around it, in ascending order.
    void findAround(std::uint32_t e, std::vector<std::uint32_t>& found) const {
        found.clear();
        const plane::Cell cell = cellOf(at(e)), next{1, 1, 1};
        cells_.forEach(cell - next, cell + next, [&](std::uint32_t other) {
            if (other > e) found.push_back(other);
        });
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
    }

private:
    [[nodiscard]] Vec3d at(std::uint32_t e) const { return mesh_.vertices[ends_[e].vertex]; }
    [[nodiscard]] plane::Cell cellOf(Vec3d p) const {
        const auto step = [&](double v) {
            return static_cast<std::int64_t>(std::floor(std::clamp(v * perMetre_, -1e15, 1e15)));
        };
        return {step(p.x), step(p.y), step(p.z)};
    }

    const ObjectMesh& mesh_;
    const std::vector<LooseEnd>& ends_;
    double perMetre_ = 1;
    plane::CellIndex cells_;
};

double openLength(const std::vector<Vec3d>& vertices, const std::vector<OpenEdge>& edges) {
    double sum = 0;
    for (const OpenEdge& edge : edges) sum += length(vertices[edge.to] - vertices[edge.from]);
    return sum;
}

double diagonalOf(const ObjectMesh& mesh) {
    Box3d box;
    for (const Triangle& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle.corners) box.add(mesh.vertices[corner]);
    return length(box.size());
}

// A loop of open edges, in the direction of the missing face.
struct BridgeLoop {
    std::vector<std::uint32_t> corners;
    std::uint32_t component = 0;
    Vec3d areaVector{};
    Box3d box;
    bool isUsed = false;
};

std::vector<BridgeLoop> findBridgeLoops(const ObjectMesh& mesh) {
    const std::vector<std::uint32_t> component = findComponents(mesh.triangles);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> byEdge;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t c = 0; c < 3; ++c)
            byEdge[{mesh.triangles[t].corners[c], mesh.triangles[t].corners[(c + 1) % 3]}] = component[t];
    std::vector<BridgeLoop> loops;
    for (auto& corners : findBoundaryLoops(mesh.openEdges)) {
        if (corners.size() < 3) continue;
        BridgeLoop loop;
        const auto owner = byEdge.find({corners[1], corners[0]});
        if (owner == byEdge.end()) continue;
        loop.component = owner->second;
        std::vector<Vec3d> ring;
        for (const std::uint32_t corner : corners) {
            ring.push_back(mesh.vertices[corner]);
            loop.box.add(ring.back());
        }
        loop.areaVector = newellNormal(ring) * 0.5;
        loop.corners = std::move(corners);
        loops.push_back(std::move(loop));
    }
    return loops;
}

// Largest distance of a corner of `loop` from the line of `other`, both times `scale`.
double farthest(const ObjectMesh& mesh, const BridgeLoop& loop, const BridgeLoop& other, Vec3d scale) {
    double worst = 0;
    for (const std::uint32_t corner : loop.corners) {
        const Vec3d p = scaled(mesh.vertices[corner], scale);
        double nearest = kInfinity;
        for (std::size_t i = 0; i < other.corners.size(); ++i) {
            const Vec3d a = scaled(mesh.vertices[other.corners[i]], scale);
            const Vec3d ab = scaled(mesh.vertices[other.corners[(i + 1) % other.corners.size()]], scale) - a;
            const double squared = dot(ab, ab);
            const double t = squared > 0 ? std::clamp(dot(p - a, ab) / squared, 0.0, 1.0) : 0.0;
            nearest = std::min(nearest, length(p - (a + ab * t)));
        }
        worst = std::max(worst, nearest);
    }
    return worst;
}

bool isBridgeable(const ObjectMesh& mesh, const BridgeLoop& a, const BridgeLoop& b) {
    constexpr double kFarthest = 0.5, kPartOfSize = 0.2, kLevel = 0.7;
    if (a.component == b.component || !(dot(a.areaVector, b.areaVector) < 0)) return false;
    const double size = std::sqrt(std::min(length(a.areaVector), length(b.areaVector)));
    const double limit = std::min(kFarthest, kPartOfSize * size);
    const auto isNear = [&](Vec3d scale) {
        return farthest(mesh, a, b, scale) <= limit && farthest(mesh, b, a, scale) <= limit;
    };
    if (isNear({1, 1, 1})) return true;
    const auto isLevel = [](const BridgeLoop& loop) {
        return std::abs(loop.areaVector.z) > kLevel * length(loop.areaVector);
    };
    return isLevel(a) && isLevel(b) && isNear({1, 1, 0});
}

// The strip between two loops; `a` forwards, `b` backwards, from the pair of corners that is closest.
void addStrip(ObjectMesh& mesh, const BridgeLoop& a, const BridgeLoop& b) {
    const std::size_t n = a.corners.size(), m = b.corners.size();
    if (n == 0 || m == 0) return;
    const auto at = [&](const BridgeLoop& loop, std::size_t i) {
        return mesh.vertices[loop.corners[i % loop.corners.size()]];
    };
    std::size_t i0 = 0, j0 = 0;
    double closest = kInfinity;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < m; ++j)
            if (const double d = length(at(a, i) - at(b, j)); d < closest)
                std::tie(closest, i0, j0) = std::tuple(d, i, j);
    std::size_t i = 0, j = 0;  // steps taken along a, and back along b
    while (i < n || j < m) {
        const std::size_t ai = i0 + i, bj = j0 + m * 2 - j;
        const double alongA = i < n ? length(at(a, ai + 1) - at(b, bj)) : kInfinity;
        const double alongB = j < m ? length(at(b, bj - 1) - at(a, ai)) : kInfinity;
        Triangle triangle;
        if (alongA <= alongB) {
            triangle.corners = {a.corners[ai % n], a.corners[(ai + 1) % n], b.corners[bj % m]};
            ++i;
        } else {
            triangle.corners = {b.corners[(bj - 1) % m], b.corners[bj % m], a.corners[ai % n]};
            ++j;
        }
        const auto& c = triangle.corners;
        if (c[0] != c[1] && c[1] != c[2] && c[0] != c[2]) mesh.triangles.push_back(triangle);
    }
}

}  // namespace

void weldLooseEnds(ObjectMesh& mesh, double distance) {
    const std::vector<LooseEnd> ends = findLooseEnds(mesh, distance);
    std::vector<std::uint32_t> target(mesh.vertices.size());
    std::iota(target.begin(), target.end(), 0u);
    std::vector<std::uint8_t> isTaken(ends.size(), 0);
    const EndGrid grid(mesh, ends);
    std::vector<std::uint32_t> around;
    for (std::uint32_t e = 0; e < ends.size(); ++e) {
        if (isTaken[e] != 0) continue;
        const Vec3d at = mesh.vertices[ends[e].vertex];
        Vec3d sum = at;
        double count = 1;
        grid.findAround(e, around);
        for (const std::uint32_t o : around) {
            const Vec3d other = mesh.vertices[ends[o].vertex];
            if (isTaken[o] != 0 || length(other - at) > std::min(ends[e].reach, ends[o].reach)) continue;
            isTaken[o] = 1;
            target[ends[o].vertex] = ends[e].vertex;
            sum = sum + other;
            count += 1;
        }
        if (count > 1) mesh.vertices[ends[e].vertex] = sum / count;
    }
    for (Triangle& triangle : mesh.triangles)
        for (std::uint32_t& corner : triangle.corners) corner = target[corner];
    std::erase_if(mesh.triangles, [](const Triangle& t) {
        return t.corners[0] == t.corners[1] || t.corners[1] == t.corners[2] || t.corners[0] == t.corners[2];
    });
}

std::uint32_t joinGaps(ObjectMesh& mesh) {
    const double diagonal = diagonalOf(mesh), asRead = openLength(mesh.vertices, mesh.openEdges);
    const auto edgesAsRead = static_cast<std::uint32_t>(mesh.openEdges.size());
    double least = asRead / 2;
    // An end in a gap lies on one or two edges. Far more cuts indicate a heap of faces, which cannot be joined.
    const std::size_t mostCuts = 4096 + 2 * mesh.openEdges.size();
    ObjectMesh best;
    bool isFound = false;
    for (const double distance : {1e-3, 1e-2, 5e-2, 0.25}) {
        const double limited = std::min(distance, 0.02 * diagonal);
        ObjectMesh joined;
        joined.vertices = mesh.vertices;
        joined.triangles = mesh.triangles;
        joined.openEdges = mesh.openEdges;
        weldLooseEnds(joined, limited);
        bool isUnfinished = false;
        (void)cutAtTJunctions(joined.vertices, joined.triangles, std::min(limited, 5e-2), &isUnfinished, mostCuts);
        joined.openEdges = findOpenEdges(joined.triangles);
        if (!joined.openEdges.empty() && orientConsistently(joined.triangles) != 0)
            joined.openEdges = findOpenEdges(joined.triangles);
        const double open = openLength(joined.vertices, joined.openEdges);
        const bool isBetter = open < least || joined.openEdges.empty();
        if (isBetter) {
            least = open / 2;  // a longer reach must improve the result clearly
            best = std::move(joined);
            isFound = true;
        }
        if ((isFound && best.openEdges.empty()) || (isUnfinished && !isBetter)) break;
        if (limited < distance) break;
    }
    if (!isFound) return 0;
    mesh.vertices = std::move(best.vertices);
    mesh.triangles = std::move(best.triangles);
    mesh.openEdges = std::move(best.openEdges);
    return edgesAsRead - std::min(edgesAsRead, static_cast<std::uint32_t>(mesh.openEdges.size()));
}

std::uint32_t bridgeLoops(ObjectMesh& mesh) {
    constexpr std::size_t kMaxLoops = 64;
    std::vector<BridgeLoop> loops = findBridgeLoops(mesh);
    if (loops.size() > kMaxLoops) return 0;
    std::uint32_t bridged = 0;
    for (std::size_t a = 0; a < loops.size(); ++a)
        for (std::size_t b = a + 1; b < loops.size() && !loops[a].isUsed; ++b) {
            if (loops[b].isUsed || !isBridgeable(mesh, loops[a], loops[b])) continue;
            addStrip(mesh, loops[a], loops[b]);
            loops[a].isUsed = loops[b].isUsed = true;
            ++bridged;
        }
    if (bridged != 0) mesh.openEdges = findOpenEdges(mesh.triangles);
    return bridged;
}

}  // namespace svt::mesh
