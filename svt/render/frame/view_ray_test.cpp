#include <svt/render/camera_presets.hpp>
#include <svt/render/view_ray.hpp>

#include <gtest/gtest.h>

namespace svt::render {
namespace {

const volume::Grid kGrid =
    *volume::Grid::fromParts({4, 4, 4}, {1, 1, 1}, {100, 200, 10}, {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});

TEST(ViewRay, LeadsToWhatIsSeen) {
    FrameSpec spec;
    spec.width = 200;
    spec.height = 100;
    spec.camera.eye = {100, 190, 12};
    spec.camera.target = {100, 200, 12};
    spec.camera.verticalFovDegrees = 90;
    const ViewRay middle = viewRay(spec, kGrid, 0.5, 0.5);
    EXPECT_LT(length(middle.origin + middle.direction * 10 - spec.camera.target), 1e-12);
    // The half height is the depth, the half width twice that: the upper left corner at a depth of 10.
    const ViewRay corner = viewRay(spec, kGrid, 0, 0);
    EXPECT_LT(length(corner.origin + corner.direction * 10 - Vec3d{80, 200, 22}), 1e-9);

    spec.camera.projection = Camera::Projection::Orthographic;
    spec.camera.orthographicHeight = 4;
    const ViewRay aside = viewRay(spec, kGrid, 1, 1);
    EXPECT_LT(length(aside.origin - Vec3d{104, 190, 10}), 1e-12);
    EXPECT_LT(length(aside.direction - Vec3d{0, 1, 0}), 1e-12);
}

}  // namespace
}  // namespace svt::render
