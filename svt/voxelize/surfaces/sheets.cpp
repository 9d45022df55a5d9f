#include <svt/core/hash.hpp>
#include <svt/voxelize/surfaces/sheets.hpp>

#include <svt/core/hash_index.hpp>
#include <svt/voxelize/surfaces/disjoint_boxes.hpp>
#include <svt/voxelize/surfaces/thin_plates.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <tuple>

namespace svt::voxelize {
namespace {

std::int32_t along(Vec3i dimension, std::size_t axis) { return dimension[int(axis)]; }

Vec3i nearestSample(Vec3d index) {
    return {static_cast<std::int32_t>(std::lrint(index.x)), static_cast<std::int32_t>(std::lrint(index.y)),
            static_cast<std::int32_t>(std::lrint(index.z))};
}

void addNearest(Vec3d index, Vec3i dimension, std::uint32_t claim, std::vector<ClaimedBox>& boxes) {
    const Vec3i v = nearestSample(index);
    if (v.x < 0 || v.y < 0 || v.z < 0 || v.x >= dimension.x || v.y >= dimension.y || v.z >= dimension.z) return;
    boxes.push_back({v.y, v.y + 1, v.x, v.x + 1, v.z, v.z + 1, claim});
}

// A set of undirected lines between samples.
class SampleLines {
public:
    // Returns false if the line was there already.
    bool add(Vec3i from, Vec3i to) {
        const std::pair<Vec3i, Vec3i> line = std::minmax(from, to);
        const auto count = static_cast<std::uint32_t>(lines_.size());
        const std::uint32_t number = index_.findOrAdd(
            hashOf(line), [&](std::uint32_t known) { return lines_[known] == line; },
            [&] {
                lines_.push_back(line);
                return count;
            });
        return number == count;
    }

private:
    static std::uint64_t hashOf(const std::pair<Vec3i, Vec3i>& line) noexcept {
        std::uint64_t hash = 0;
        for (const Vec3i& end : {line.first, line.second})
            for (int axis = 0; axis < 3; ++axis) hash = mixHash(hash, static_cast<std::uint32_t>(end[axis]));
        return hash;
    }

    std::vector<std::pair<Vec3i, Vec3i>> lines_;
    HashIndex index_;
};

// Separating axis test of a triangle against the box [-h, h]^3 around `center`.
bool touchesBox(const std::array<Vec3d, 3>& triangle, Vec3d center, double h) {
    const Vec3d v[3] = {triangle[0] - center, triangle[1] - center, triangle[2] - center};
    for (int axis = 0; axis < 3; ++axis)
        if (std::min({v[0][axis], v[1][axis], v[2][axis]}) > h || std::max({v[0][axis], v[1][axis], v[2][axis]}) < -h)
            return false;
    const Vec3d edges[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
    const auto isSeparating = [&](Vec3d axis) {
        const double p[3] = {dot(axis, v[0]), dot(axis, v[1]), dot(axis, v[2])};
        const double radius = h * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
        return std::min({p[0], p[1], p[2]}) > radius || std::max({p[0], p[1], p[2]}) < -radius;
    };
    if (isSeparating(cross(edges[0], edges[1]))) return false;
    for (const Vec3d& edge : edges)
        if (isSeparating({0, -edge.z, edge.y}) || isSeparating({edge.z, 0, -edge.x}) ||
            isSeparating({-edge.y, edge.x, 0}))
            return false;
    return true;
}

// Adds, as boxes, the voxels k0..k1 of column (i, j) that the triangle touches within `reach` of their samples.
void addTouched(const std::array<Vec3d, 3>& triangle, double reach, std::int32_t i, std::int32_t j, std::int32_t k0,
                std::int32_t k1, std::uint32_t claim, std::vector<ClaimedBox>& boxes) {
    std::int32_t begin = -1;
    for (std::int32_t k = k0; k <= k1 + 1; ++k) {
        const bool isTouched = k <= k1 && touchesBox(triangle, {double(i), double(j), double(k)}, reach);
        if (isTouched && begin < 0) begin = k;
        if (!isTouched && begin >= 0) {
            boxes.push_back({j, j + 1, i, i + 1, begin, k, claim});
            begin = -1;
        }
    }
}

// A face of a solid, and the material behind it.
struct ThinFace {
    std::array<Vec3d, 3> corners;  // local space
    std::array<Vec3d, 3> edges;    // from each corner to the next, index space
    Vec3d normal;                  // as long as twice its area, index space
    Vec3d inward;                  // to the other side of the material, index space
    int axis;                      // along which the normal is longest
    double chord;                  // samples of material along the axis
};

// Returns false if the material behind the triangle is as thick as a voxel along the dominant axis.
bool findThinFace(const mesh::Triangle& triangle, const std::vector<Vec3d>& vertices,
                  const IndexFromLocal& indexFromLocal, ThinFace& face) {
    const Vec3d a = vertices[triangle.corners[0]], b = vertices[triangle.corners[1]], c = vertices[triangle.corners[2]];
    face.inward = indexFromLocal.direction(-normalized(cross(b - a, c - a)) * double(triangle.thickness));
    const Vec3d ab = indexFromLocal.direction(b - a), ac = indexFromLocal.direction(c - a);
    face.corners = {a, b, c};
    face.edges = {ab, indexFromLocal.direction(c - b), -ac};
    face.normal = cross(ab, ac);
    const Vec3d size{std::abs(face.normal.x), std::abs(face.normal.y), std::abs(face.normal.z)};
    face.axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (!(size[face.axis] > 0)) return false;
    face.chord = std::abs(dot(face.normal, face.inward) / face.normal[face.axis]);
    return !(face.chord >= 1);
}

// A rod: the face is narrower than a voxel, so sample lines may miss it. Draws one line along its longest edge, in the
// middle of the material, one voxel per step of its dominant axis. All faces around a rod give nearly the same line;
// duplicates are skipped.
void addRod(const ThinFace& face, const IndexFromLocal& indexFromLocal, Vec3i dimension, std::uint32_t claim,
            SampleLines& rodLines, std::vector<ClaimedBox>& boxes) {
    std::size_t longest = 0;
    double longestLength = 0;
    for (std::size_t e = 0; e < 3; ++e) {
        const double l = length(face.edges[e]);
        if (l > longestLength) {
            longestLength = l;
            longest = e;
        }
    }
    if (!(longestLength > 0) || length(face.normal) / longestLength >= 1) return;
    const Vec3d from = indexFromLocal.point(face.corners[longest]) + face.inward * 0.5, way = face.edges[longest];
    if (!rodLines.add(nearestSample(from), nearestSample(from + way))) return;
    const double reach = std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
    const int steps = 1 + static_cast<int>(std::min(reach, 1e6));
    for (int s = 0; s <= steps; ++s) addNearest(from + way * (double(s) / steps), dimension, claim, boxes);
}

// The axes along which the normal is longest: usually one; several if they differ only by rounding, which varies
// between the triangles of a face.
std::array<bool, 3> axesAcross(const IndexMesh& mesh, const mesh::Triangle& triangle) {
    std::array<Vec3d, 3> corner;
    for (std::size_t c = 0; c < 3; ++c) {
        const QuantaPoint& q = mesh.points[triangle.corners[c]];
        corner[c] = {double(q[0]), double(q[1]), double(q[2])};
    }
    const Vec3d normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double most = 0.99 * std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
    return {std::abs(normal.x) >= most, std::abs(normal.y) >= most, std::abs(normal.z) >= most};
}

}  // namespace

void addThinSheet(const IndexMesh& mesh, Vec3i dimension, std::uint32_t claim, bool boundsBody,
                  std::vector<ClaimedBox>& boxes) {
    for (const mesh::Triangle& triangle : mesh.mesh->triangles) {
        const std::array<bool, 3> isAlong = axesAcross(mesh, triangle);
        for (const ScanAxes& axes : kScanAxes) {
            if (boundsBody && !isAlong[axes.z]) continue;
            ScanTriangle scan;
            if (!setUpScan(mesh.points[triangle.corners[0]], mesh.points[triangle.corners[1]],
                           mesh.points[triangle.corners[2]], axes, scan))
                continue;
            const std::int32_t behind = scan.sign < 0 ? -1 : 0;  // the face looks up: its back is the sample below
            const std::int32_t count = along(dimension, axes.z);
            scanRows(scan, 0, along(dimension, axes.y), 0, along(dimension, axes.x),
                     [&](std::int32_t row, std::int32_t begin, std::int32_t end) {
                         const std::int64_t base = scan.height.base + scan.height.slopeY * row;
                         addRowOfSamples(axes, row, begin, end, claim, boxes, [&](std::int32_t x) {
                             const std::int32_t above = sampleAbove(scan, base + scan.height.slopeX * x);
                             // At the border of the grid the sample behind may not exist: use the one in front.
                             const std::int32_t sample = above + behind;
                             if (sample == -1 && above == 0) return 0;
                             if (sample == count && above == count) return count - 1;
                             return sample >= 0 && sample < count ? sample : -1;
                         });
                     });
        }
    }
}

void addConservativeSheet(const IndexMesh& mesh, Vec3i dimension, std::uint32_t claim, std::vector<ClaimedBox>& boxes) {
    constexpr double kTouch = 0.5 + 1.0 / double(kQuanta);  // widened by one quantum, so that snapping loses no contact
    for (const mesh::Triangle& triangle : mesh.mesh->triangles) {
        std::array<Vec3d, 3> corner;
        Vec3d low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};
        for (std::size_t c = 0; c < 3; ++c) {
            const QuantaPoint& q = mesh.points[triangle.corners[c]];
            corner[c] = {q[0] / double(kQuanta), q[1] / double(kQuanta), q[2] / double(kQuanta)};
            for (int axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], corner[c][axis]);
                high[axis] = std::max(high[axis], corner[c][axis]);
            }
        }
        const auto first = [&](int axis) {
            return std::max(0, static_cast<std::int32_t>(std::ceil(low[axis] - kTouch)));
        };
        const auto last = [&](int axis) {
            return std::min(dimension[axis] - 1, static_cast<std::int32_t>(std::floor(high[axis] + kTouch)));
        };
        const Vec3d normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
        for (std::int32_t j = first(1); j <= last(1); ++j) {
            for (std::int32_t i = first(0); i <= last(0); ++i) {
                std::int32_t k0 = first(2), k1 = last(2);
                if (std::abs(normal.z) > 1e-9) {
                    // Only samples near the plane can touch the triangle.
                    const double at =
                        corner[0].z - (normal.x * (i - corner[0].x) + normal.y * (j - corner[0].y)) / normal.z;
                    const double reach =
                        kTouch * (1 + (std::abs(normal.x) + std::abs(normal.y)) / std::abs(normal.z)) + 1e-6;
                    k0 = static_cast<std::int32_t>(std::max<double>(k0, std::floor(at - reach)));
                    k1 = static_cast<std::int32_t>(std::min<double>(k1, std::ceil(at + reach)));
                }
                addTouched(corner, kTouch, i, j, k0, k1, claim, boxes);
            }
        }
    }
}

std::uint64_t addThinParts(const IndexMesh& mesh, const IndexFromLocal& indexFromLocal, Vec3i dimension,
                           const ThinClaims& claims, std::vector<ClaimedBox>& boxes) {
    const double widest = indexFromLocal.largestSpacing();
    std::vector<ClaimedBox> raw;
    addThinPlates(mesh, indexFromLocal, dimension, claims, raw);
    SampleLines rodLines;
    const auto& vertices = mesh.mesh->vertices;
    for (const mesh::Triangle& triangle : mesh.mesh->triangles) {
        if (!(triangle.thickness < widest)) continue;  // the material behind this face is thicker than a voxel
        ThinFace face;
        if (!findThinFace(triangle, vertices, indexFromLocal, face)) continue;
        addRod(face, indexFromLocal, dimension, claims.thin, rodLines, raw);
    }
    const auto ties =
        std::stable_partition(raw.begin(), raw.end(), [&](const ClaimedBox& box) { return box.claim == claims.thin; });
    const std::span<const ClaimedBox> all(raw);
    const auto count = static_cast<std::size_t>(ties - raw.begin());
    return addDisjoint(all.first(count), boxes) + addDisjoint(all.subspan(count), boxes);
}

}  // namespace svt::voxelize
