#pragma once
/// \file
/// Planes on which tests compare drawings with meshes.

#include <svt/drawing/section_drawing.hpp>

#include <vector>

namespace svt::test {

/// Nine planes parallel to the axes: three across each.
inline std::vector<drawing::SectionPlane> axisPlanesThrough(const volume::Grid& grid) {
    const Vec3d size = scaled(toDouble(grid.dimension() - Vec3i{1, 1, 1}), grid.spacing());
    std::vector<drawing::SectionPlane> planes;
    for (int axis = 0; axis < 3; ++axis)
        for (const double part : {0.2137, 0.4871, 0.7529}) {
            Vec3d normal;
            normal[axis] = axis == 1 ? -1 : 1;
            planes.push_back({normal, grid.origin() + size * part});
        }
    return planes;
}

}  // namespace svt::test
