#include <svt/mesh/polygons/edge_uses.hpp>

#include <algorithm>
#include <tuple>

namespace svt::mesh {
namespace {

// More vertices per use, and passes over vertices without a use would take longer than sorting.
constexpr std::size_t kMostVerticesPerUse = 4;

template <class F>
void forEachUse(const std::vector<Triangle>& triangles, F&& body) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t a = triangles[t].corners[c], b = triangles[t].corners[(c + 1) % 3];
            body(EdgeUse{std::min(a, b), std::max(a, b), t, a < b});
        }
    }
}

bool isBefore(const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
}

}  // namespace

std::vector<EdgeUse> collectEdgeUses(const std::vector<Triangle>& triangles) {
    std::vector<EdgeUse> uses;
    std::size_t vertexCount = 0;
    forEachUse(triangles, [&](const EdgeUse& use) { vertexCount = std::max<std::size_t>(vertexCount, use.high + 1); });
    if (vertexCount > triangles.size() * 3 * kMostVerticesPerUse) {
        uses.reserve(triangles.size() * 3);
        forEachUse(triangles, [&](const EdgeUse& use) { uses.push_back(use); });
        std::sort(uses.begin(), uses.end(), isBefore);
        return uses;
    }
    // A counting sort by `low`; the few uses of each vertex are then sorted.
    std::vector<std::uint32_t> next(vertexCount + 1, 0);
    forEachUse(triangles, [&](const EdgeUse& use) { ++next[use.low + 1]; });
    for (std::size_t v = 1; v < next.size(); ++v) next[v] += next[v - 1];
    uses.resize(triangles.size() * 3);
    forEachUse(triangles, [&](const EdgeUse& use) { uses[next[use.low]++] = use; });
    for (std::size_t v = 0, begin = 0; v < vertexCount; begin = next[v++])
        std::sort(uses.begin() + std::ptrdiff_t(begin), uses.begin() + std::ptrdiff_t(next[v]), isBefore);
    return uses;
}

}  // namespace svt::mesh
