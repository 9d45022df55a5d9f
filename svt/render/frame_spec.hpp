#pragma once
/// \file
/// Description of a frame, as plain data: camera, light, background, and ordered passes, each with styles and clips.
/// World space is the volume's, in metres. Sections, lenses and highlights are composed of these parts.

#include <svt/core/names.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/render/clip_region.hpp>
#include <svt/render/hatch.hpp>
#include <svt/render/shapes.hpp>
#include <svt/volume/column_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::render {

/// The camera. The eye plane (through `eye`, perpendicular to the view direction) is the near plane of both
/// projections: nothing behind it is drawn.
struct Camera {
    enum class Projection : std::uint8_t { Perspective, Orthographic };

    Projection projection = Projection::Perspective;
    Vec3d eye{0, -10, 0};            ///< world space
    Vec3d target{0, 0, 0};           ///< world space; seen at the centre of the picture
    Vec3d up{0, 0, 1};               ///< world space; must not be parallel to the view direction
    double verticalFovDegrees = 35;  ///< perspective: full angle from bottom to top, in (0, 180)
    double orthographicHeight = 10;  ///< orthographic: height of the picture, metres, > 0

    friend bool operator==(const Camera&, const Camera&) = default;
};

/// A vertical gradient between the colours of the top and bottom rows, sRGB, 0..1, interpolated in linear light. White
/// by default.
struct Background {
    Vec3f top{1, 1, 1}, bottom{1, 1, 1};
    float alpha = 1;  ///< 0..1; 0: transparent background
    friend bool operator==(const Background&, const Background&) = default;
};

/// One key light, a sky that is brighter above than below, and a little light from the camera.
struct Light {
    enum class Space : std::uint8_t { Camera, World };

    Space space = Space::Camera;       ///< Camera: x to the right, y up, z towards the viewer
    Vec3d direction{-0.45, 0.7, 0.6};  ///< towards the light; need not have length 1
    float key = 0.60f;                 ///< >= 0
    float ambient = 0.56f;             ///< >= 0; key + ambient near 1.1 uses the full tonal range
    float ambientOcclusion = 0.6f;     ///< 0..1: how much corners are darkened; 0 switches it off
    bool hasShadows = false;           ///< opaque parts block the key light; CPU only
    double size = 0.53;                ///< diameter of the key light in degrees, 0..20: how soft shadows are
    friend bool operator==(const Light&, const Light&) = default;
};

/// Style of a scalar.
struct Style {
    Vec3f color{0.8f, 0.8f, 0.8f};  ///< sRGB, 0..1
    float opacity = 1;              ///< share of light absorbed per metre, 0..1; 0: hidden, 1: an opaque surface
    Hatch hatch = Hatch::None;      ///< on its caps (cut faces)
    friend bool operator==(const Style&, const Style&) = default;
};

/// Lines drawn where the label changes, and at depth discontinuities.
struct BorderLines {
    float strength = 0;  ///< 0..1; 0: none
    float width = 1;     ///< pixels, up to kMaxWidth; at least the distance between two samples
    float cutWidth = 1;  ///< the same for lines around caps
    Vec3f color{};       ///< sRGB, 0..1

    static constexpr float kMaxWidth = 16;
    friend bool operator==(const BorderLines&, const BorderLines&) = default;
};

/// Hatches are fixed to the cap, in metres from the grid's origin, independent of the view.
struct HatchStyle {
    double spacing = 0.1;              ///< metres between the lines of Hatch::Masonry, > 0; others are multiples of it
    float width = 1;                   ///< pixels, 0..kMaxWidth of BorderLines
    float strength = 0.75f;            ///< 0..1
    Vec3f color{0.08f, 0.08f, 0.08f};  ///< sRGB, 0..1
    friend bool operator==(const HatchStyle&, const HatchStyle&) = default;
};

/// A pass: which part of the volume is drawn, and how.
struct Pass {
    /// How the pass is composited with the passes before it, per sample.
    enum class Join : std::uint8_t {
        Over,     ///< in front of them, at any depth
        Replace,  ///< where this pass draws anything, it replaces all passes before it, with a border line around it
        Depth,    ///< in front of them where this pass's first label is nearer, else behind
        /// Sorted by depth with the previous pass and its other parts. Together they are joined by the mode of the
        /// previous pass. For parts of space that no ray enters twice, such as adjacent volumes and the gaps between
        /// them.
        Part
    };
    /// Names of the modes that a scene can use.
    friend constexpr auto namesOf(Join) {
        return std::to_array<Name<Join>>({{Join::Over, "over"}, {Join::Replace, "replace"}, {Join::Depth, "depth"}});
    }

    std::vector<Style> styles;      ///< by scalar; scalars beyond the end are hidden. The transfer function
    std::vector<ClipRegion> clips;  ///< a point is drawn if no region cuts it away and all KeepOnly regions contain it;
                                    ///< at most kMaxClipParts parts in all
    Join join = Join::Over;
    std::uint32_t volume = 0;               ///< index into the volumes given to castRays()
    std::vector<LineSet> lines{};           ///< composited with the voxels by depth; clipped like these
    bool hasCells = false;                  ///< edges of voxels are drawn, and each of their faces is flat
    std::vector<MeshTriangle> triangles{};  ///< the same; they replace the voxels of their objects

    static constexpr std::size_t kMaxClipParts = 32;
    friend bool operator==(const Pass&, const Pass&) = default;
};

/// One frame.
struct FrameSpec {
    std::int32_t width = 1280, height = 720;  ///< pixels, 1..kMaxSize
    int samplesPerPixel = 1;                  ///< 1, 4, 9 or 16, on a regular sub-grid
    Camera camera;
    Light light;
    Background background;
    std::vector<Pass> passes;
    BorderLines borders;
    HatchStyle hatches;
    /// By scalar: its object. Between scalars of one object (the phases of its pattern) there is no border line and no
    /// surface. Each scalar beyond the end is an object by itself.
    std::vector<std::uint32_t> objectOfScalar;

    static constexpr std::int32_t kMaxSize = 16384;
    static constexpr std::size_t kMaxPasses = 64;
};

/// Checks all preconditions of castRays().
/// \return nothing, or an error whose message names the problem and the valid range:
///         - BadFrame   a size, count, style, light or clip is out of range.
///         - BadCamera  eye, target and up do not define a view, or the field of view or the height is out of range.
[[nodiscard]] Result<void> checkFrameSpec(const FrameSpec& spec);

}  // namespace svt::render
