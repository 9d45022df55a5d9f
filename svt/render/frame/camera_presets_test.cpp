#include <svt/render/camera_presets.hpp>
#include <svt/render/camera_rays.hpp>

#include <gtest/gtest.h>

namespace svt::render {
namespace {

const Box3d kHouse{{100, 200, 10}, {112, 208, 17}};

// The largest of |u| and |v| over the corners of the box.
double reach(const Camera& camera, const Box3d& box, std::int32_t width, std::int32_t height) {
    FrameSpec spec;
    spec.width = width;
    spec.height = height;
    spec.camera = camera;
    EXPECT_TRUE(checkFrameSpec(spec).hasValue());
    const CameraRays rays(spec, *volume::Grid::fromDimension(box, {2, 2, 2}));
    double most = 0;
    for (int c = 0; c < 8; ++c) {
        const Vec3d p{(c & 1) ? box.max.x : box.min.x, (c & 2) ? box.max.y : box.min.y,
                      (c & 4) ? box.max.z : box.min.z};
        const Vec3d seen = rays.seenAt(p - camera.eye);
        EXPECT_GT(seen.z, 0);
        most = std::max({most, std::abs(seen.x), std::abs(seen.y)});
    }
    return most;
}

TEST(CameraPreset, AnyDirectionShowsTheWholeBoxAndIsThatOfThePreset) {
    for (const auto projection : {Camera::Projection::Perspective, Camera::Projection::Orthographic}) {
        PresetOptions options;
        options.projection = projection;
        const auto camera = cameraAlong({0.3, 1.7, -0.4}, {0, 0, 1}, kHouse, options);
        ASSERT_TRUE(camera.hasValue());
        EXPECT_NEAR(reach(*camera, kHouse, 1280, 720), 1 - 2 * options.margin, 1e-6);
        const Vec3d view = normalized(camera->target - camera->eye);
        EXPECT_LT(length(view - normalized(Vec3d{0.3, 1.7, -0.4})), 1e-12);
        EXPECT_EQ(*cameraAlong({0, 1, 0}, {0, 0, 1}, kHouse, options), *cameraPreset("front", kHouse, options));
    }
    EXPECT_EQ(cameraAlong({0, 0, -2}, {0, 0, 1}, kHouse).error().code(), Code::BadCamera);
    EXPECT_EQ(cameraAlong({0, 0, 0}, {0, 0, 1}, kHouse).error().code(), Code::BadCamera);
}

TEST(CameraPreset, EveryViewShowsTheWholeBoxAndFillsThePicture) {
    for (const std::string_view name : cameraPresetNames())
        for (const auto projection : {Camera::Projection::Perspective, Camera::Projection::Orthographic})
            for (const auto& [width, height] : {std::pair{1280, 720}, std::pair{300, 900}}) {
                PresetOptions options;
                options.aspect = double(width) / height;
                options.projection = projection;
                const auto camera = cameraPreset(name, kHouse, options);
                ASSERT_TRUE(camera.hasValue()) << name;
                EXPECT_NEAR(reach(*camera, kHouse, width, height), 1 - 2 * options.margin, 1e-6) << name;
            }
}

TEST(CameraPreset, SidesAreWhereTheirNamesSay) {
    const auto eyeOf = [](std::string_view name) {
        const Camera camera = *cameraPreset(name, kHouse);
        return normalized(camera.eye - camera.target);
    };
    EXPECT_NEAR(eyeOf("front").y, -1, 1e-12);
    EXPECT_NEAR(eyeOf("back").y, 1, 1e-12);
    EXPECT_NEAR(eyeOf("left").x, -1, 1e-12);
    EXPECT_NEAR(eyeOf("right").x, 1, 1e-12);
    EXPECT_NEAR(eyeOf("top").z, 1, 1e-12);
    EXPECT_NEAR(eyeOf("bottom").z, -1, 1e-12);
    const Vec3d iso = eyeOf("iso");
    EXPECT_NEAR(iso.x, std::sqrt(1.0 / 3), 1e-12);
    EXPECT_NEAR(iso.y, -std::sqrt(1.0 / 3), 1e-12);
    EXPECT_NEAR(iso.z, std::sqrt(1.0 / 3), 1e-12);
    EXPECT_EQ(*cameraPreset("iso", kHouse), *cameraPreset("iso-se", kHouse));
    EXPECT_LT(eyeOf("iso-sw").x, 0);
    EXPECT_GT(eyeOf("iso-ne").y, 0);
}

TEST(CameraPreset, ATurnedGridIsSeenSquareOn) {
    const double c = std::cos(0.5), s = std::sin(0.5);
    const auto grid =
        volume::Grid::fromParts({11, 21, 31}, {1, 1, 1}, {5, 6, 7}, {Vec3d{c, s, 0}, Vec3d{-s, c, 0}, Vec3d{0, 0, 1}});
    const Camera camera = *cameraPreset("front", *grid);
    const Vec3d view = normalized(camera.target - camera.eye);
    EXPECT_NEAR(dot(view, grid->axes()[1]), 1, 1e-12);
}

TEST(CameraPreset, WrongArgumentsAreBadCameras) {
    const auto unknown = cameraPreset("isometric", kHouse);
    ASSERT_FALSE(unknown.hasValue());
    EXPECT_EQ(unknown.error().code(), Code::BadCamera);
    EXPECT_NE(unknown.error().message().find("iso-sw"), std::string::npos);
    EXPECT_EQ(cameraPreset("top", Box3d{}).error().code(), Code::BadCamera);
    PresetOptions options;
    options.aspect = 0;
    EXPECT_EQ(cameraPreset("top", kHouse, options).error().code(), Code::BadCamera);
    options = {};
    options.margin = 0.5;
    EXPECT_EQ(cameraPreset("top", kHouse, options).error().code(), Code::BadCamera);
}

}  // namespace
}  // namespace svt::render
