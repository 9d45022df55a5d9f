#pragma once
/// \file
/// Named camera views that show a whole volume: the values of `--camera`.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/volume/grid.hpp>

#include <array>
#include <span>
#include <string_view>

namespace svt::render {

struct PresetOptions {
    double aspect = 16.0 / 9;  ///< width / height of the picture, > 0
    double margin = 0.04;      ///< free margin on each side, as a share of the picture's width and height, 0 to 0.45
    Camera::Projection projection = Camera::Projection::Perspective;
    double verticalFovDegrees = 30;  ///< perspective
    double sideMargin = 0;           ///< minimum free margin at left and right, as a share of the width, 0 to 0.45
};

/// All names: "iso" (from the south-east, above), "iso-se" (the same), "iso-sw", "iso-ne", "iso-nw", "front" (from
/// the south), "back", "left" (from the west), "right", "top" (north is up), "bottom".
[[nodiscard]] std::span<const std::string_view> cameraPresetNames() noexcept;

/// A camera that shows all of `bounds` from the named side, as large as possible.
/// \param bounds  world space, x east, y north, z up, metres
/// \return the camera, or BadCamera if the name is unknown (the message lists all names), the box is empty or an option
///         is out of range
[[nodiscard]] Result<Camera> cameraPreset(std::string_view name, const Box3d& bounds,
                                          const PresetOptions& options = {});

/// The same for a grid: sides are those of the grid's own axes, so a rotated building is seen face on.
[[nodiscard]] Result<Camera> cameraPreset(std::string_view name, const volume::Grid& grid,
                                          const PresetOptions& options = {});

/// The same for points, with the sides of `axes`: all points are shown, and the outermost ones touch the margin.
/// \param points  world space; BadCamera if there are none, or all are equal
/// \param axes    unit vectors at right angles, as those of a grid
[[nodiscard]] Result<Camera> cameraPreset(std::string_view name, std::span<const Vec3d> points,
                                          const std::array<Vec3d, 3>& axes, const PresetOptions& options = {});

/// A camera that shows all of `bounds`, looking along `view`.
/// \param view  world space, any length but zero
/// \param up    world space; not parallel to `view`
/// \return the camera, or BadCamera if `view` and `up` are parallel or zero, the box is empty or an option is out of
///         range
[[nodiscard]] Result<Camera> cameraAlong(Vec3d view, Vec3d up, const Box3d& bounds, const PresetOptions& options = {});

}  // namespace svt::render
