#include <bench/benches.hpp>
#include <bench/compare.hpp>
#include <bench/peers.hpp>
#include <svt/render/camera_presets.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/dense.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <fmt/format.h>

#include <utility>

namespace svt::bench {
namespace {

// A volume ready to be drawn by ours and by the peers.
struct Drawable {
    volume::Grid grid;
    volume::ColumnVolume columns;
    volume::BrickVolume bricks;
};

Result<Drawable> makeDrawable(const Scene& scene, Vec3i dimension) {
    const auto grid = gridOver(scene, dimension);
    if (!grid) return grid.error();
    auto voxels = voxelize::voxelize(scene.meshes, *grid, scene.labels.claims);
    if (!voxels) return voxels.error();
    auto bricks = volume::BrickVolume::fromColumns(voxels->columns);
    if (!bricks) return bricks.error();
    return Drawable{*grid, std::move(voxels->columns), std::move(*bricks)};
}

// What has a built-in opacity below 1 (rooms, units) is hidden; all else is opaque.
std::vector<render::Style> opaqueStyles(const Scene& scene) {
    const volume::LabelTable& table = scene.labels.table;
    std::vector<render::Style> styles(table.scalarCount());
    for (std::size_t s = 0; s < styles.size(); ++s) styles[s] = {telltaleColor(static_cast<std::uint32_t>(s)), 0};
    for (const volume::Label& label : table.labels)
        for (volume::Scalar s = 0; s < label.count; ++s)
            styles[label.first + s].opacity = label.opacity < 1 ? 0.0f : 1.0f;
    return styles;
}

// Everything, rooms too, stops 30 % of the light per metre: hardly a ray ends early.
std::vector<render::Style> translucentStyles(const Scene& scene) {
    std::vector<render::Style> styles = opaqueStyles(scene);
    for (std::size_t s = 1; s < styles.size(); ++s) styles[s].opacity = 0.3f;
    return styles;
}

Result<render::FrameSpec> frameOf(const Drawable& drawable, std::vector<render::Style> styles, std::int32_t width,
                                  std::int32_t height) {
    render::FrameSpec spec;
    spec.width = width;
    spec.height = height;
    render::PresetOptions preset;
    preset.aspect = double(width) / height;
    auto camera = render::cameraPreset("iso", drawable.grid, preset);
    if (!camera) return camera.error();
    spec.camera = *camera;
    render::Pass pass;
    pass.styles = std::move(styles);
    spec.passes.push_back(std::move(pass));
    return spec;
}

void cast(const Drawable& drawable, const render::FrameSpec& spec) {
    static_cast<void>(render::castRays(drawable.bricks, drawable.grid, spec).hasValue());
}

render::FrameSpec unlit(render::FrameSpec spec) {
    spec.light.key = 0;
    spec.light.ambient = 1;
    spec.light.ambientOcclusion = 0;
    return spec;
}

class RenderBench {
public:
    RenderBench(const Scene& scene, const BenchOptions& options, Report& report)
        : scene_(scene), options_(options), report_(report) {}

    Result<void> run() {
        const Vec3i dimension = gridSizes(options_.isQuick).back();
        auto drawable = makeDrawable(scene_, dimension);
        if (!drawable) return drawable.error();
        dense_.dimension = dimension;
        auto scalars = volume::toDense<std::uint16_t>(drawable->columns);
        if (!scalars) return scalars.error();
        dense_.scalars = std::move(*scalars);
        if (auto done = besideVtk(*drawable, "opaque frame", opaqueStyles(scene_), 1280, 720); !done) return done;
        if (auto done = besideVtk(*drawable, "translucent frame", translucentStyles(scene_), 1920, 1080); !done)
            return done;
        dense_ = {};
        if (auto done = edits(*drawable); !done) return done;
        return options_.isQuick ? Result<void>{} : largerGrid(*drawable);
    }

private:
    Row newRow(const char* stage, std::string size) const {
        Row row;
        row.stage = stage;
        row.input = scene_.name;
        row.size = std::move(size);
        tell(fmt::format("{} {} {}", row.stage, row.input, row.size));
        return row;
    }

    Result<void> besideVtk(const Drawable& drawable, const char* stage, std::vector<render::Style> styles,
                           std::int32_t width, std::int32_t height) {
        Row row = newRow(stage, fmt::format("{}, {} x {} pixels", sizeText(drawable.grid.dimension()), width, height));
        const bool isOpaque = styles[1].opacity != 0.3f;
        const auto spec = frameOf(drawable, styles, width, height);
        if (!spec) return spec.error();
        const auto frame = render::castRays(drawable.bricks, drawable.grid, *spec);
        if (!frame) return frame.error();
        const render::FrameSpec flat = unlit(*spec);
        std::vector<Contestant> contestants{{"SVT, lit", [&] { cast(drawable, *spec); }},
                                            {"SVT, unlit", [&] { cast(drawable, flat); }}};
        std::vector<std::unique_ptr<VolumePeer>> peers;
        std::vector<std::uint64_t> memory;  // of each peer: its volume, and what it makes of it for the first frame
        for (const VtkMapper mapper : {VtkMapper::FixedPoint, VtkMapper::Gpu}) {
            Peer<VolumePeer> vtk = makeVtkVolume(mapper);
            if (vtk.peer == nullptr) {
                if (mapper == VtkMapper::FixedPoint) row.missing.push_back(vtk.missing);
                continue;
            }
            memory.push_back(peakMemoryOf([&] {
                vtk.peer->setVolume(dense_, drawable.grid);
                vtk.peer->setStyles(styles);
                vtk.peer->setCamera(spec->camera, width, height);
                vtk.peer->draw();
            }));
            peers.push_back(std::move(vtk.peer));
            VolumePeer* const peer = peers.back().get();
            contestants.push_back({peer->name(), [peer] { peer->draw(); }});
        }
        auto measured = measureInTurns(contestants, options_.measure);
        measured[0].peakBytes += drawable.bricks.sizeBytes();
        measured[1].peakBytes += drawable.bricks.sizeBytes();
        for (std::size_t p = 0; p < peers.size(); ++p) measured[p + 2].peakBytes = memory[p];
        row.ours = measured[0];
        row.extra["frames_per_s"] = 1 / measured[0].median;
        row.resultBytes = drawable.bricks.sizeBytes();
        row.beside.push_back({measured[1], "no light, no ambient occlusion, as VTK here", Json::object(), false});
        for (std::size_t p = 0; p < peers.size(); ++p) {
            Beside beside{measured[p + 2], "one sample a voxel", Json::object(), true};
            if (isOpaque) {
                const double share = agreeingShare(frame->label, peers[p]->picture());
                peers[p]->setSamplesPerVoxel(8);
                const double fineShare = agreeingShare(frame->label, peers[p]->picture());
                beside.extra["agreeing_pixels_percent"] = 100 * share;
                beside.extra["agreeing_pixels_percent_8_samples"] = 100 * fineShare;
                beside.note +=
                    fmt::format("; {:.2f} % of the pixels show the same label, {:.2f} % with 8 samples a voxel",
                                100 * share, 100 * fineShare);
            } else {
                beside.note += "; pictures not compared";
            }
            row.beside.push_back(std::move(beside));
        }
        report_.rows.push_back(std::move(row));
        return {};
    }

    // A frame with a section plane; the same with the plane in another place each time, and with another style each
    // time.
    Result<void> edits(const Drawable& drawable) {
        Row row = newRow("section frame", fmt::format("{}, 1280 x 720 pixels", sizeText(drawable.grid.dimension())));
        auto spec = frameOf(drawable, opaqueStyles(scene_), 1280, 720);
        if (!spec) return spec.error();
        const Vec3d corner = drawable.grid.origin();
        const Vec3d size{drawable.grid.spacing().x * (drawable.grid.dimension().x - 1), 0,
                         drawable.grid.spacing().z * (drawable.grid.dimension().z - 1)};
        const auto planeAt = [&](double share) {
            return render::ClipRegion::plane({0, 0, 1}, corner + Vec3d{0, 0, size.z * share});
        };
        spec->passes[0].clips = {planeAt(0.5)};
        render::FrameSpec moved = *spec, edited = *spec;
        int turn = 0;
        const std::vector<Contestant> contestants{
            {"SVT", [&] { cast(drawable, *spec); }},
            {"SVT, plane moved before each frame",
             [&] {
                 moved.passes[0].clips = {planeAt(0.5 + 0.001 * (++turn % 8 - 4))};
                 cast(drawable, moved);
             }},
            {"SVT, a style changed before each frame", [&] {
                 edited.passes[0]
                     .styles[1 + static_cast<std::size_t>(++turn) % (edited.passes[0].styles.size() - 1)]
                     .color.x = 0.5f;
                 cast(drawable, edited);
             }}};
        const auto measured = measureInTurns(contestants, options_.measure);
        row.ours = measured[0];
        row.beside.push_back({measured[1], "nothing is rebuilt", Json::object(), false});
        row.beside.push_back({measured[2], "nothing is rebuilt", Json::object(), false});
        report_.rows.push_back(std::move(row));
        return {};
    }

    Result<void> largerGrid(const Drawable& drawable) {
        const Vec3i dimension{1000, 1200, 600};
        Row row = newRow("larger grid, opaque frame", fmt::format("{}, 1280 x 720 pixels", sizeText(dimension)));
        const auto larger = makeDrawable(scene_, dimension);
        if (!larger) return larger.error();
        const auto spec = frameOf(drawable, opaqueStyles(scene_), 1280, 720);
        const auto largerSpec = frameOf(*larger, opaqueStyles(scene_), 1280, 720);
        if (!spec) return spec.error();
        if (!largerSpec) return largerSpec.error();
        const auto measured =
            measureInTurns({{"SVT", [&] { cast(*larger, *largerSpec); }},
                            {"SVT at " + sizeText(drawable.grid.dimension()), [&] { cast(drawable, *spec); }}},
                           options_.measure);
        row.ours = measured[0];
        row.resultBytes = larger->bricks.sizeBytes();
        row.extra["times_smaller_grid"] = measured[0].median / measured[1].median;
        row.beside.push_back(
            {measured[1],
             fmt::format("the larger grid takes {:.2f} times as long", measured[0].median / measured[1].median),
             Json::object(), false});
        report_.rows.push_back(std::move(row));
        return {};
    }

    const Scene& scene_;
    const BenchOptions& options_;
    Report& report_;
    DenseLabels dense_;
};

}  // namespace

Result<void> benchRender(const Scene& scene, const BenchOptions& options, Report& report) {
    return RenderBench(scene, options, report).run();
}

}  // namespace svt::bench
