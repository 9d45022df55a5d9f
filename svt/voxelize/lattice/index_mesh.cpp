#include <svt/voxelize/lattice/index_mesh.hpp>

#include <algorithm>
#include <cmath>

namespace svt::voxelize {

IndexFromLocal::IndexFromLocal(const mesh::MeshSet& meshes, const volume::Grid& grid) {
    const Vec3d shift = meshes.origin - grid.origin();
    for (int axis = 0; axis < 3; ++axis) {
        rows_[std::size_t(axis)] = grid.axes()[std::size_t(axis)] / grid.spacing()[axis];
        offset_[axis] = dot(grid.axes()[std::size_t(axis)], shift) / grid.spacing()[axis];
    }
    largestSpacing_ = std::max({grid.spacing().x, grid.spacing().y, grid.spacing().z});
    keepsVertical_ = grid.axes()[2] == Vec3d{0, 0, 1};
}

QuantaPoint IndexFromLocal::quanta(Vec3d local) const noexcept {
    constexpr double kFarthest = double(1 << 28);
    const Vec3d index = point(local);
    QuantaPoint snapped;
    for (int axis = 0; axis < 3; ++axis)
        snapped[std::size_t(axis)] = 2 * static_cast<std::int32_t>(std::lrint(std::clamp(
                                             index[axis] * (double(kQuanta) / 2), -kFarthest / 2, kFarthest / 2)));
    return snapped;
}

mesh::Plane IndexFromLocal::plane(const mesh::Plane& local) const noexcept {
    // Map three points of the plane; this works for any rotation about z.
    const auto on = [&](double x, double y) {
        return point({x, y, local.slopeX * x + local.slopeY * y + local.offset});
    };
    const Vec3d p = on(0, 0), q = on(1, 0), r = on(0, 1);
    const double ax = q.x - p.x, ay = q.y - p.y, az = q.z - p.z;
    const double bx = r.x - p.x, by = r.y - p.y, bz = r.z - p.z;
    const double determinant = ax * by - ay * bx;
    mesh::Plane plane;
    plane.slopeX = (az * by - ay * bz) / determinant * double(kQuanta);
    plane.slopeY = (ax * bz - az * bx) / determinant * double(kQuanta);
    plane.offset = p.z * double(kQuanta) - plane.slopeX * p.x - plane.slopeY * p.y;
    return plane;
}

IndexMesh makeIndexMesh(const mesh::ObjectMesh& mesh, const IndexFromLocal& indexFromLocal) {
    IndexMesh result;
    result.mesh = &mesh;
    result.points.reserve(mesh.vertices.size());
    for (const Vec3d& vertex : mesh.vertices) result.points.push_back(indexFromLocal.quanta(vertex));
    return result;
}

}  // namespace svt::voxelize
