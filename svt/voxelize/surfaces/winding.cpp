#include <svt/voxelize/surfaces/winding.hpp>

#include <svt/core/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace svt::voxelize {
namespace {

constexpr double kPi = std::numbers::pi;

// Signed solid angle of the spherical triangle of three unit vectors (Van Oosterom & Strackee 1983).
double solidAngle(Vec3d a, Vec3d b, Vec3d c) noexcept {
    return 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

double distanceToSegment(Vec3d p, Vec3d a, Vec3d b) noexcept {
    const Vec3d ab = b - a;
    const double squared = dot(ab, ab);
    const double t = squared > 0 ? std::clamp(dot(p - a, ab) / squared, 0.0, 1.0) : 0.0;
    return length(p - (a + ab * t));
}

// The open edges of the shell.
struct OpenEdges {
    std::vector<std::pair<Vec3d, Vec3d>> edges;  // directed as in the mesh, local space
    double totalLength = 0;

    // Winding number of the curtains (see winding.hpp) at p, and the distance of the nearest edge.
    [[nodiscard]] double windingBelow(Vec3d p, double& nearest) const noexcept {
        const Vec3d down{0, 0, -1};
        double sum = 0;
        nearest = 1e300;
        for (const auto& [from, to] : edges) {
            sum += solidAngle(normalized(to - p), normalized(from - p), down);
            nearest = std::min(nearest, distanceToSegment(p, from, to));
        }
        return sum / (4 * kPi);
    }
};

struct Crossing {
    std::int32_t i, k, winding;
};

}  // namespace

double windingNumber(const mesh::ObjectMesh& mesh, Vec3d point) noexcept {
    double sum = 0;
    for (const mesh::Triangle& triangle : mesh.triangles)
        sum += solidAngle(normalized(mesh.vertices[triangle.corners[0]] - point),
                          normalized(mesh.vertices[triangle.corners[1]] - point),
                          normalized(mesh.vertices[triangle.corners[2]] - point));
    return sum / (4 * kPi);
}

std::uint64_t addWindingFill(const IndexMesh& mesh, const mesh::MeshSet& meshes, const volume::Grid& grid,
                             std::uint32_t claim, int threads, std::vector<ClaimedBox>& boxes) {
    const Vec3i dimension = grid.dimension();
    QuantaPoint low{INT32_MAX, INT32_MAX, INT32_MAX}, high{INT32_MIN, INT32_MIN, INT32_MIN};
    for (const QuantaPoint& point : mesh.points)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], point[axis]);
            high[axis] = std::max(high[axis], point[axis]);
        }
    // From outside the bounding box the shell is seen within a half-space: the winding number stays below 1/2.
    const auto first = [&](std::size_t axis) {
        return std::clamp<std::int32_t>(static_cast<std::int32_t>(firstSampleAbove(low[axis])), 0,
                                        dimension[int(axis)]);
    };
    const auto end = [&](std::size_t axis) {
        return std::clamp<std::int32_t>(static_cast<std::int32_t>(firstSampleAbove(high[axis])), 0,
                                        dimension[int(axis)]);
    };
    const std::int32_t firstI = first(0), endI = end(0), firstJ = first(1), endJ = end(1), firstK = first(2),
                       endK = end(2);
    if (firstI >= endI || firstJ >= endJ || firstK >= endK) return 0;

    OpenEdges openEdges;
    for (const mesh::OpenEdge& edge : mesh.mesh->openEdges) {
        openEdges.edges.emplace_back(mesh.mesh->vertices[edge.from], mesh.mesh->vertices[edge.to]);
        openEdges.totalLength += length(openEdges.edges.back().second - openEdges.edges.back().first);
    }
    std::vector<ScanTriangle> triangles;
    for (const mesh::Triangle& triangle : mesh.mesh->triangles) {
        ScanTriangle scan;
        if (setUpScan(mesh.points[triangle.corners[0]], mesh.points[triangle.corners[1]],
                      mesh.points[triangle.corners[2]], kScanAxes[2], scan))
            triangles.push_back(scan);
    }

    const std::size_t rows = std::size_t(endJ - firstJ);
    std::vector<std::vector<ClaimedBox>> rowBoxes(rows);
    std::vector<std::uint64_t> rowUncertain(rows, 0);
    const double step = std::max(1e-12, length(grid.worldFromIndexDirection({0, 0, 1})));
    parallelFor(rows, 1, threads, [&](std::size_t beginRow, std::size_t endRow) {
        std::vector<Crossing> crossings;
        for (std::size_t row = beginRow; row < endRow; ++row) {
            const std::int32_t j = firstJ + static_cast<std::int32_t>(row);
            crossings.clear();
            for (const ScanTriangle& t : triangles)
                scanRows(t, j, j + 1, firstI, endI, [&](std::int32_t, std::int32_t from, std::int32_t to) {
                    for (std::int32_t i = from; i < to; ++i)
                        crossings.push_back(
                            {i, sampleAbove(t, t.height.base + t.height.slopeX * i + t.height.slopeY * j), -t.sign});
                });
            std::sort(crossings.begin(), crossings.end(),
                      [](const Crossing& p, const Crossing& q) { return std::tie(p.i, p.k) < std::tie(q.i, q.k); });
            std::size_t c = 0;
            for (std::int32_t i = firstI; i < endI; ++i) {
                while (c < crossings.size() && crossings[c].i < i) ++c;
                std::size_t cEnd = c;
                int above = 0;  // signed crossings of the upward ray from the current sample
                for (; cEnd < crossings.size() && crossings[cEnd].i == i; ++cEnd) above += crossings[cEnd].winding;
                std::int32_t begin = -1;
                for (std::int32_t k = firstK; k < endK;) {
                    for (; c < cEnd && crossings[c].k <= k; ++c) above -= crossings[c].winding;
                    const Vec3d at{i + 1.0 / double(kQuanta), j + 1.0 / double(kQuanta), k + 1.0 / double(kQuanta)};
                    double nearest = 0;
                    const double w = above - openEdges.windingBelow(grid.worldFromIndex(at) - meshes.origin, nearest);
                    const bool isInside = w >= 0.5;
                    const double reach = std::min(nearest / 2, std::abs(w - 0.5) * kPi * nearest * nearest /
                                                                   std::max(openEdges.totalLength, 1e-300));
                    std::int32_t next = k + 1 + static_cast<std::int32_t>(std::min(reach / step, 1e6));
                    next = std::min(next, c < cEnd ? std::max(crossings[c].k, k + 1) : endK);
                    next = std::min(next, endK);
                    if (w > 0.25 && w < 0.75) rowUncertain[row] += std::uint64_t(next - k);
                    if (isInside && begin < 0) begin = k;
                    if (!isInside && begin >= 0) {
                        rowBoxes[row].push_back({j, j + 1, i, i + 1, begin, k, claim});
                        begin = -1;
                    }
                    k = next;
                }
                if (begin >= 0) rowBoxes[row].push_back({j, j + 1, i, i + 1, begin, endK, claim});
                c = cEnd;
            }
        }
    });
    std::uint64_t uncertain = 0;
    for (std::size_t row = 0; row < rows; ++row) {
        uncertain += rowUncertain[row];
        boxes.insert(boxes.end(), rowBoxes[row].begin(), rowBoxes[row].end());
    }
    return uncertain;
}

}  // namespace svt::voxelize
