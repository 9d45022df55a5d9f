#include <svt/drawing/beyond/piercing.hpp>

#include <svt/plane/box_tree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace svt::drawing {
namespace {

constexpr double kReaches = 1e-3;    // metres: how far each face must reach beyond the other one
constexpr double kNotFlat = 0.05;    // sine of the angle between the faces
constexpr double kShortLine = 2e-3;  // metres

// The two points where the sides of a face meet the plane of another; nothing if it does not reach beyond both sides.
std::optional<std::array<Vec3d, 2>> crossingOf(const ViewFace& face, const ViewFace& plane) noexcept {
    std::array<double, 4> heights{};
    double low = 0, high = 0;
    for (std::uint32_t n = 0; n < face.cornerCount; ++n) {
        heights[n] = dot(plane.normal, face.corners[n] - plane.corners[0]);
        low = std::min(low, heights[n]);
        high = std::max(high, heights[n]);
    }
    if (low > -kReaches || high < kReaches) return std::nullopt;
    std::array<Vec3d, 2> ends{};
    std::uint32_t found = 0;
    for (std::uint32_t n = 0; n < face.cornerCount && found < 2; ++n) {
        const std::uint32_t next = n + 1 < face.cornerCount ? n + 1 : 0;
        if ((heights[n] >= 0) == (heights[next] >= 0)) continue;
        const double t = heights[n] / (heights[n] - heights[next]);
        ends[found++] = face.corners[n] + (face.corners[next] - face.corners[n]) * t;
    }
    if (found < 2) return std::nullopt;
    return ends;
}

std::optional<std::pair<Vec3d, Vec3d>> commonLine(const ViewFace& a, const ViewFace& b) noexcept {
    const Vec3d direction = cross(a.normal, b.normal);
    if (length(direction) < kNotFlat) return std::nullopt;
    const auto x = crossingOf(a, b);
    if (!x) return std::nullopt;
    auto y = crossingOf(b, a);
    if (!y) return std::nullopt;
    const Vec3d along = normalized(direction);
    std::array<Vec3d, 2> first = *x, second = *y;
    if (dot(first[1] - first[0], along) < 0) std::swap(first[0], first[1]);
    if (dot(second[1] - second[0], along) < 0) std::swap(second[0], second[1]);
    const Vec3d from = dot(first[0] - second[0], along) > 0 ? first[0] : second[0];
    const Vec3d to = dot(first[1] - second[1], along) < 0 ? first[1] : second[1];
    if (dot(to - from, along) < kShortLine) return std::nullopt;
    return std::pair(from, to);
}

}  // namespace

std::vector<ViewEdge> findPiercingLines(const std::vector<ViewFace>& faces) {
    std::vector<Box3d> boxes(faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::uint32_t n = 0; n < faces[f].cornerCount; ++n) boxes[f].add(faces[f].corners[n]);
    const plane::BoxTree tree(boxes);
    std::vector<ViewEdge> lines;
    std::vector<std::uint32_t> others;
    for (std::uint32_t a = 0; a < faces.size(); ++a) {
        others.clear();
        tree.forEach(boxes[a], [&](std::uint32_t b) {
            if (b > a && faces[a].label != faces[b].label) others.push_back(b);
        });
        std::sort(others.begin(), others.end());
        for (const std::uint32_t b : others)
            if (const auto line = commonLine(faces[a], faces[b]))
                lines.push_back({line->first, line->second, std::min(faces[a].label, faces[b].label), {}, 0, true});
    }
    return lines;
}

}  // namespace svt::drawing
