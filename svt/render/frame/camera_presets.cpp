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

// Corner c, 0..7, of a box of `size`, relative to its centre.
Vec3d corner(int c, Vec3d size) {
    return {size.x * ((c & 1) - 0.5), size.y * (((c >> 1) & 1) - 0.5), size.z * ((c >> 2) - 0.5)};
}

Camera fitted(const Preset& preset, Vec3d middle, Vec3d size, const Axes& axes, const PresetOptions& options) {
    const Vec3d forward = normalized(along(axes, preset.view));
    const Vec3d right = normalized(cross(forward, along(axes, preset.up))), up = cross(right, forward);
    const double diagonal = length(size), free = 1 - 2 * options.margin;
    Camera camera;
    camera.projection = options.projection;
    camera.up = along(axes, preset.up);
    camera.verticalFovDegrees = options.verticalFovDegrees;

    // Bounds of the corners along the camera's axes: they are centred in the picture.
    const double tanY = std::tan(options.verticalFovDegrees * std::numbers::pi / 360) * free;
    const double tanX = tanY * options.aspect;
    double minX = 1e300, maxX = -1e300, minY = 1e300, maxY = -1e300;
    double lowX = 1e300, highX = -1e300, lowY = 1e300, highY = -1e300, nearest = 1e300;
    for (int c = 0; c < 8; ++c) {
        const Vec3d p = along(axes, corner(c, size));
        const double x = dot(p, right), y = dot(p, up), z = dot(p, forward);
        minX = std::min(minX, x);
        maxX = std::max(maxX, x);
        minY = std::min(minY, y);
        maxY = std::max(maxY, y);
        // Perspective: a corner is in view if |x - eyeX| <= tanX * (z - eyeZ), so the bounds of x +- tanX * z decide.
        lowX = std::min(lowX, x + tanX * z);
        highX = std::max(highX, x - tanX * z);
        lowY = std::min(lowY, y + tanY * z);
        highY = std::max(highY, y - tanY * z);
        nearest = std::min(nearest, z);
    }
    if (options.projection == Camera::Projection::Orthographic) {
        camera.orthographicHeight = std::max(maxY - minY, (maxX - minX) / options.aspect) / free;
        camera.target = middle + right * ((minX + maxX) / 2) + up * ((minY + maxY) / 2);
        camera.eye = camera.target - forward * diagonal;
        return camera;
    }
    const double eyeX = (lowX + highX) / 2, eyeY = (lowY + highY) / 2;
    double eyeZ = std::min((lowX - highX) / (2 * tanX), (lowY - highY) / (2 * tanY));
    eyeZ = std::min(eyeZ, nearest - 1e-3 * diagonal);
    camera.eye = middle + right * eyeX + up * eyeY + forward * eyeZ;
    camera.target = middle + right * eyeX + up * eyeY;
    if (eyeZ >= -1e-3 * diagonal) camera.target = camera.eye + forward * diagonal;
    camera.orthographicHeight = 2 * std::abs(eyeZ) * tanY / free;
    return camera;
}

Result<Camera> checkedCamera(const Preset& preset, Vec3d middle, Vec3d size, const Axes& axes,
                             const PresetOptions& options) {
    if (!(options.aspect > 0) || !std::isfinite(options.aspect) || !(options.margin >= 0 && options.margin <= 0.45) ||
        !(options.verticalFovDegrees > 0 && options.verticalFovDegrees < 180))
        return Error(Code::BadCamera,
                     "aspect must be greater than 0, the margin 0 to 0.45, the field of view between 0 and "
                     "180 degrees");
    if (!isFinite(middle) || !isFinite(size) || !(length(size) > 0))
        return Error(Code::BadCamera, "the box to show is empty");
    return fitted(preset, middle, size, axes, options);
}

Result<Camera> presetCamera(std::string_view name, Vec3d middle, Vec3d size, const Axes& axes,
                            const PresetOptions& options) {
    const auto preset = std::find_if(kPresets.begin(), kPresets.end(), [&](const Preset& p) { return p.name == name; });
    if (preset == kPresets.end())
        return Error(Code::BadCamera,
                     fmt::format("there is no camera '{}'; possible are {}", name, fmt::join(kPresetNames, ", ")));
    return checkedCamera(*preset, middle, size, axes, options);
}

constexpr Axes kWorldAxes{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};

}  // namespace

std::span<const std::string_view> cameraPresetNames() noexcept { return kPresetNames; }

Result<Camera> cameraPreset(std::string_view name, const Box3d& bounds, const PresetOptions& options) {
    return presetCamera(name, bounds.center(), bounds.size(), kWorldAxes, options);
}

Result<Camera> cameraPreset(std::string_view name, const volume::Grid& grid, const PresetOptions& options) {
    const Vec3i n = grid.dimension();
    const Vec3d spacing = grid.spacing();
    const Vec3d middle = grid.worldFromIndex({(n.x - 1) / 2.0, (n.y - 1) / 2.0, (n.z - 1) / 2.0});
    return presetCamera(name, middle, {n.x * spacing.x, n.y * spacing.y, n.z * spacing.z}, grid.axes(), options);
}

Result<Camera> cameraAlong(Vec3d view, Vec3d up, const Box3d& bounds, const PresetOptions& options) {
    if (!isFinite(view) || !isFinite(up) || !(length(cross(view, up)) > 1e-9 * length(view) * length(up)))
        return Error(Code::BadCamera, "the view direction is zero, not finite or along up");
    return checkedCamera({"", view, up}, bounds.center(), bounds.size(), kWorldAxes, options);
}

}  // namespace svt::render
