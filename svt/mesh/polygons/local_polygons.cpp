#include <svt/mesh/polygons/local_polygons.hpp>

#include <svt/core/hash.hpp>
#include <svt/core/hash_index.hpp>
#include <svt/core/parallel.hpp>
#include <svt/mesh/polygons/triangulate.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <numeric>

namespace svt::mesh {
namespace {

constexpr double kLargestCoordinate = 1e9;
constexpr double kReportedDeviation = 0.01;  // val3dity's tolerance for planarity, metres

bool isSane(Vec3d point) {
    return isFinite(point) && std::abs(point.x) < kLargestCoordinate && std::abs(point.y) < kLargestCoordinate &&
           std::abs(point.z) < kLargestCoordinate;
}

// Numbers points by first use, so that equal coordinates have equal numbers. Returns the count of distinct points.
std::uint32_t weld(std::span<const Vec3d> points, std::vector<std::uint32_t>& ids) {
    HashIndex index(std::bit_ceil(points.size() * 2 + 16));
    std::vector<std::uint32_t> representative;
    ids.resize(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const Vec3d p = points[i];
        std::uint64_t hash = 0;
        for (const double at : {p.x, p.y, p.z}) hash = mixHash(hash, std::bit_cast<std::uint64_t>(at + 0.0));
        ids[i] = index.findOrAdd(
            mixHash(hash, 0), [&](std::uint32_t id) { return points[representative[id]] == p; },
            [&] {
                representative.push_back(i);
                return static_cast<std::uint32_t>(representative.size() - 1);
            });
    }
    return static_cast<std::uint32_t>(representative.size());
}

struct Finding {
    Severity severity;
    Code code;
    std::string message;
};

std::string describe(Vec3d world) { return fmt::format("({:.3f}, {:.3f}, {:.3f})", world.x, world.y, world.z); }

void judge(const Triangulation& result, const model::Polygon& polygon, std::vector<Finding>& findings) {
    const std::string at = polygon.points.empty() ? "" : " near " + describe(polygon.points[0]);
    if (result.crossesTooOften)
        findings.push_back(
            {Severity::Warning, Code::TriangulationFailed,
             fmt::format(
                 "the rings of a polygon of {} points cross themselves or each other in more than {} places; it is "
                 "left out{}. Its points are probably out of order: export them along the outline",
                 polygon.points.size(), maxCrossings(polygon.points.size()), at)});
    else if (result.hasFailed)
        findings.push_back(
            {Severity::Warning, Code::TriangulationFailed, "a polygon cannot be triangulated and is left out" + at});
    else if (result.isZeroArea && result.triangles.empty())
        findings.push_back({Severity::Warning, Code::ZeroArea, "a face has no area and is left out" + at});
    else if (result.isZeroArea)
        findings.push_back(
            {Severity::Note, Code::ZeroArea, "a triangle has no area; it counts for the closing test only" + at});
    if (result.isSelfTouching && !result.hasFailed)
        findings.push_back(
            {Severity::Warning, Code::SelfTouchingRing, "the rings of a polygon touch or cross themselves" + at});
    if (result.planeDeviation > kReportedDeviation)
        findings.push_back(
            {Severity::Warning, Code::NonPlanar,
             fmt::format(
                 "the points of a polygon lie up to {:.3f} m off its plane; it is used as triangles between them{}",
                 result.planeDeviation, at)});
}

// Rounds to a tenth of a micrometre, so that a decimal number gives the same bits whether it was written out (XML) or
// as an integer times a scale (JSON).
Vec3d rounded(Vec3d point) {
    constexpr double kSteps = 1e7;
    return {std::nearbyint(point.x * kSteps) / kSteps, std::nearbyint(point.y * kSteps) / kSteps,
            std::nearbyint(point.z * kSteps) / kSteps};
}

// Copies the points of all used polygons to flat arrays, relative to an origin in whole metres.
void layOutPoints(const model::BuildingModel& model, const std::vector<std::uint8_t>& isUsed, LocalPolygons& out,
                  Diagnostics* log) {
    const std::size_t count = model.polygons.size();
    out.firstPoint.assign(count, 0);
    out.pointCount.assign(count, 0);
    Box3d bounds;
    std::vector<std::uint8_t> isGood(count, 0);
    for (std::size_t p = 0; p < count; ++p) {
        if (!isUsed[p]) continue;
        const model::Polygon& polygon = model.polygons[p];
        const auto bad = std::find_if(polygon.points.begin(), polygon.points.end(), [](Vec3d v) { return !isSane(v); });
        if (bad != polygon.points.end()) {
            if (log != nullptr)
                log->add(
                    Severity::Warning, Code::BadCoordinate,
                    fmt::format("a polygon has the coordinate ({}, {}, {}) and is left out", bad->x, bad->y, bad->z),
                    model.placeOfPolygon(static_cast<model::PolygonIndex>(p)));
            continue;
        }
        isGood[p] = 1;
        for (const Vec3d& point : polygon.points) bounds.add(point);
    }
    if (!bounds.isEmpty()) out.origin = {std::floor(bounds.min.x), std::floor(bounds.min.y), std::floor(bounds.min.z)};
    for (std::size_t p = 0; p < count; ++p) {
        out.firstPoint[p] = static_cast<std::uint32_t>(out.points.size());
        if (!isGood[p]) continue;
        out.pointCount[p] = static_cast<std::uint32_t>(model.polygons[p].points.size());
        for (const Vec3d& point : model.polygons[p].points) out.points.push_back(rounded(point - out.origin));
    }
}

void makeCanonical(std::vector<Vec3d>& points, double distance, int threads) {
    parallelFor(3, 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t axis = begin; axis < end; ++axis) {
            std::vector<double> values(points.size());
            for (std::size_t i = 0; i < points.size(); ++i) values[i] = points[i][int(axis)];
            clusterValues(values, distance);
            for (std::size_t i = 0; i < points.size(); ++i) points[i][int(axis)] = values[i];
        }
    });
}

}  // namespace

void clusterValues(std::span<double> values, double distance) {
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    // Most models have few distinct values, so this table is short and the search below is fast.
    std::vector<double> representative(sorted.size());
    double start = 0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        if (i == 0 || sorted[i] - start > distance) start = sorted[i];
        representative[i] = start;
    }
    for (double& value : values)
        value = representative[static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), value) -
                                                        sorted.begin())];
}

LocalPolygons prepareLocalPolygons(const model::BuildingModel& model, const std::vector<std::uint8_t>& isUsed,
                                   const MeshOptions& options, Diagnostics* log) {
    LocalPolygons out;
    layOutPoints(model, isUsed, out, log);
    makeCanonical(out.points, options.weldDistance, options.threads);

    const std::size_t count = model.polygons.size();
    std::vector<Triangulation> results(count);
    parallelFor(count, 256, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p)
            if (out.pointCount[p] != 0 && !Progress::isCancelled(options.progress))
                results[p] =
                    triangulatePolygon(std::span<const Vec3d>(out.points).subspan(out.firstPoint[p], out.pointCount[p]),
                                       model.polygons[p].ringEnds);
    });

    out.firstTriangle.assign(count + 1, 0);
    std::vector<Finding> findings;
    for (std::size_t p = 0; p < count; ++p) {
        const Triangulation& result = results[p];
        const std::uint32_t first = out.firstPoint[p], own = out.pointCount[p];
        const auto extra = static_cast<std::uint32_t>(out.points.size());
        out.points.insert(out.points.end(), result.extraPoints.begin(), result.extraPoints.end());
        for (const auto& triangle : result.triangles) {
            std::array<std::uint32_t, 3> corners{};
            for (std::size_t c = 0; c < 3; ++c)
                corners[c] = triangle[c] < own ? first + triangle[c] : extra + (triangle[c] - own);
            out.triangles.push_back(corners);
        }
        out.firstTriangle[p + 1] = static_cast<std::uint32_t>(out.triangles.size());
        if (own == 0 || log == nullptr) continue;
        findings.clear();
        judge(result, model.polygons[p], findings);
        for (Finding& finding : findings)
            log->add(finding.severity, finding.code, std::move(finding.message),
                     model.placeOfPolygon(static_cast<model::PolygonIndex>(p)));
    }
    out.weldedCount = weld(out.points, out.pointIds);
    return out;
}

}  // namespace svt::mesh
