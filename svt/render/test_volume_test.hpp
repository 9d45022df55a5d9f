#pragma once
/// \file
/// Small volumes and frames that the tests of this folder draw.

#include <svt/render/camera_presets.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace svt::render::test {

using LabelAt = std::function<volume::Scalar(std::int32_t, std::int32_t, std::int32_t)>;

/// A volume and its grid.
struct TestVolume {
    volume::ColumnVolume columns;
    volume::BrickVolume bricks;
    volume::Grid grid;
};

/// Sample (i, j, k) has `labelAt(i, j, k)`; voxel (0, 0, 0) begins at the origin and has `spacing` metres.
inline TestVolume makeVolume(Vec3i n, Vec3d spacing, const LabelAt& labelAt) {
    TestVolume volume;
    volume.columns = volume::test::paintedColumns(n, labelAt);
    volume.bricks = *volume::BrickVolume::fromColumns(volume.columns);
    volume.grid = *volume::Grid::fromParts(n, spacing, spacing * 0.5, volume::test::kWorldAxes);
    return volume;
}

/// Label 1 where isInside(centre of the voxel, metres); 0 elsewhere.
inline TestVolume makeBody(Vec3i n, Vec3d spacing, const std::function<bool(Vec3d)>& isInside) {
    return makeVolume(n, spacing, [&](std::int32_t i, std::int32_t j, std::int32_t k) {
        return isInside({(i + 0.5) * spacing.x, (j + 0.5) * spacing.y, (k + 0.5) * spacing.z}) ? 1u : 0u;
    });
}

inline constexpr double kTurn = 0.52;

/// A house rotated in plan, with walls, slab, roof and two rooms. Voxels are not cubes.
inline volume::Scalar turnedHouse(double i, double j, double k) {
    const double c = std::cos(kTurn), s = std::sin(kTurn);
    const double x = c * (i - 48) + s * (j - 48), y = c * (j - 48) - s * (i - 48);
    if (std::abs(x) > 34 || std::abs(y) > 26 || k < 3) return 0;
    if (k > 66 - 0.9 * std::abs(y)) return 0;
    if (k > 60 - 0.9 * std::abs(y)) return 1;
    if (std::abs(x) > 28 || std::abs(y) > 20) return 2;
    if (k >= 30 && k < 36) return 3;
    return x < 4 ? 4 : x < 9 ? 2 : 5;
}

inline TestVolume makeTurnedHouse() {
    return makeVolume({96, 96, 72}, {0.1, 0.11, 0.09},
                      [](std::int32_t i, std::int32_t j, std::int32_t k) { return turnedHouse(i, j, k); });
}

/// Scalar 0 hidden, the others as given.
inline std::vector<Style> stylesOf(std::vector<Style> styles) {
    styles.insert(styles.begin(), Style{{0, 0, 0}, 0});
    return styles;
}

/// One pass; one of the named views.
inline FrameSpec presetFrame(std::int32_t width, std::int32_t height, const char* name, const TestVolume& volume,
                             std::vector<Style> styles) {
    FrameSpec spec;
    spec.width = width;
    spec.height = height;
    PresetOptions preset;
    preset.aspect = double(width) / height;
    spec.camera = *cameraPreset(name, volume.grid, preset);
    spec.passes.push_back({std::move(styles), {}, Pass::Join::Over});
    return spec;
}

/// One pass; the camera looks along +y, orthographic, at `target`, showing `height` metres.
inline FrameSpec frontFrame(std::int32_t width, std::int32_t height, Vec3d target, double metres,
                            std::vector<Style> styles) {
    FrameSpec spec;
    spec.width = width;
    spec.height = height;
    spec.camera.projection = Camera::Projection::Orthographic;
    spec.camera.eye = target - Vec3d{0, 100, 0};
    spec.camera.target = target;
    spec.camera.orthographicHeight = metres;
    spec.passes.push_back({std::move(styles), {}, Pass::Join::Over});
    return spec;
}

inline Frame cast(const TestVolume& volume, const FrameSpec& spec, const CastOptions& options = {}) {
    auto frame = castRays(volume.bricks, volume.grid, spec, options);
    EXPECT_TRUE(frame.hasValue()) << (frame ? "" : frame.error().toString());
    return frame ? std::move(*frame) : Frame{};
}

inline std::size_t countLabel(const Frame& frame, volume::Scalar label) {
    std::size_t count = 0;
    for (const volume::Scalar pixel : frame.label.pixels()) count += pixel == label;
    return count;
}

}  // namespace svt::render::test
