#include <svt/quantities/touch/flat_faces.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace svt::quantities {

std::vector<FlatFace> flatFaces(const volume::VectorParts& parts, std::uint32_t label) {
    const double flatness = 4 * parts.unit;  // metres
    std::vector<std::pair<double, std::array<Vec3d, 3>>> triangles;
    for (const auto& triangle : volume::trianglesOf(parts, label)) {
        const std::array<Vec3d, 3> c{parts.position(triangle.corners[0], {}), parts.position(triangle.corners[1], {}),
                                     parts.position(triangle.corners[2], {})};
        const double twice = length(cross(c[1] - c[0], c[2] - c[0]));
        if (twice > 0) triangles.emplace_back(twice, c);
    }
    // The largest triangle of a plane defines it.
    std::stable_sort(triangles.begin(), triangles.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<FlatFace> faces;
    std::map<std::array<std::int64_t, 4>, std::vector<std::size_t>> byCell;
    for (const auto& one : triangles) {
        const double twice = one.first;
        const std::array<Vec3d, 3>& c = one.second;
        const Vec3d n = cross(c[1] - c[0], c[2] - c[0]) / twice;
        const double height = dot(n, c[0]);
        const std::array<std::int64_t, 4> cell{std::llround(n.x * 16), std::llround(n.y * 16), std::llround(n.z * 16),
                                               std::llround(height * 16)};
        std::vector<std::size_t>& near = byCell[cell];
        const auto found = std::find_if(near.begin(), near.end(), [&](std::size_t f) {
            const Vec3d normal = faces[f].normal, origin = faces[f].triangles.front()[0];
            return std::all_of(c.begin(), c.end(), [&, at = origin](const Vec3d& corner) {
                return std::abs(dot(corner - at, normal)) <= flatness;
            });
        });
        if (found != near.end()) {
            faces[*found].triangles.push_back(c);
            continue;
        }
        near.push_back(faces.size());
        faces.push_back({n, {c}});
    }
    return faces;
}

}  // namespace svt::quantities
