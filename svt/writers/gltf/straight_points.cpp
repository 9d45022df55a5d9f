#include <svt/writers/gltf/straight_points.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

namespace svt::writers {
namespace {

using Corners = std::array<std::uint32_t, 3>;
constexpr std::uint32_t kNoVertex = 0xFFFFFFFFu;
constexpr double kLeastAcross = 1e-6;  // twice the area of a triangle that is left out, m2

/// The triangles of a surface, by vertex. Those that are gone have kNoVertex as corners.
struct SheetTriangles {
    SheetTriangles(LabelSurface& ofLabel, const Positions& places)
        : surface(ofLabel), positions(places), at(places.size()) {
        for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
            Corners& corners = surface.triangles[t];
            if (length(acrossOf(corners)) < kLeastAcross)
                corners.fill(kNoVertex);
            else
                for (const std::uint32_t corner : corners) at[corner].push_back(t);
        }
    }

    [[nodiscard]] Vec3d place(std::uint32_t vertex) const { return toDouble(positions[vertex]); }
    [[nodiscard]] Vec3d acrossOf(const Corners& c) const {
        return cross(place(c[1]) - place(c[0]), place(c[2]) - place(c[0]));
    }

    /// The vertex that takes the place of `vertex`; empty: the vertex must stay.
    [[nodiscard]] std::optional<std::uint32_t> targetOf(std::uint32_t vertex) const {
        std::uint32_t before = kNoVertex, behind = kNoVertex;
        int borders = 0;
        for (const std::uint32_t t : at[vertex]) {
            const auto [next, previous] = neighboursIn(t, vertex);
            if (!hasNeighbour(vertex, next, false)) behind = next, ++borders;
            if (!hasNeighbour(vertex, previous, true)) before = previous, ++borders;
        }
        if (borders != 2 || before == kNoVertex || behind == kNoVertex || before == behind) return std::nullopt;
        const Vec3d a = place(before), c = place(behind), v = place(vertex);
        const double chord = length(c - a);
        if (!(dot(v - a, c - v) > 0) || length(cross(c - a, v - a)) > kStraight * chord) return std::nullopt;
        if (canMove(vertex, before)) return before;
        if (canMove(vertex, behind)) return behind;
        return std::nullopt;
    }

    void move(std::uint32_t vertex, std::uint32_t target) {
        for (const std::uint32_t t : at[vertex]) {
            Corners& corners = surface.triangles[t];
            if (std::find(corners.begin(), corners.end(), target) != corners.end()) {
                for (const std::uint32_t corner : corners)
                    if (corner != vertex) std::erase(at[corner], t);
                corners.fill(kNoVertex);
                continue;
            }
            std::replace(corners.begin(), corners.end(), vertex, target);
            at[target].push_back(t);
        }
        at[vertex].clear();
    }

    LabelSurface& surface;
    const Positions& positions;
    std::vector<std::vector<std::uint32_t>> at;

private:
    // The corners behind and before a vertex in a triangle.
    [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> neighboursIn(std::uint32_t t, std::uint32_t vertex) const {
        const Corners& c = surface.triangles[t];
        const std::size_t n = c[0] == vertex ? 0 : c[1] == vertex ? 1 : 2;
        return {c[(n + 1) % 3], c[(n + 2) % 3]};
    }
    // Whether a triangle at the vertex has `other` behind it, or before it.
    [[nodiscard]] bool hasNeighbour(std::uint32_t vertex, std::uint32_t other, bool isBehind) const {
        return std::any_of(at[vertex].begin(), at[vertex].end(), [&](std::uint32_t t) {
            const auto [next, previous] = neighboursIn(t, vertex);
            return (isBehind ? next : previous) == other;
        });
    }
    // True if one triangle vanishes, and the others stay in their plane with their orientation.
    [[nodiscard]] bool canMove(std::uint32_t vertex, std::uint32_t target) const {
        constexpr double kSameNormal = 0.999;
        int vanished = 0;
        double change = 0;  // of twice the area
        for (const std::uint32_t t : at[vertex]) {
            Corners corners = surface.triangles[t];
            const Vec3d old = acrossOf(corners);
            change -= length(old);
            if (std::find(corners.begin(), corners.end(), target) != corners.end()) {
                ++vanished;
                continue;
            }
            std::replace(corners.begin(), corners.end(), vertex, target);
            const Vec3d moved = acrossOf(corners);
            change += length(moved);
            if (length(moved) < kLeastAcross || dot(old, moved) < kSameNormal * length(old) * length(moved))
                return false;
        }
        return vanished == 1 && std::abs(change) <= 2 * kStraight * length(place(target) - place(vertex));
    }
};

struct PointUse {
    Vec3f place{};
    std::uint32_t surface = 0, vertex = 0;
};

bool isSamePlace(const PointUse& a, const PointUse& b) {
    return std::tie(a.place.x, a.place.y, a.place.z) == std::tie(b.place.x, b.place.y, b.place.z);
}

}  // namespace

void dropStraightPoints(SheetSurfaces& sheets) {
    constexpr std::size_t kMostTriangles = 64;  // at a point, so that the cost is bounded
    std::vector<SheetTriangles> surfaces;
    std::vector<PointUse> uses;
    surfaces.reserve(sheets.surfaces.size());
    for (std::uint32_t s = 0; s < sheets.surfaces.size(); ++s) {
        surfaces.emplace_back(sheets.surfaces[s], sheets.positions[s]);
        for (std::uint32_t v = 0; v < sheets.positions[s].size(); ++v)
            if (!surfaces[s].at[v].empty()) uses.push_back({sheets.positions[s][v], s, v});
    }
    std::sort(uses.begin(), uses.end(), [](const PointUse& a, const PointUse& b) {
        return std::tie(a.place.x, a.place.y, a.place.z, a.surface, a.vertex) <
               std::tie(b.place.x, b.place.y, b.place.z, b.surface, b.vertex);
    });
    std::vector<std::uint32_t> targets;
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
        targets.clear();
        bool canGo = true;
        for (end = begin; end < uses.size() && isSamePlace(uses[begin], uses[end]); ++end) {
            const auto& [place, s, vertex] = uses[end];
            if (end > begin && uses[end - 1].surface == s) canGo = false;  // two corners in one place
            const std::size_t triangles = surfaces[s].at[vertex].size();
            std::optional<std::uint32_t> target;
            if (canGo && triangles > 0) {
                if (triangles <= kMostTriangles) target = surfaces[s].targetOf(vertex);
                canGo = target.has_value();
            }
            targets.push_back(target.value_or(kNoVertex));
        }
        if (!canGo) continue;
        for (std::size_t n = begin; n < end; ++n)
            if (targets[n - begin] != kNoVertex) surfaces[uses[n].surface].move(uses[n].vertex, targets[n - begin]);
    }
    for (LabelSurface& surface : sheets.surfaces)
        std::erase_if(surface.triangles, [](const Corners& corners) { return corners[0] == kNoVertex; });
}

}  // namespace svt::writers
