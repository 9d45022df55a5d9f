// For any rings the triangles of both ways have corners in range, and those of the sweep run like the exterior ring, fit
// each other and cover what GLU's cover.
#include <svt/mesh/polygons/triangulate.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace {

using svt::Vec3d;
using namespace svt::mesh;

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
    if (plain.hasFailed) return 0;
    // GLU has the places where edges cross with the precision of a float.
    const double expected = areasOf(rings, plain, normal).first;
    require(std::abs(area - expected) <= 0.02 * (1 + std::abs(expected)) + 1e-3 * double(sweep.extraPoints.size()));
    return 0;
}
