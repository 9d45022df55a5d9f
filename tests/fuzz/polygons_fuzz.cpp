// For any rings the triangles of both ways have corners in range, and those of the sweep run like the exterior ring, fit
// each other and have the area that the rings enclose by the odd rule, counted here in strips between crossings.
#include <svt/mesh/polygons/triangulate.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace {

using svt::Vec3d;
using namespace svt::mesh;

// Strips and edges are both quadratic in points where all edges cross.
constexpr std::size_t kMaxCountedPoints = 80;

void require(bool condition) {
    if (!condition) std::abort();
}

struct Rings {
    std::vector<Vec3d> points;
    std::vector<std::uint32_t> ends;
};

// The first byte is the size of the grid, so that points coincide more or less often; then two bytes a point, in a plane
// that is tilted by the second byte. A byte of 255 ends a ring.
Rings ringsOf(const std::uint8_t* data, std::size_t size) {
    Rings rings;
    if (size < 2) return rings;
    const int grid = 2 + data[0] % 253;
    const double tilt = data[1] % 4 * 0.3;
    for (std::size_t i = 2; i + 1 < size; i += 2) {
        if (data[i] == 255) {
            rings.ends.push_back(static_cast<std::uint32_t>(rings.points.size()));
            --i;
            continue;
        }
        const double x = data[i] % grid, y = data[i + 1] % grid;
        rings.points.push_back({x, y, tilt * x});
    }
    rings.ends.push_back(static_cast<std::uint32_t>(rings.points.size()));
    return rings;
}

// Areas along the normal of the exterior ring: the sum, and that of the triangles that run against it.
std::pair<double, double> areasOf(const Rings& rings, const Triangulation& result, Vec3d normal) {
    const std::size_t count = rings.points.size() + result.extraPoints.size();
    const auto at = [&](std::uint32_t point) {
        return point < rings.points.size() ? rings.points[point] : result.extraPoints[point - rings.points.size()];
    };
    double sum = 0, against = 0;
    for (const auto& t : result.triangles) {
        for (const std::uint32_t corner : t) require(corner < count);
        const double area = dot(cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0])), normal) / 2;
        sum += area;
        if (area < 0) against -= area;
    }
    return {sum, against};
}

using Edge = std::array<Vec3d, 2>;

// x where two edges cross or touch, if they do in one point.
std::optional<double> crossingOf(const Edge& a, const Edge& b) {
    const Vec3d along = a[1] - a[0], across = b[1] - b[0], apart = b[0] - a[0];
    const double turn = along.x * across.y - along.y * across.x;
    if (turn == 0) return std::nullopt;
    const double t = (apart.x * across.y - apart.y * across.x) / turn,
                 u = (apart.x * along.y - apart.y * along.x) / turn;
    if (t < 0 || t > 1 || u < 0 || u > 1) return std::nullopt;
    return a[0].x + t * along.x;
}

// In x and y. Between neighbouring crossings and corners no two edges change their order, so that the area of a strip is
// its width times what is inside in its middle.
double areaBetweenCrossings(const Rings& rings) {
    std::vector<Edge> edges;
    std::uint32_t begin = 0;
    for (const std::uint32_t end : rings.ends) {
        if (end - begin >= 3)
            for (std::uint32_t i = begin; i < end; ++i)
                edges.push_back({rings.points[i], rings.points[i + 1 == end ? begin : i + 1]});
        begin = end;
    }
    std::set<double> stops;
    for (std::size_t a = 0; a < edges.size(); ++a) {
        stops.insert(edges[a][0].x);
        for (std::size_t b = 0; b < a; ++b)
            if (const auto x = crossingOf(edges[a], edges[b])) stops.insert(*x);
    }
    double area = 0;
    for (auto stop = stops.begin(); stop != stops.end() && std::next(stop) != stops.end(); ++stop) {
        const double width = *std::next(stop) - *stop, x = *stop + width / 2;
        std::vector<double> heights;
        for (const Edge& e : edges)
            if (std::min(e[0].x, e[1].x) < x && x < std::max(e[0].x, e[1].x))
                heights.push_back(e[0].y + (x - e[0].x) / (e[1].x - e[0].x) * (e[1].y - e[0].y));
        std::sort(heights.begin(), heights.end());
        for (std::size_t i = 0; i + 1 < heights.size(); i += 2) area += width * (heights[i + 1] - heights[i]);
    }
    return area;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Rings rings = ringsOf(data, std::min<std::size_t>(size, 600));  // GLU is slow where all edges cross
    if (rings.ends.empty() || rings.ends[0] < 3) return 0;
    const Vec3d normal = normalized(newellNormal(std::span(rings.points).first(rings.ends[0])));
    const Triangulation plain = triangulatePolygon(rings.points, rings.ends);
    areasOf(rings, plain, normal);
    const Triangulation sweep = triangulatePolygon(rings.points, rings.ends, TriangulateBy::Sweep);
    if (sweep.hasFailed || sweep.isZeroArea) return 0;
    const auto [area, against] = areasOf(rings, sweep, normal);
    require(against <= 1e-6);
    std::set<std::pair<std::uint32_t, std::uint32_t>> uses;
    if (rings.points.size() > 4)
        for (const auto& t : sweep.triangles)
            for (std::size_t c = 0; c < 3; ++c) require(uses.insert({t[c], t[(c + 1) % 3]}).second);
    if (rings.points.size() > kMaxCountedPoints) return 0;
    const double expected = areaBetweenCrossings(rings) / std::abs(normal.z);
    require(std::abs(area - expected) <= 1e-6 * (1 + expected));
    return 0;
}
