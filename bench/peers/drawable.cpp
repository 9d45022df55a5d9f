#include <bench/compare.hpp>
#include <bench/drawable.hpp>
#include <svt/render/camera_presets.hpp>
#include <svt/voxelize/face_planes.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <utility>

namespace svt::bench {

Result<Drawable> makeDrawable(const Workload& workload, Vec3i dimension, int threads) {
    SVT_TRY(grid, gridOver(workload, dimension));
    voxelize::VoxelizeOptions options;
    options.threads = threads;
    SVT_TRY(voxels, voxelize::voxelize(workload.meshes, *grid, workload.labels.claims, options));
    std::vector<volume::FacePlane> planes = voxelize::findFacePlanes(workload.meshes, *grid);
    SVT_TRY(bricks, volume::BrickVolume::fromColumns(voxels->columns, {.planes = planes, .threads = threads}));
    return Drawable{*grid, std::move(voxels->columns), std::move(planes), std::move(*bricks)};
}

std::vector<render::Style> opaqueStyles(const volume::LabelTable& labels) {
    std::vector<render::Style> styles(labels.scalarCount());
    for (std::size_t s = 0; s < styles.size(); ++s) styles[s] = {labelColor(static_cast<std::uint32_t>(s)), 0};
    for (const volume::Label& label : labels.labels)
        for (volume::Scalar s = 0; s < label.count; ++s)
            styles[label.first + s].opacity = label.opacity < 1 ? 0.0f : 1.0f;
    return styles;
}

std::vector<render::Style> translucentStyles(const volume::LabelTable& labels) {
    std::vector<render::Style> styles = opaqueStyles(labels);
    for (std::size_t s = 1; s < styles.size(); ++s) styles[s].opacity = 0.3f;
    return styles;
}

Result<render::FrameSpec> makeFrameSpec(const volume::Grid& grid, std::vector<render::Style> styles, std::int32_t width,
                                        std::int32_t height) {
    render::FrameSpec spec;
    spec.width = width;
    spec.height = height;
    render::PresetOptions preset;
    preset.aspect = double(width) / height;
    SVT_TRY(camera, render::cameraPreset("iso", grid, preset));
    spec.camera = *camera;
    render::Pass pass;
    pass.styles = std::move(styles);
    spec.passes.push_back(std::move(pass));
    return spec;
}

render::FrameSpec unlit(render::FrameSpec spec) {
    spec.light.key = 0;
    spec.light.ambient = 1;
    spec.light.ambientOcclusion = 0;
    return spec;
}

render::FrameSpec dark(render::FrameSpec spec) {
    spec.light.key = 0;
    spec.light.ambient = 0;
    spec.light.ambientOcclusion = 0;
    spec.background = {{0, 0, 0}, {0, 0, 0}, 1};
    return spec;
}

}  // namespace svt::bench
