#pragma once
/// \file
/// Volumes and frames drawn by the benchmark, the same for every renderer.

#include <bench/workload.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/volume/label_table.hpp>

#include <vector>

namespace svt::bench {

/// A volume prepared for our renderer and the peers.
struct Drawable {
    volume::Grid grid;
    volume::ColumnVolume columns;
    std::vector<volume::FacePlane> planes;
    volume::BrickVolume bricks;
};

[[nodiscard]] Result<Drawable> makeDrawable(const Workload& workload, Vec3i dimension, int threads = 0);

/// Labels with a built-in opacity below 1 (rooms, units) are hidden; all others are opaque. Identifying colors.
[[nodiscard]] std::vector<render::Style> opaqueStyles(const volume::LabelTable& labels);
/// Everything, including rooms, stops 30 % of the light per metre: hardly any ray ends early. Identifying colors.
[[nodiscard]] std::vector<render::Style> translucentStyles(const volume::LabelTable& labels);

/// From the south-east and above, with lighting, on white.
[[nodiscard]] Result<render::FrameSpec> makeFrameSpec(const volume::Grid& grid, std::vector<render::Style> styles,
                                                      std::int32_t width, std::int32_t height);

/// The same with ambient light only and no ambient occlusion: the least work our caster can do.
[[nodiscard]] render::FrameSpec unlit(render::FrameSpec spec);
/// The same without light, on black. A translucent body is lit half as strongly as a surface (castRays()), so without
/// light half of its color remains: twice this picture is the unlit one, if all styles are translucent.
[[nodiscard]] render::FrameSpec dark(render::FrameSpec spec);

}  // namespace svt::bench
