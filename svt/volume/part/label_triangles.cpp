#include <svt/volume/label_triangles.hpp>

#include <svt/core/hash.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace svt::volume {

std::span<const VectorParts::Triangle> trianglesOf(const VectorParts& parts, std::uint32_t label) noexcept {
    const auto isBelow = [](const VectorParts::Triangle& triangle, std::uint32_t l) { return triangle.label < l; };
    const auto first = std::lower_bound(parts.triangles.begin(), parts.triangles.end(), label, isBelow);
    const auto end = std::lower_bound(first, parts.triangles.end(), label + 1, isBelow);
    return std::span(parts.triangles)
        .subspan(static_cast<std::size_t>(first - parts.triangles.begin()), static_cast<std::size_t>(end - first));
}

std::uint64_t digestOf(const VectorParts& parts, const VectorParts::Triangle& triangle, std::uint64_t seed) noexcept {
    std::array<Vec3i, 3> points{};
    for (std::size_t c = 0; c < 3; ++c) points[c] = parts.points[triangle.corners[c]];
    std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
    std::uint64_t hash = seed;
    for (const Vec3i& point : points)
        for (int axis = 0; axis < 3; ++axis) hash = mixHash(hash, static_cast<std::uint32_t>(point[axis]));
    return hash ^ hash >> 32;
}

bool enclosesStatedVolume(const Label& label, double enclosed, double area, double unit) noexcept {
    return hasClosedMesh(label.filling) &&
           std::abs(enclosed - label.volume) <= area * unit + 1e-6 * std::abs(label.volume);
}

}  // namespace svt::volume
