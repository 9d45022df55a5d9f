#include <svt/render/camera_presets.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace svt::render {
namespace {

struct Preset {
    std::string_view name;
    Vec3d view;  // from the eye to the centre, in the box's axes
    Vec3d up;
};

// The iso views look down by atan(1 / sqrt 2) = 35.3 degrees along a space diagonal, as in an isometric drawing.
constexpr std::array<Preset, 11> kPresets{{
    {"iso", {-1, 1, -1}, {0, 0, 1}},
    {"iso-se", {-1, 1, -1}, {0, 0, 1}},
    {"iso-sw", {1, 1, -1}, {0, 0, 1}},
    {"iso-ne", {-1, -1, -1}, {0, 0, 1}},
    {"iso-nw", {1, -1, -1}, {0, 0, 1}},
    {"front", {0, 1, 0}, {0, 0, 1}},
    {"back", {0, -1, 0}, {0, 0, 1}},
    {"left", {1, 0, 0}, {0, 0, 1}},
    {"right", {-1, 0, 0}, {0, 0, 1}},
    {"top", {0, 0, -1}, {0, 1, 0}},
    {"bottom", {0, 0, 1}, {0, 1, 0}},
}};

constexpr auto kPresetNames = [] {
    std::array<std::string_view, kPresets.size()> names{};
    for (std::size_t n = 0; n < names.size(); ++n) names[n] = kPresets[n].name;
    return names;
}();

using Axes = std::array<Vec3d, 3>;

Vec3d along(const Axes& axes, Vec3d v) { return axes[0] * v.x + axes[1] * v.y + axes[2] * v.z; }

// The corners of a box of `size` around `middle`.
std::array<Vec3d, 8> cornersOf(Vec3d middle, Vec3d size, const Axes& axes) {
    std::array<Vec3d, 8> corners;
    for (int c = 0; c < 8; ++c)
        corners[static_cast<std::size_t>(c)] =
            middle +
            along(axes, {size.x * ((c & 1) - 0.5), size.y * (((c >> 1) & 1) - 0.5), size.z * ((c >> 2) - 0.5)});
    return corners;
}

// Points in the axes of a camera: x to the right, y up, z away from the viewer.
struct CameraAxes {
    Vec3d right, up, forward;
    [[nodiscard]] Vec3d of(Vec3d p) const { return {dot(p, right), dot(p, up), dot(p, forward)}; }
    [[nodiscard]] Vec3d world(Vec3d p) const { return right * p.x + up * p.y + forward * p.z; }
};

Camera fitted(const Preset& preset, std::span<const Vec3d> points, const Axes& axes, const PresetOptions& options) {
    const Vec3d forward = normalized(along(axes, preset.view));
    const Vec3d right = normalized(cross(forward, along(axes, preset.up)));
    const CameraAxes view{right, cross(right, forward), forward};
    const double free = 1 - 2 * options.margin;
    // Aspect ratio of the picture between the side margins.
    const double aspect = options.aspect * (1 - 2 * std::max(options.margin, options.sideMargin)) / free;
    Camera camera;
    camera.projection = options.projection;
    camera.up = along(axes, preset.up);
    camera.verticalFovDegrees = options.verticalFovDegrees;

    Box3d bounds;  // of the points in the camera's axes, from the first of them
    for (const Vec3d& p : points) bounds.add(view.of(p - points[0]));
    const Vec3d middle = points[0] + view.world(bounds.center());
    const double diagonal = length(bounds.size());
    if (options.projection == Camera::Projection::Orthographic) {
        camera.orthographicHeight = std::max(bounds.size().y, bounds.size().x / aspect) / free;
        camera.target = middle;
        camera.eye = camera.target - forward * diagonal;
        return camera;
    }
    // A point is in view if |x - eyeX| <= tanX * (z - eyeZ), so the bounds of x +- tanX * z decide.
    const double tanY = std::tan(options.verticalFovDegrees * std::numbers::pi / 360) * free;
    const double tanX = tanY * aspect;
    double lowX = 1e300, highX = -1e300, lowY = 1e300, highY = -1e300;
    for (const Vec3d& point : points) {
        const Vec3d p = view.of(point - middle);
        lowX = std::min(lowX, p.x + tanX * p.z);
        highX = std::max(highX, p.x - tanX * p.z);
        lowY = std::min(lowY, p.y + tanY * p.z);
        highY = std::max(highY, p.y - tanY * p.z);
    }
    const double eyeX = (lowX + highX) / 2, eyeY = (lowY + highY) / 2;
    double eyeZ = std::min((lowX - highX) / (2 * tanX), (lowY - highY) / (2 * tanY));
    eyeZ = std::min(eyeZ, -bounds.size().z / 2 - 1e-3 * diagonal);
    camera.target = middle + view.world({eyeX, eyeY, 0});
    camera.eye = middle + view.world({eyeX, eyeY, eyeZ});
    if (eyeZ >= -1e-3 * diagonal) camera.target = camera.eye + forward * diagonal;
    camera.orthographicHeight = 2 * std::abs(eyeZ) * tanY / free;
    return camera;
}

Result<Camera> checkedCamera(const Preset& preset, std::span<const Vec3d> points, const Axes& axes,
                             const PresetOptions& options) {
    if (!(options.aspect > 0) || !std::isfinite(options.aspect) || !(options.margin >= 0 && options.margin <= 0.45) ||
        !(options.sideMargin >= 0 && options.sideMargin <= 0.45) ||
        !(options.verticalFovDegrees > 0 && options.verticalFovDegrees < 180))
        return Error(Code::BadCamera,
                     "aspect must be greater than 0, margins 0 to 0.45, the field of view between 0 and "
                     "180 degrees");
    Box3d bounds;
    for (const Vec3d& p : points)
        if (isFinite(p)) bounds.add(p);
    if (points.empty() || !std::all_of(points.begin(), points.end(), isFinite) || !(length(bounds.size()) > 0))
        return Error(Code::BadCamera, "the box to show is empty");
    return fitted(preset, points, axes, options);
}

Result<Camera> presetCamera(std::string_view name, std::span<const Vec3d> points, const Axes& axes,
                            const PresetOptions& options) {
    const auto preset = std::find_if(kPresets.begin(), kPresets.end(), [&](const Preset& p) { return p.name == name; });
    if (preset == kPresets.end())
        return Error(Code::BadCamera,
                     fmt::format("there is no camera '{}'; possible are {}", name, fmt::join(kPresetNames, ", ")));
    return checkedCamera(*preset, points, axes, options);
}

constexpr Axes kWorldAxes{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};

}  // namespace

std::span<const std::string_view> cameraPresetNames() noexcept { return kPresetNames; }

Result<Camera> cameraPreset(std::string_view name, const Box3d& bounds, const PresetOptions& options) {
    return presetCamera(name, cornersOf(bounds.center(), bounds.size(), kWorldAxes), kWorldAxes, options);
}

Result<Camera> cameraPreset(std::string_view name, const volume::Grid& grid, const PresetOptions& options) {
    const Vec3i n = grid.dimension();
    const Vec3d spacing = grid.spacing();
    const Vec3d middle = grid.worldFromIndex({(n.x - 1) / 2.0, (n.y - 1) / 2.0, (n.z - 1) / 2.0});
    const auto corners = cornersOf(middle, {n.x * spacing.x, n.y * spacing.y, n.z * spacing.z}, grid.axes());
    return presetCamera(name, corners, grid.axes(), options);
}

Result<Camera> cameraPreset(std::string_view name, std::span<const Vec3d> points, const std::array<Vec3d, 3>& axes,
                            const PresetOptions& options) {
    return presetCamera(name, points, axes, options);
}

Result<Camera> cameraAlong(Vec3d view, Vec3d up, const Box3d& bounds, const PresetOptions& options) {
    if (!isFinite(view) || !isFinite(up) || !(length(cross(view, up)) > 1e-9 * length(view) * length(up)))
        return Error(Code::BadCamera, "the view direction is zero, not finite or along up");
    return checkedCamera({"", view, up}, cornersOf(bounds.center(), bounds.size(), kWorldAxes), kWorldAxes, options);
}

}  // namespace svt::render
