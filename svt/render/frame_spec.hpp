#pragma once
/// \file
/// What a picture shows, as plain data: camera, light, background, and ordered passes, each with styles and clips.
/// World space is the volume's, in metres. Sections, lenses and highlights are made of these parts.

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

/// Where the picture is taken from. The eye plane (through `eye`, across the view direction) is the near plane of
/// both projections: nothing behind it is drawn.
struct Camera {
    enum class Projection : std::uint8_t { Perspective, Orthographic };

    Projection projection = Projection::Perspective;
    Vec3d eye{0, -10, 0};            ///< world space
    Vec3d target{0, 0, 0};           ///< world space; the middle of the picture
    Vec3d up{0, 0, 1};               ///< world space; need not be across the view, must not be along it
    double verticalFovDegrees = 35;  ///< perspective: whole angle from bottom to top, in (0, 180)
    double orthographicHeight = 10;  ///< orthographic: from bottom to top, metres, > 0

    friend bool operator==(const Camera&, const Camera&) = default;
};

/// sRGB, 0..1; `top` and `bottom` rows are blended in linear light between. White paper by default.
struct Background {
    Vec3f top{1, 1, 1}, bottom{1, 1, 1};
    float alpha = 1;  ///< 0..1; 0 leaves the picture transparent around what is drawn
    friend bool operator==(const Background&, const Background&) = default;
};

/// One key light, a sky brighter above than below, and a little light from the camera.
struct Light {
    enum class Space : std::uint8_t { Camera, World };

    Space space = Space::Camera;       ///< Camera: x to the right, y up, z towards the viewer
    Vec3d direction{-0.45, 0.7, 0.6};  ///< towards the light; need not have length 1
    float key = 0.60f;                 ///< >= 0
    float ambient = 0.56f;             ///< >= 0; key + ambient near 1.1 uses the whole range of tones
    float ambientOcclusion = 0.6f;     ///< 0..1: how dark corners get; 0 switches it off
    friend bool operator==(const Light&, const Light&) = default;
};

/// Look of a scalar.
struct Style {
    Vec3f color{0.8f, 0.8f, 0.8f};  ///< sRGB, 0..1
    float opacity = 1;              ///< fraction of light stopped by one metre, 0..1; 0 = hidden, 1 = an opaque surface
    Hatch hatch = Hatch::None;      ///< on its cut faces
    friend bool operator==(const Style&, const Style&) = default;
};

/// Lines where the label changes, and where the depth jumps.
struct BorderLines {
    float strength = 0;  ///< 0..1; 0: none
    float width = 1;     ///< pixels, up to kMaxWidth; at least the distance of two samples
    float cutWidth = 1;  ///< the same around what is cut
    Vec3f color{};       ///< sRGB, 0..1

    static constexpr float kMaxWidth = 16;
    friend bool operator==(const BorderLines&, const BorderLines&) = default;
};

/// Hatches lie on the cut face, in metres from the grid's origin, whatever the view.
struct HatchLook {
    double spacing = 0.1;              ///< metres between the lines of Hatch::Masonry, > 0; others are multiples of it
    float width = 1;                   ///< pixels, 0..kMaxWidth of BorderLines
    float strength = 0.75f;            ///< 0..1
    Vec3f color{0.08f, 0.08f, 0.08f};  ///< sRGB, 0..1
    friend bool operator==(const HatchLook&, const HatchLook&) = default;
};

/// Which part of the volume is drawn, and how.
struct Pass {
    /// How the pass joins what the passes before it have drawn, sample by sample.
    enum class Join : std::uint8_t {
        Over,     ///< in front of it, at any depth
        Replace,  ///< where this pass draws anything, all before it is dropped, with a border line around it
        Depth     ///< in front of it where this pass' first label is nearer, else behind
    };

    std::vector<Style> styles;      ///< by scalar; scalars beyond the end are hidden. The transfer function
    std::vector<ClipRegion> clips;  ///< drawn is what no region cuts away and every KeepOnly region holds; at most
                                    ///< kMaxClipParts parts in all
    Join join = Join::Over;
    std::uint32_t volume = 0;               ///< which of the volumes that castRays() is given
    std::vector<LineSet> lines{};           ///< composited with the voxels at their depth; clipped as they are
    std::vector<MeshTriangle> triangles{};  ///< the same; drawn instead of the voxels of their objects

    static constexpr std::size_t kMaxClipParts = 32;
    friend bool operator==(const Pass&, const Pass&) = default;
};

/// One picture.
struct FrameSpec {
    std::int32_t width = 1280, height = 720;  ///< pixels, 1..kMaxSize
    int samplesPerPixel = 1;                  ///< 1, 4, 9 or 16, on a regular sub-grid
    Camera camera;
    Light light;
    Background background;
    std::vector<Pass> passes;
    BorderLines borders;
    HatchLook hatches;
    /// By scalar: which scalars belong together, so that no border line and no surface stands between them (the phases
    /// of one object's pattern). Scalars beyond the end belong to themselves alone.
    std::vector<std::uint32_t> objectOfScalar;

    static constexpr std::int32_t kMaxSize = 16384;
    static constexpr std::size_t kMaxPasses = 64;
};

/// Everything that castRays() relies on.
/// \return BadFrame where a size, count, style, light or clip is out of range; BadCamera where eye, target and up span
/// no
///         view, or the field of view or height is out of range. The message names what and the range.
[[nodiscard]] Result<void> checkFrameSpec(const FrameSpec& spec);

}  // namespace svt::render
