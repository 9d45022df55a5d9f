#pragma once
/// \file
/// Volumes and frames that the benchmark draws, the same for every renderer.

#include <bench/workload.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/volume/label_table.hpp>

#include <vector>

namespace svt::bench {

/// A volume ready to be drawn by ours and by the peers.
struct Drawable {
    volume::Grid grid;
    volume::ColumnVolume columns;
    std::vector<volume::FacePlane> planes;
    volume::BrickVolume bricks;
};

[[nodiscard]] Result<Drawable> makeDrawable(const Scene& scene, Vec3i dimension, int threads = 0);

/// What has a built-in opacity below 1 (rooms, units) is hidden; all else is opaque. Telltale colors.
[[nodiscard]] std::vector<render::Style> opaqueStyles(const volume::LabelTable& labels);
/// Everything, rooms too, stops 30 % of the light per metre: hardly a ray ends early. Telltale colors.
[[nodiscard]] std::vector<render::Style> translucentStyles(const volume::LabelTable& labels);

/// From the south-east and above, with light, over white.
[[nodiscard]] Result<render::FrameSpec> frameOf(const volume::Grid& grid, std::vector<render::Style> styles,
                                                std::int32_t width, std::int32_t height);

/// The same with ambient light alone and no ambient occlusion: the least that our caster can be asked for.
[[nodiscard]] render::FrameSpec unlit(render::FrameSpec spec);
/// The same in the dark, over black. A translucent body is lit half as strongly as a surface (castRays()), so in the
/// dark half of its color is left: twice this picture is the one without light, for styles that are all translucent.
[[nodiscard]] render::FrameSpec dark(render::FrameSpec spec);

}  // namespace svt::bench
