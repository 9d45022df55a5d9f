#include <svt/analyze/overlaps/solid_clips.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>

namespace svt::analyze {
namespace {

using MeshTriangle = volume::VectorParts::Triangle;

std::array<Vec3d, 3> cornersOf(const MeshTriangle& triangle, const volume::VectorParts& parts, Vec3d offset) {
    return {parts.position(triangle.corners[0], offset), parts.position(triangle.corners[1], offset),
            parts.position(triangle.corners[2], offset)};
}

Box3d boxOfCorners(const std::array<Vec3d, 3>& corners) {
    Box3d box;
    for (const Vec3d& corner : corners) box.add(corner);
    return box;
}

}  // namespace

namespace {

// Whether a mesh encloses the volume that its label states. A mesh whose parts overlap encloses more, or the label states none: the mesh would count their common
// space twice.
bool enclosesOnce(const MeshSolid& solid, const volume::SemanticVolume& volume) {
    const volume::Label& label = volume.labels.labels[solid.label];
    if (!(label.volume > 0)) return false;
    double enclosed = 0, area = 0;
    for (const MeshTriangle& triangle : solid.triangles) {
        const std::array<Vec3d, 3> c = cornersOf(triangle, volume.vectors, solid.offset);
        const Vec3d a = c[0] - solid.box.min, b = c[1] - solid.box.min, d = c[2] - solid.box.min;
        enclosed += dot(a, cross(b, d)) / 6;
        area += length(cross(b - a, d - a)) / 2;
    }
    return volume::enclosesStatedVolume(label, enclosed, area, volume.vectors.unit);
}

}  // namespace

std::vector<MeshSolid> meshSolids(const volume::SemanticVolume& volume, Vec3d offset) {
    std::vector<MeshSolid> solids;
    const std::span<const MeshTriangle> all = volume.vectors.triangles;
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
        while (end < all.size() && all[end].label == all[begin].label) ++end;
        MeshSolid solid{all[begin].label, all.subspan(begin, end - begin), {}, offset};
        if (!volume::hasClosedMesh(volume.labels.labels[solid.label].filling)) continue;
        for (const MeshTriangle& triangle : solid.triangles)
            solid.box.add(boxOfCorners(cornersOf(triangle, volume.vectors, offset)));
        if (enclosesOnce(solid, volume)) solids.push_back(solid);
    }
    return solids;
}

Box3d commonBox(const Box3d& a, const Box3d& b) {
    const Box3d box{{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y), std::max(a.min.z, b.min.z)},
                    {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y), std::min(a.max.z, b.max.z)}};
    const bool hasVolume = box.min.x < box.max.x && box.min.y < box.max.y && box.min.z < box.max.z;
    return hasVolume ? box : Box3d{};
}

SolidClip clipSolid(const MeshSolid& solid, const volume::VectorParts& parts, const Box3d& box) {
    SolidClip clip;
    // The rounding of corners may move each side of the box. No plane cuts more out of it.
    const Vec3d size = box.size() + Vec3d{1, 1, 1} * (2 * parts.unit);
    const double largest = length(Vec3d{size.x * size.y, size.y * size.z, size.z * size.x});
    for (const MeshTriangle& triangle : solid.triangles) {
        const std::array<Vec3d, 3> corners = cornersOf(triangle, parts, solid.offset);
        const Box3d of = boxOfCorners(corners);
        if (of.max.x < box.min.x || of.min.x > box.max.x || of.max.y < box.min.y || of.min.y > box.max.y) continue;
        plane::RoofTriangle roof;
        if (plane::makeRoofTriangle(corners, roof)) clip.roofs.push_back(roof);
        clip.lowest = std::min(clip.lowest, of.min.z);
        if (of.max.z < box.min.z || of.min.z > box.max.z) continue;
        clip.area += std::min(0.5 * length(cross(corners[1] - corners[0], corners[2] - corners[0])), largest);
    }
    std::sort(clip.roofs.begin(), clip.roofs.end(), [](const plane::RoofTriangle& s, const plane::RoofTriangle& t) {
        return std::tie(s.minX, s.minY, s.maxX, s.maxY) < std::tie(t.minX, t.minY, t.maxX, t.maxY);
    });
    return clip;
}

double boundOfCommonVolume(double area, double unit, const Box3d& box, double lowest) {
    constexpr double kRoundingOfSum = 1e-9;
    const Vec3d size = box.size();
    return area * unit + kRoundingOfSum * size.x * size.y * std::max(0.0, box.max.z - std::min(lowest, box.min.z));
}

}  // namespace svt::analyze
