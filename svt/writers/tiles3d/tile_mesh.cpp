#include <svt/writers/tiles3d/tile_mesh.hpp>

#include <svt/writers/labels/label_looks.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

namespace svt::writers {
namespace {

constexpr double kLeastArea = 1e-12;  // m2

Vec3d acrossOf(const FeatureFaces& faces, const std::array<std::uint32_t, 3>& corners) {
    const Vec3d a = faces.points[corners[0]];
    return cross(faces.points[corners[1]] - a, faces.points[corners[2]] - a);
}

Vec3f withYUp(Vec3d v) noexcept {
    return {static_cast<float>(v.x), static_cast<float>(v.z), static_cast<float>(-v.y + 0.0)};
}

std::array<std::int8_t, 4> shortNormal(Vec3d normal) noexcept {
    const auto step = [](double value) { return static_cast<std::int8_t>(std::lround(value * 127)); };
    return {step(normal.x), step(normal.z), step(-normal.y), 0};
}

// Normals of a face that is not quite plane differ by a step.
bool isNearNormal(const std::array<std::int8_t, 4>& a, const std::array<std::int8_t, 4>& b) noexcept {
    for (std::size_t n = 0; n < 3; ++n)
        if (std::abs(a[n] - b[n]) > 1) return false;
    return true;
}

}  // namespace

VertexColor linearColor(Vec3f color, float opacity) noexcept {
    const auto byteOf = [](float channel) {
        return static_cast<std::uint8_t>(std::lround(std::clamp(linearChannel(channel), 0.0, 1.0) * 255));
    };
    return {byteOf(color.x), byteOf(color.y), byteOf(color.z),
            static_cast<std::uint8_t>(std::lround(std::clamp(opacity, 0.0f, 1.0f) * 255))};
}

void FeatureFaces::add(const LabelSurface& surface, std::span<const Vec3d> places,
                       const std::function<VertexColor(Vec3d)>& colorOf) {
    const auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), places.begin(), places.end());
    for (const auto& triangle : surface.triangles) {
        const std::array<std::uint32_t, 3> corners{triangle[0] + first, triangle[1] + first, triangle[2] + first};
        const Vec3d across = acrossOf(*this, corners);
        const double size = length(across);
        if (!(size > kLeastArea)) continue;  // moved onto a plane, it has no area and no normal
        triangles.push_back(corners);
        colors.push_back(colorOf(across * (1 / size)));
    }
}

FeatureFaces simplified(const FeatureFaces& faces, double side) {
    std::map<std::array<std::int64_t, 3>, std::uint32_t> cells;
    std::vector<std::uint32_t> newOf;
    std::vector<double> counts;
    FeatureFaces result;
    std::vector<char> isUsed(faces.points.size(), 0);
    for (const auto& triangle : faces.triangles)
        for (const std::uint32_t corner : triangle) isUsed[corner] = 1;
    for (std::size_t p = 0; p < faces.points.size(); ++p) {
        newOf.push_back(0);
        if (isUsed[p] == 0) continue;
        std::array<std::int64_t, 3> cell{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            cell[axis] = static_cast<std::int64_t>(std::floor(faces.points[p][static_cast<int>(axis)] / side));
        const auto [at, isNew] = cells.try_emplace(cell, static_cast<std::uint32_t>(result.points.size()));
        newOf[p] = at->second;
        if (isNew) {
            result.points.emplace_back();
            counts.push_back(0);
        }
        result.points[at->second] = result.points[at->second] + faces.points[p];
        ++counts[at->second];
    }
    for (std::size_t p = 0; p < result.points.size(); ++p) result.points[p] = result.points[p] * (1 / counts[p]);
    std::set<std::array<std::uint32_t, 3>> known;
    for (std::size_t t = 0; t < faces.triangles.size(); ++t) {
        std::array<std::uint32_t, 3> corners{}, sorted{};
        for (std::size_t c = 0; c < 3; ++c) corners[c] = newOf[faces.triangles[t][c]];
        if (!(length(acrossOf(result, corners)) > kLeastArea)) continue;
        sorted = corners;
        std::sort(sorted.begin(), sorted.end());
        if (!known.insert(sorted).second) continue;
        result.triangles.push_back(corners);
        result.colors.push_back(faces.colors[t]);
    }
    return result;
}

void TileMesh::append(const FeatureFaces& faces, std::uint32_t feature) {
    std::vector<std::vector<std::uint32_t>> verticesOf(faces.points.size());
    for (std::size_t t = 0; t < faces.triangles.size(); ++t) {
        const Vec3d across = acrossOf(faces, faces.triangles[t]);
        const std::array<std::int8_t, 4> normal = shortNormal(across * (1 / length(across)));
        for (const std::uint32_t point : faces.triangles[t]) {
            std::vector<std::uint32_t>& known = verticesOf[point];
            const auto same = std::find_if(known.begin(), known.end(), [&](std::uint32_t vertex) {
                return colors[vertex] == faces.colors[t] && isNearNormal(normals[vertex], normal);
            });
            if (same != known.end()) {
                indices.push_back(*same);
                continue;
            }
            known.push_back(static_cast<std::uint32_t>(positions.size()));
            indices.push_back(known.back());
            positions.push_back(withYUp(faces.points[point]));
            normals.push_back(normal);
            colors.push_back(faces.colors[t]);
            features.push_back(feature);
        }
    }
}

}  // namespace svt::writers
