#include <svt/voxelize/faces.hpp>

#include <algorithm>
#include <limits>

namespace svt::voxelize {
namespace {

// False where the triangle crosses no sample line within `dimension`.
bool setUpPlan(const QuantaPoint& a, const QuantaPoint& b, const QuantaPoint& c, Vec3i dimension, FaceTriangle& out,
               std::int8_t& sign) noexcept {
    const auto [lowY, highY] = std::minmax({a[1], b[1], c[1]});
    out.firstRow = static_cast<std::int32_t>(firstSampleAbove(lowY));
    out.endRow = static_cast<std::int32_t>(firstSampleAbove(highY));
    if (out.firstRow >= out.endRow || out.endRow <= 0 || out.firstRow >= dimension.y) return false;
    const auto [lowX, highX] = std::minmax({a[0], b[0], c[0]});
    out.firstColumn = static_cast<std::int32_t>(firstSampleAbove(lowX));
    out.endColumn = static_cast<std::int32_t>(firstSampleAbove(highX));
    if (out.firstColumn >= out.endColumn || out.endColumn <= 0 || out.firstColumn >= dimension.x) return false;
    const std::int64_t area = (std::int64_t(b[0]) - a[0]) * (std::int64_t(c[1]) - a[1]) -
                              (std::int64_t(b[1]) - a[1]) * (std::int64_t(c[0]) - a[0]);
    if (area == 0) return false;
    sign = area > 0 ? -1 : 1;
    const QuantaPoint* corners[3] = {&a, &b, &c};
    for (int i = 0; i < 3; ++i) {
        out.x[i] = (*corners[i])[0];
        out.y[i] = (*corners[i])[1];
    }
    return true;
}

// What tells that two triangles lie on one plane, whose heights are then the same to the bit.
struct Level {
    enum class Kind : std::uint8_t { Plane, Flat, Alone } kind = Kind::Alone;
    std::int8_t sign = 0;
    std::uint32_t value = 0;  // plane or height
    friend bool operator==(const Level& p, const Level& q) noexcept {
        return p.kind == q.kind && p.kind != Kind::Alone && p.sign == q.sign && p.value == q.value;
    }
};

// An edge of a face, told apart by its ends.
struct EdgeUse {
    std::uint64_t ends;
    std::uint32_t triangle;
    std::uint8_t edge;
    bool isForward;
};

// Marks the edges that two triangles of a face use in opposite directions.
void markInnerEdges(std::span<FaceTriangle> face, std::span<const std::uint32_t> sources,
                    const std::vector<mesh::Triangle>& triangles, std::vector<EdgeUse>& uses) {
    if (face.size() < 2) return;
    uses.clear();
    for (std::uint32_t t = 0; t < face.size(); ++t) {
        const auto& corners = triangles[sources[t]].corners;
        for (std::uint8_t e = 0; e < 3; ++e) {
            const std::uint32_t from = corners[e], to = corners[(e + 1) % 3];
            uses.push_back({std::uint64_t(std::min(from, to)) << 32 | std::max(from, to), t, e, from < to});
        }
    }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& p, const EdgeUse& q) {
        return p.ends != q.ends ? p.ends < q.ends : p.triangle < q.triangle;
    });
    for (std::size_t u = 1; u < uses.size(); ++u) {
        if (uses[u - 1].ends != uses[u].ends || uses[u - 1].isForward == uses[u].isForward) continue;
        face[uses[u - 1].triangle].innerEdges |= static_cast<std::uint8_t>(1u << uses[u - 1].edge);
        face[uses[u].triangle].innerEdges |= static_cast<std::uint8_t>(1u << uses[u].edge);
        ++u;
    }
}

}  // namespace

void FaceList::append(const FaceList& other) {
    const auto firstFace = static_cast<std::uint32_t>(faces.size());
    faces.insert(faces.end(), other.faces.begin(), other.faces.end());
    for (FaceTriangle triangle : other.triangles) {
        triangle.face += firstFace;
        triangles.push_back(triangle);
    }
}

void addFaces(const IndexMesh& mesh, std::span<const mesh::Plane> planes, Vec3i dimension, std::uint32_t claim,
              FaceList& list) {
    const auto& triangles = mesh.mesh->triangles;
    std::vector<std::uint32_t> sources;  // of the current face's triangles
    std::vector<EdgeUse> uses;
    Level current;
    const auto closeFace = [&] {
        markInnerEdges(std::span(list.triangles).last(sources.size()), sources, triangles, uses);
        sources.clear();
    };
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const mesh::Triangle& triangle = triangles[t];
        const QuantaPoint& a = mesh.points[triangle.corners[0]];
        const QuantaPoint& b = mesh.points[triangle.corners[1]];
        const QuantaPoint& c = mesh.points[triangle.corners[2]];
        FaceTriangle plan;
        Level level;
        if (!setUpPlan(a, b, c, dimension, plan, level.sign)) continue;
        const mesh::Plane* plane =
            triangle.plane != mesh::kNoPlane && !planes.empty() ? &planes[triangle.plane] : nullptr;
        if (plane != nullptr && isScanPlane(*plane)) {
            level.kind = Level::Kind::Plane;
            level.value = triangle.plane;
        } else if (a[2] == b[2] && a[2] == c[2]) {
            level.kind = Level::Kind::Flat;
            level.value = static_cast<std::uint32_t>(a[2]);
        }
        if (!(level == current)) {
            closeFace();
            current = level;
            list.faces.push_back({faceHeight(a, b, c, kScanAxes[2], plane), claim, level.sign});
        }
        plan.face = static_cast<std::uint32_t>(list.faces.size() - 1);
        list.triangles.push_back(plan);
        sources.push_back(t);
    }
    closeFace();
}

}  // namespace svt::voxelize
