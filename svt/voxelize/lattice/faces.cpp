#include <svt/voxelize/lattice/faces.hpp>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace svt::voxelize {
namespace {

// False if the triangle crosses no sample line within `dimension`.
bool setUpPlan(const QuantaPoint& a, const QuantaPoint& b, const QuantaPoint& c, Vec3i dimension, FaceTriangle& out,
               bool& facesDown) noexcept {
    const QuantaPoint* corners[3] = {&a, &b, &c};
    for (int i = 0; i < 3; ++i) out.y[i] = (*corners[i])[1];
    std::tie(out.firstRow, out.endRow) = std::minmax({out.row(0), out.row(1), out.row(2)});
    if (out.firstRow >= out.endRow || out.endRow <= 0 || out.firstRow >= dimension.y) return false;
    for (int i = 0; i < 3; ++i) out.x[i] = (*corners[i])[0];
    std::tie(out.firstColumn, out.endColumn) = std::minmax({out.column(0), out.column(1), out.column(2)});
    if (out.firstColumn >= out.endColumn || out.endColumn <= 0 || out.firstColumn >= dimension.x) return false;
    const std::int64_t area = (std::int64_t(b[0]) - a[0]) * (std::int64_t(c[1]) - a[1]) -
                              (std::int64_t(b[1]) - a[1]) * (std::int64_t(c[0]) - a[0]);
    if (area == 0) return false;
    facesDown = area < 0;
    return true;
}

// One use of an edge by a triangle; `ends` is the undirected edge.
struct EdgeUse {
    std::uint64_t ends;
    std::uint32_t triangle;
    std::uint8_t edge;
    bool isForward;
};

// Builds the faces of one object; holds its buffers.
struct FaceBuilder {
    const std::vector<mesh::Triangle>& source;
    FaceList& list;
    std::vector<std::uint32_t> numbers;  // source triangles of the current height plane, the last ones of `list`
    std::vector<EdgeUse> uses;
    std::vector<std::uint32_t> partOf;  // per triangle: parent in a union-find, never a higher number
    std::vector<FaceTriangle> unsorted;

    // Ends the current height plane: each edge-connected component of its triangles becomes a face.
    void closeHeightPlane();

private:
    void markInnerEdges(std::span<FaceTriangle> triangles);
    std::uint32_t rootOf(std::uint32_t triangle) {
        while (partOf[triangle] != triangle) triangle = partOf[triangle] = partOf[partOf[triangle]];
        return triangle;
    }
};

// Marks the edges that two triangles use in opposite directions, and unites these triangles.
void FaceBuilder::markInnerEdges(std::span<FaceTriangle> triangles) {
    uses.clear();
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const auto& corners = source[numbers[t]].corners;
        for (std::uint8_t e = 0; e < 3; ++e) {
            const std::uint32_t from = corners[e], to = corners[(e + 1) % 3];
            uses.push_back({std::uint64_t(std::min(from, to)) << 32 | std::max(from, to), t, e, from < to});
        }
    }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& p, const EdgeUse& q) {
        return p.ends != q.ends ? p.ends < q.ends : p.triangle < q.triangle;
    });
    for (std::size_t u = 1; u < uses.size(); ++u) {
        const EdgeUse &p = uses[u - 1], &q = uses[u];
        if (p.ends != q.ends || p.isForward == q.isForward) continue;
        triangles[p.triangle].innerEdges |= static_cast<std::uint8_t>(1u << p.edge);
        triangles[q.triangle].innerEdges |= static_cast<std::uint8_t>(1u << q.edge);
        const std::uint32_t pPart = rootOf(p.triangle), qPart = rootOf(q.triangle);
        partOf[std::max(pPart, qPart)] = std::min(pPart, qPart);
        ++u;
    }
}

void FaceBuilder::closeHeightPlane() {
    const auto count = static_cast<std::uint32_t>(numbers.size());
    if (count >= 2) {
        const auto triangles = std::span(list.triangles).last(count);
        partOf.resize(count);
        std::iota(partOf.begin(), partOf.end(), 0u);
        markInnerEdges(triangles);
        bool isOnePart = true;
        for (std::uint32_t t = 0; t < count; ++t) isOnePart = (partOf[t] = rootOf(t)) == 0 && isOnePart;
        if (!isOnePart) {
            std::iota(numbers.begin(), numbers.end(), 0u);
            std::stable_sort(numbers.begin(), numbers.end(),
                             [&](std::uint32_t p, std::uint32_t q) { return partOf[p] < partOf[q]; });
            unsorted.assign(triangles.begin(), triangles.end());
            for (std::uint32_t t = 0; t < count; ++t) {
                if (t > 0 && partOf[numbers[t]] != partOf[numbers[t - 1]])
                    list.faces.push_back(Boundary(list.faces.back()));
                triangles[t] = unsorted[numbers[t]];
                triangles[t].face = static_cast<std::uint32_t>(list.faces.size() - 1);
            }
        }
    }
    numbers.clear();
}

}  // namespace

bool touchesSamples(const FaceTriangle& t, bool facesDown, std::int32_t firstColumn, std::int32_t firstRow,
                    std::int32_t width, std::int32_t height) noexcept {
    if (t.endColumn <= firstColumn || t.firstColumn >= firstColumn + width || t.endRow <= firstRow ||
        t.firstRow >= firstRow + height)
        return false;
    const auto quanta = [](std::int32_t sample) { return std::int64_t(sample) * kQuanta + 1; };
    const std::int64_t west = quanta(firstColumn), east = quanta(firstColumn + width - 1);
    const std::int64_t south = quanta(firstRow), north = quanta(firstRow + height - 1);
    const std::int64_t turn = facesDown ? -1 : 1;
    // Disjoint where the whole rectangle lies outside one edge. (The bounding boxes are tested above.)
    for (int e = 0; e < 3; ++e) {
        const int to = e == 2 ? 0 : e + 1;
        const std::int64_t dx = turn * (std::int64_t(t.x[to]) - t.x[e]), dy = turn * (std::int64_t(t.y[to]) - t.y[e]);
        const std::int64_t x = dy < 0 ? east : west, y = dx > 0 ? north : south;
        if (dx * (y - t.y[e]) - dy * (x - t.x[e]) < 0) return false;
    }
    return true;
}

FaceList groupCoplanarFaces(const IndexMesh& mesh, std::span<const std::uint32_t> heightPlaneOfPlane, Vec3i dimension,
                            std::uint32_t claim, HeightPlanes& ownHeightPlanes) {
    const auto& triangles = mesh.mesh->triangles;
    FaceList list;
    list.triangles.reserve(triangles.size());
    FaceBuilder builder{triangles, list, {}, {}, {}, {}};
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const mesh::Triangle& triangle = triangles[t];
        const QuantaPoint& a = mesh.points[triangle.corners[0]];
        const QuantaPoint& b = mesh.points[triangle.corners[1]];
        const QuantaPoint& c = mesh.points[triangle.corners[2]];
        FaceTriangle plan;
        Boundary face{kNoHeightPlane, claim, false};
        if (!setUpPlan(a, b, c, dimension, plan, face.isEntry)) continue;
        if (triangle.plane != mesh::kNoPlane && !heightPlaneOfPlane.empty())
            face.heightPlane = heightPlaneOfPlane[triangle.plane];
        if (face.heightPlane == kNoHeightPlane)
            face.heightPlane =
                ownHeightPlanes.add(HeightPlane(triangleHeight(a, b, c, kScanAxes[2]), ownHeightPlanes.depth));
        if (builder.numbers.empty() || face.packed() != list.faces.back().packed()) {
            builder.closeHeightPlane();
            list.faces.push_back(face);
        }
        plan.face = static_cast<std::uint32_t>(list.faces.size() - 1);
        list.triangles.push_back(plan);
        builder.numbers.push_back(t);
    }
    builder.closeHeightPlane();
    return list;
}

}  // namespace svt::voxelize
