#include <svt/voxelize/surfaces/rim.hpp>

#include <algorithm>
#include <utility>

namespace svt::voxelize {
namespace {

// The rim as directed edges, each against its triangle, sorted.
std::vector<std::pair<std::uint32_t, std::uint32_t>> rimEdges(const mesh::ObjectMesh& shell) {
    struct Use {
        std::uint32_t low, high;
        int direction;
    };
    std::vector<Use> uses;
    uses.reserve(3 * shell.triangles.size());
    for (const mesh::Triangle& triangle : shell.triangles)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t from = triangle.corners[c], to = triangle.corners[c == 2 ? 0 : c + 1];
            if (from != to) uses.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
        }
    std::sort(uses.begin(), uses.end(),
              [](const Use& p, const Use& q) { return p.low != q.low ? p.low < q.low : p.high < q.high; });
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t u = 0; u < uses.size();) {
        const Use& first = uses[u];
        int count = 0;
        for (; u < uses.size() && uses[u].low == first.low && uses[u].high == first.high; ++u)
            count += uses[u].direction;
        for (; count > 0; --count) edges.emplace_back(first.high, first.low);
        for (; count < 0; ++count) edges.emplace_back(first.low, first.high);
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

// Chains the sorted edges into loops; calls `body(points)` for each.
template <class Body>
void forEachLoop(std::span<const std::pair<std::uint32_t, std::uint32_t>> edges, std::size_t vertexCount, Body&& body) {
    constexpr std::uint32_t kOff = 0xFFFFFFFFu;
    std::vector<std::uint32_t> next(vertexCount + 1, 0);  // per vertex: its first edge not walked yet
    for (const auto& edge : edges) ++next[edge.first + 1];
    for (std::size_t v = 0; v < vertexCount; ++v) next[v + 1] += next[v];
    const std::vector<std::uint32_t> first = next;
    std::vector<std::uint32_t> placeOnPath(vertexCount, kOff), path;
    for (const auto& edge : edges) {
        const std::uint32_t start = edge.first;
        if (next[start] == first[start + 1]) continue;
        path.assign(1, start);
        placeOnPath[start] = 0;
        while (next[path.back()] < first[path.back() + 1]) {
            const std::uint32_t to = edges[next[path.back()]++].second;
            if (placeOnPath[to] == kOff) {
                placeOnPath[to] = static_cast<std::uint32_t>(path.size());
                path.push_back(to);
                continue;
            }
            const std::uint32_t place = placeOnPath[to];
            body(std::span(path).subspan(place));
            for (std::size_t p = place + 1; p < path.size(); ++p) placeOnPath[path[p]] = kOff;
            path.resize(place + 1);
        }
        // Every vertex has as many edges in as out, so the walk ends where it began.
        placeOnPath[start] = kOff;
    }
}

// Mean of the edges' middles, weighted by their lengths.
Vec3d middleOf(std::span<const std::uint32_t> ring, const std::vector<Vec3d>& vertices) {
    Vec3d sum{};
    double total = 0;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const Vec3d from = vertices[ring[n]], to = vertices[ring[n + 1 < ring.size() ? n + 1 : 0]];
        const double weight = length(to - from);
        sum = sum + (from + to) * (weight / 2);
        total += weight;
    }
    return total > 0 ? sum / total : vertices[ring[0]];
}

}  // namespace

CoveredShell coverShell(const mesh::ObjectMesh& shell) {
    CoveredShell covered;
    covered.mesh.vertices = shell.vertices;
    covered.mesh.triangles = shell.triangles;
    covered.mesh.closingMethod = shell.closingMethod;
    covered.shellTriangles = shell.triangles.size();
    forEachLoop(rimEdges(shell), shell.vertices.size(), [&](std::span<const std::uint32_t> points) {
        RimLoop loop;
        loop.firstPoint = static_cast<std::uint32_t>(covered.ring.size());
        loop.pointCount = static_cast<std::uint32_t>(points.size());
        loop.hasOwnApex = points.size() > 4;
        loop.apex = points[0];
        covered.ring.insert(covered.ring.end(), points.begin(), points.end());
        if (loop.hasOwnApex) {
            loop.apex = static_cast<std::uint32_t>(covered.mesh.vertices.size());
            covered.mesh.vertices.push_back(middleOf(points, shell.vertices));
        }
        for (std::uint32_t n = loop.firstFan(); n < loop.fanEnd(); ++n) {
            mesh::Triangle triangle;
            triangle.corners = {loop.apex, points[n], points[n + 1 < points.size() ? n + 1 : 0]};
            covered.mesh.triangles.push_back(triangle);
        }
        covered.loops.push_back(loop);
    });
    return covered;
}

}  // namespace svt::voxelize
