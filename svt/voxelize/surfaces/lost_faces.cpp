#include <svt/voxelize/surfaces/lost_faces.hpp>

#include <svt/voxelize/lattice/scan.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace svt::voxelize {
namespace {

using Voxels = std::set<Vec3i>;

template <class Has>
bool anyAround(Vec3i v, const Has& has) {
    for (int n = 0; n < 27; ++n)
        if (has(v + Vec3i{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1})) return true;
    return false;
}

// The voxels of one object.
struct OwnVoxels {
    const volume::ColumnVolume& columns;
    std::span<const std::uint8_t> ranks;
    volume::Scalar scalar;

    [[nodiscard]] bool isInGrid(Vec3i v) const {
        const Vec3i d = columns.dimension();
        return v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < d.x && v.y < d.y && v.z < d.z;
    }
    // Whether the object may take the voxel: nothing of the same or a finer rank owns it. False outside of the grid.
    [[nodiscard]] bool isFree(Vec3i v) const {
        return isInGrid(v) && ranks[columns.scalarAt(v.x, v.y, v.z)] > ranks[scalar];
    }
    [[nodiscard]] bool hasAround(Vec3i v) const {
        return anyAround(v, [&](Vec3i n) { return isInGrid(n) && columns.scalarAt(n.x, n.y, n.z) == scalar; });
    }
};

// The parts of a surface that the filling leaves out.
struct Lost {
    std::uint64_t crossings = 0, lost = 0;  // of faces and sample lines: all, and those farther than a voxel from it
    Voxels far, near;                       // behind these faces: without a voxel of the object around, and with one
    Voxels lines;                           // along triangles between sample lines
    [[nodiscard]] double share() const { return crossings == 0 ? 0 : double(lost) / double(crossings); }
};

// Inspects every `stride`-th crossing of a triangle.
// \return false if the triangle lies between the sample lines of all axes
bool crossTriangle(const IndexMesh& mesh, const mesh::Triangle& triangle, std::int32_t stride, const OwnVoxels& own,
                   Lost& found) {
    bool isCrossed = false;
    const Vec3i dimension = own.columns.dimension();
    for (const ScanAxes& axes : kScanAxes) {
        const int along = int(axes.x), across = int(axes.y), up = int(axes.z);
        ScanTriangle scan;
        if (!setUpScan(mesh.points[triangle.corners[0]], mesh.points[triangle.corners[1]],
                       mesh.points[triangle.corners[2]], axes, scan))
            continue;
        const auto inspectRow = [&](std::int32_t row, std::int32_t begin, std::int32_t end) {
            isCrossed = true;
            const std::int64_t base = scan.height.base + scan.height.slopeY * row;
            // Rows begin at different samples, so that narrow faces are met as well.
            for (std::int32_t x = begin + (stride - (begin + 7 * row) % stride) % stride; x < end; x += stride) {
                Vec3i above;
                above[along] = x;
                above[across] = row;
                above[up] = sampleAbove(scan, base + scan.height.slopeX * x);
                Vec3i behind = above, before = above;
                --(scan.sign < 0 ? behind : before)[up];
                ++found.crossings;
                if (!own.isFree(behind) || !own.isFree(before)) continue;
                const bool isFar = !own.hasAround(behind);
                found.lost += isFar;
                const auto isTaken = [&](Vec3i v) { return found.far.contains(v) || found.near.contains(v); };
                if (!isTaken(behind) && !isTaken(before)) (isFar ? found.far : found.near).insert(behind);
            }
        };
        scanRows(scan, 0, dimension[across], 0, dimension[along], inspectRow);
    }
    return isCrossed;
}

// The samples nearest to the longest edge of a triangle, one per voxel.
void followEdge(const IndexMesh& mesh, const mesh::Triangle& triangle, const OwnVoxels& own, Lost& found) {
    Vec3d from{}, way{};
    for (std::size_t c = 0; c < 3; ++c) {
        const QuantaPoint &p = mesh.points[triangle.corners[c]], &q = mesh.points[triangle.corners[(c + 1) % 3]];
        const Vec3d edge = Vec3d{double(q[0] - p[0]), double(q[1] - p[1]), double(q[2] - p[2])} / double(kQuanta);
        if (dot(edge, edge) < dot(way, way)) continue;
        way = edge;
        from = Vec3d{double(p[0]), double(p[1]), double(p[2])} / double(kQuanta);
    }
    const int steps = 1 + int(std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)}));
    for (int s = 0; s <= steps; ++s) {
        const Vec3d at = from + way * (double(s) / steps);
        const Vec3i v{static_cast<std::int32_t>(std::lrint(at.x)), static_cast<std::int32_t>(std::lrint(at.y)),
                      static_cast<std::int32_t>(std::lrint(at.z))};
        ++found.crossings;
        if (!own.isFree(v) || own.hasAround(v)) continue;
        ++found.lost;
        if (!anyAround(v, [&](Vec3i n) { return found.far.contains(n); })) found.lines.insert(v);
    }
}

// Samples on faces of the object, in voxels.
double surfaceOf(const IndexMesh& mesh) {
    double surface = 0;
    for (const mesh::Triangle& triangle : mesh.mesh->triangles) {
        Vec3d corner[3];
        for (std::size_t c = 0; c < 3; ++c) {
            const QuantaPoint& p = mesh.points[triangle.corners[c]];
            corner[c] = Vec3d{double(p[0]), double(p[1]), double(p[2])} / double(kQuanta);
        }
        surface += length(cross(corner[1] - corner[0], corner[2] - corner[0])) / 2;
    }
    return surface;
}

Lost inspect(const IndexMesh& mesh, std::int32_t stride, const OwnVoxels& own) {
    Lost found;
    std::vector<const mesh::Triangle*> narrow;
    for (const mesh::Triangle& triangle : mesh.mesh->triangles)
        if (!crossTriangle(mesh, triangle, stride, own, found)) narrow.push_back(&triangle);
    for (const mesh::Triangle* triangle : narrow) followEdge(mesh, *triangle, own, found);
    return found;
}

}  // namespace

LostFaces findLostFaces(const IndexMesh& mesh, const volume::ColumnVolume& columns, std::span<const std::uint8_t> ranks,
                        volume::Scalar scalar) {
    constexpr double kEnough = 1e5;  // crossings that show whether the filling leaves out much
    constexpr double kLargestStride = 64;
    const auto stride = static_cast<std::int32_t>(std::clamp(surfaceOf(mesh) / kEnough, 1.0, kLargestStride));
    const OwnVoxels own{columns, ranks, scalar};
    Lost found = inspect(mesh, stride, own);
    if (found.share() <= kLostShare) return {};
    if (stride > 1) found = inspect(mesh, 1, own);
    LostFaces lost{found.share(), {}};
    const auto add = [&](Vec3i v) { lost.voxels.push_back({v, scalar}); };
    for (const Vec3i& v : found.far) add(v);
    for (const Vec3i& v : found.lines) add(v);
    // Voxels beside the object only join it and lost faces; others are edges between samples.
    for (const Vec3i& v : found.near)
        if (anyAround(v, [&](Vec3i n) { return found.far.contains(n); })) add(v);
    return lost;
}

}  // namespace svt::voxelize
