#include <svt/mesh/polygons/triangulate.hpp>

#include <svt/plane/triangulate_graph.hpp>

#include <GL/glu.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>

namespace svt::mesh {
namespace {

struct Tessellation {
    Triangulation* result = nullptr;
    std::size_t inputCount = 0;
    std::vector<std::uint32_t> corners;
    std::deque<std::array<double, 3>> extraCoordinates;  // GLU keeps pointers into it
};

void onBegin(GLenum, void*) {}
void onEnd(void*) {}
// An edge flag callback makes GLU emit single triangles instead of strips and fans.
void onEdgeFlag(GLboolean, void*) {}

std::uint32_t indexFromData(const void* data) {
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(data) - 1);
}
void* dataFromIndex(std::size_t index) { return reinterpret_cast<void*>(static_cast<std::uintptr_t>(index) + 1); }

void onVertex(void* data, void* user) { static_cast<Tessellation*>(user)->corners.push_back(indexFromData(data)); }

void onError(GLenum, void* user) { static_cast<Tessellation*>(user)->result->hasFailed = true; }

void onCombine(const GLdouble coordinates[3], void* data[4], GLfloat weights[4], void** out, void* user) {
    auto* tessellation = static_cast<Tessellation*>(user);
    tessellation->result->isSelfTouching = true;
    // Two coinciding points: use one of them for both, so that neighbours still match.
    if (data[2] == nullptr) {
        *out = weights[0] >= weights[1] ? data[0] : data[1];
        return;
    }
    auto& extra = tessellation->result->extraPoints;
    extra.push_back({coordinates[0], coordinates[1], coordinates[2]});
    *out = dataFromIndex(tessellation->inputCount + extra.size() - 1);
}

using Callback = void (*)();
template <class F>
Callback asCallback(F* function) {
    return reinterpret_cast<Callback>(function);
}

// True for convex quads: all four corner triangles have the orientation of the polygon's normal.
bool isConvexQuad(std::span<const Vec3d> q, Vec3d normal) {
    const auto area = [&](int a, int b, int c) { return dot(cross(q[b] - q[a], q[c] - q[a]), normal); };
    const double smallest = 1e-9 * dot(normal, normal);
    return area(0, 1, 2) > smallest && area(0, 2, 3) > smallest && area(0, 1, 3) > smallest && area(1, 2, 3) > smallest;
}

double deviationFromPlane(std::span<const Vec3d> points, Vec3d unitNormal) {
    Vec3d center{};
    for (const Vec3d& point : points) center = center + point;
    center = center / static_cast<double>(points.size());
    double deviation = 0;
    for (const Vec3d& point : points) deviation = std::max(deviation, std::abs(dot(point - center, unitNormal)));
    return deviation;
}

void tessellate(std::span<const Vec3d> points, std::span<const std::uint32_t> ringEnds, Vec3d normal,
                Triangulation& result) {
    const std::unique_ptr<GLUtesselator, void (*)(GLUtesselator*)> tess(gluNewTess(), gluDeleteTess);
    Tessellation state;
    state.result = &result;
    state.inputCount = points.size();
    gluTessCallback(tess.get(), GLU_TESS_BEGIN_DATA, asCallback(onBegin));
    gluTessCallback(tess.get(), GLU_TESS_END_DATA, asCallback(onEnd));
    gluTessCallback(tess.get(), GLU_TESS_EDGE_FLAG_DATA, asCallback(onEdgeFlag));
    gluTessCallback(tess.get(), GLU_TESS_VERTEX_DATA, asCallback(onVertex));
    gluTessCallback(tess.get(), GLU_TESS_ERROR_DATA, asCallback(onError));
    gluTessCallback(tess.get(), GLU_TESS_COMBINE_DATA, asCallback(onCombine));
    gluTessProperty(tess.get(), GLU_TESS_WINDING_RULE, GLU_TESS_WINDING_ODD);
    gluTessNormal(tess.get(), normal.x, normal.y, normal.z);
    gluTessBeginPolygon(tess.get(), &state);
    std::uint32_t begin = 0;
    for (const std::uint32_t end : ringEnds) {
        if (end - begin >= 3) {
            gluTessBeginContour(tess.get());
            for (std::uint32_t i = begin; i < end; ++i) {
                // GLU copies the location.
                GLdouble location[3] = {points[i].x, points[i].y, points[i].z};
                gluTessVertex(tess.get(), location, dataFromIndex(i));
            }
            gluTessEndContour(tess.get());
        }
        begin = end;
    }
    gluTessEndPolygon(tess.get());
    for (std::size_t i = 0; i + 2 < state.corners.size(); i += 3) {
        const std::array<std::uint32_t, 3> triangle{state.corners[i], state.corners[i + 1], state.corners[i + 2]};
        if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[0] == triangle[2]) continue;
        result.triangles.push_back(triangle);
    }
}

// The points of a polygon in the coordinate plane that its normal is nearest to, on a grid of 2^50 steps across at
// least: a nanometre for a polygon of a thousand kilometres. The same projection as GLU's.
std::vector<plane::EdgeGraph::Vertex> flatten(std::span<const Vec3d> points, Vec3d normal) {
    const Vec3d size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    int axis = size.y > size.x ? 1 : 0;
    if (size.z > size[axis]) axis = 2;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    double extent = 0;
    for (const Vec3d& point : points)
        extent = std::max({extent, std::abs(point[u] - points[0][u]), std::abs(point[v] - points[0][v])});
    if (!(extent > 0) || !std::isfinite(extent)) return {};
    const int shift = 48 - std::ilogb(extent);
    const auto steps = [&](double length) { return static_cast<std::int64_t>(std::llrint(std::ldexp(length, shift))); };
    std::vector<plane::EdgeGraph::Vertex> vertices(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const std::int64_t y = steps(points[i][v] - points[0][v]);
        vertices[i] = {{steps(points[i][u] - points[0][u]), normal[axis] < 0 ? -y : y}, i};
    }
    return vertices;
}

// The edges of the rings, tidy; without vertices if the polygon has no extent.
plane::EdgeGraph flatGraph(std::span<const Vec3d> points, std::span<const std::uint32_t> ringEnds, Vec3d normal) {
    plane::EdgeGraph graph;
    graph.vertices = flatten(points, normal);
    if (graph.vertices.empty()) return graph;
    std::uint32_t begin = 0;
    for (const std::uint32_t end : ringEnds) {
        if (end - begin >= 3)
            for (std::uint32_t i = begin; i < end; ++i) graph.edges.push_back({i, i + 1 == end ? begin : i + 1});
        begin = end;
    }
    graph.tidy();
    return graph;
}

void triangulateBySweep(plane::EdgeGraph graph, std::span<const Vec3d> points, Triangulation& result) {
    using Ends = std::pair<std::uint32_t, std::uint32_t>;
    const auto makePoint = [&](Ends first, double t, Ends second, double u) {
        const auto at = [&](std::uint32_t point) {
            return point < points.size() ? points[point] : result.extraPoints[point - points.size()];
        };
        const auto onEdge = [&](Ends ends, double fraction) {
            return at(ends.first) + (at(ends.second) - at(ends.first)) * fraction;
        };
        result.extraPoints.push_back((onEdge(first, t) + onEdge(second, u)) * 0.5);
        return static_cast<std::uint32_t>(points.size() + result.extraPoints.size() - 1);
    };
    result.crossesTooOften = !plane::cutCrossings(graph, maxCrossings(points.size()), makePoint);
    result.hasFailed = result.crossesTooOften || graph.vertices.empty();
    result.isSelfTouching = graph.isTouching;
    if (!result.hasFailed) result.triangles = plane::triangulateInside(graph);
}

// GLU adds crossings one by one, each with a search through all edges.
bool crossesTooOften(plane::EdgeGraph graph, std::size_t pointCount) {
    const auto noPoint = [](auto, double, auto, double) { return std::uint32_t{0}; };
    return !plane::cutCrossings(graph, maxCrossings(pointCount), noPoint);
}

// GLU computes crossings with the precision of a float; where many edges meet, it lost 3 % of an area. So the sweep
// triangulates polygons with crossings, unless there are too many.
void cutExactly(std::span<const Vec3d> points, std::span<const std::uint32_t> ringEnds, Vec3d normal,
                Triangulation& result) {
    Triangulation exact;
    triangulateBySweep(flatGraph(points, ringEnds, normal), points, exact);
    if (exact.hasFailed) return;
    result.triangles = std::move(exact.triangles);
    result.extraPoints = std::move(exact.extraPoints);
}

void triangulateRings(std::span<const Vec3d> points, std::span<const std::uint32_t> ringEnds, Vec3d normal,
                      TriangulateBy by, Triangulation& result) {
    if (by == TriangulateBy::PointCount && points.size() > kMaxGluPoints) by = TriangulateBy::Sweep;
    if (by == TriangulateBy::Sweep) {
        triangulateBySweep(flatGraph(points, ringEnds, normal), points, result);
    } else {
        if (by == TriangulateBy::PointCount && points.size() > kMaxUncountedPoints)
            result.crossesTooOften = crossesTooOften(flatGraph(points, ringEnds, normal), points.size());
        if (result.crossesTooOften)
            result.hasFailed = result.isSelfTouching = true;
        else
            tessellate(points, ringEnds, normal, result);
        if (by == TriangulateBy::PointCount && !result.extraPoints.empty())
            cutExactly(points, ringEnds, normal, result);
    }
    if (!result.hasFailed) return;
    result.triangles.clear();
    result.extraPoints.clear();
}

}  // namespace

Triangulation triangulatePolygon(std::span<const Vec3d> points, std::span<const std::uint32_t> ringEnds,
                                 TriangulateBy by) {
    Triangulation result;
    if (ringEnds.empty() || ringEnds[0] < 3) {
        result.isZeroArea = true;
        return result;
    }
    const auto exterior = points.first(ringEnds[0]);
    const Vec3d normal = newellNormal(exterior);
    double perimeter = 0;
    for (std::size_t i = 0; i < exterior.size(); ++i)
        perimeter += length(exterior[(i + 1) % exterior.size()] - exterior[i]);
    result.isZeroArea = !(length(normal) > 1e-12 * perimeter * perimeter);
    if (points.size() == 3) {
        // Kept even without area: tessellated models have many such slivers, and their edges belong to the shell.
        result.triangles.push_back({0, 1, 2});
        return result;
    }
    if (result.isZeroArea) return result;
    const Vec3d unit = normalized(normal);
    result.planeDeviation = deviationFromPlane(points, unit);
    if (ringEnds.size() == 1 && points.size() == 4 && isConvexQuad(exterior, normal)) {
        result.triangles = {{0, 1, 2}, {0, 2, 3}};
        return result;
    }
    triangulateRings(points, ringEnds, unit, by, result);
    if (result.triangles.empty() && !result.hasFailed) result.isZeroArea = true;
    return result;
}

}  // namespace svt::mesh
