#include "cli.hpp"
#include "scene_options.hpp"

#include <svt/core/file.hpp>
#include <svt/illustrate/name_tags.hpp>
#include <svt/render/png.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/render_gl/egl_context.hpp>
#include <svt/render_gl/gl_renderer.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/lod_pyramid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace svt::cli {
namespace {

struct Arguments {
    std::filesystem::path input, output, labelOutput, depthOutput, sceneOutput;
    BuildArguments build;
    SceneArguments scene;
    std::optional<int> level;
    int frames = 1;
    bool gl = false;
    bool verbose = false;
};

// The forms of a volume that pictures need, each made once.
class Drawn {
public:
    Drawn(const volume::SemanticVolume& volume, int threads) : volume_(volume), threads_(threads) {}

    /// The volume itself, drawn by OpenGL.
    Result<render::Frame> drawByGl(const render::FrameSpec& spec) {
        if (!renderer_) {
            if (auto made = makeBricks(); !made) return made.error();
            auto context = render_gl::EglContext::make();
            if (!context) return context.error();
            context_.emplace(std::move(*context));
            auto renderer = render_gl::GlRenderer::make(*bricks_, volume_.grid, {.threads = threads_});
            if (!renderer) return renderer.error();
            renderer_.emplace(std::move(*renderer));
        }
        return renderer_->read(spec);
    }

    Result<render::Frame> cast(const render::FrameSpec& spec, int level, const render::CastOptions& options) {
        if (level > 0) {
            if (!levels_) {
                auto levels = volume::buildLodPyramid(volume_.columns, volume_.grid, 6, threads_);
                if (!levels) return levels.error();
                levels_ = std::move(*levels);
            }
            if (!levels_->empty())
                return render::castRays((*levels_)[std::min(levels_->size(), static_cast<std::size_t>(level)) - 1],
                                        spec, options);
        }
        if (auto made = makeBricks(); !made) return made.error();
        return render::castRays(*bricks_, volume_.grid, spec, options);
    }

private:
    Result<void> makeBricks() {
        if (bricks_) return {};
        auto bricks = volume::BrickVolume::fromColumns(volume_.columns, threads_);
        if (!bricks) return bricks.error();
        bricks_ = std::move(*bricks);
        return {};
    }

    const volume::SemanticVolume& volume_;
    int threads_;
    std::optional<volume::BrickVolume> bricks_;
    std::optional<std::vector<volume::LodLevel>> levels_;
    std::optional<render_gl::EglContext> context_;  // goes after what it holds
    std::optional<render_gl::GlRenderer> renderer_;
};

// P.png -> P_0007.png
std::filesystem::path numbered(const std::filesystem::path& file, int frame, int frames) {
    if (frames == 1 || file.empty()) return file;
    std::filesystem::path result = file;
    result.replace_filename(fmt::format("{}_{:04}{}", file.stem().string(), frame, file.extension().string()));
    return result;
}

Result<void> writeBuffers(const render::Frame& frame, const Arguments& arguments, int number) {
    const auto at = [&](const std::filesystem::path& file) { return numbered(file, number, arguments.frames); };
    if (auto written = render::writePng(at(arguments.output), frame.color, arguments.scene.printedDpi()); !written)
        return written;
    if (!arguments.labelOutput.empty()) {
        const auto gray = render::grayFromLabels(frame.label);
        if (!gray) return gray.error();
        if (auto written = render::writePng(at(arguments.labelOutput), *gray); !written) return written;
    }
    if (!arguments.depthOutput.empty())
        return render::writePng(at(arguments.depthOutput), render::grayFromDepth(frame.depth, 0.001));
    return {};
}

Result<void> addNames(const illustrate::Scene& scene, const volume::SemanticVolume& volume,
                      const render::FrameSpec& spec, render::Frame& frame) {
    if (scene.names.empty()) return {};
    const auto tags = illustrate::findNameTags(scene.names, volume, spec, frame);
    if (!tags) return tags.error();
    const Vec3f paper = (spec.background.top + spec.background.bottom) * 0.5f;
    const bool isDark = paper.x + paper.y + paper.z < 1.5f && spec.background.alpha > 0;
    const Vec3f dark{0.05f, 0.05f, 0.06f}, light{1, 1, 1};
    drawNameTags(*tags, 0, isDark ? light : dark, isDark ? paper : light, frame.color);
    return {};
}

// What a model must keep of itself for a scene.
BuildArguments withVectors(BuildArguments build, const illustrate::Scene& scene) {
    for (const illustrate::ScenePass& pass : scene.passes) {
        build.vectors.edges = build.vectors.edges || !pass.lines.empty();
        build.vectors.meshes = build.vectors.meshes || !pass.meshes.empty();
    }
    return build;
}

int runRender(const Arguments& arguments) {
    // Before anything long: does what is asked for make sense?
    const auto first = arguments.scene.toScene(0, arguments.frames);
    if (!first) return fail(first.error());
    if (!arguments.sceneOutput.empty()) {
        const auto written = writeFileAtomically(arguments.sceneOutput, illustrate::writeScene(*first));
        if (!written) return fail(written.error());
    }
    Diagnostics diagnostics;
    const TerminalProgress progress;
    const auto volume = loadVolume(arguments.input, withVectors(arguments.build, *first), progress.get(), diagnostics);
    printDiagnostics(diagnostics, arguments.verbose);
    if (!volume) return fail(volume.error());

    render::CastOptions options;
    options.threads = arguments.build.threads;
    options.progress = progress.get();
    options.isAdaptive = true;
    Drawn drawn(*volume, arguments.build.threads);
    for (int frame = 0; frame < arguments.frames; ++frame) {
        const auto scene = arguments.scene.toScene(frame, arguments.frames);
        if (!scene) return fail(scene.error());
        const auto spec = illustrate::frameOf(*scene, *volume);
        if (!spec) return fail(spec.error());
        const int level = arguments.level ? *arguments.level : render::levelForView(*spec, volume->grid);
        auto picture = arguments.gl ? drawn.drawByGl(*spec) : drawn.cast(*spec, level, options);
        if (!picture) return fail(picture.error());
        if (auto named = addNames(*scene, *volume, *spec, *picture); !named) return fail(named.error());
        if (auto written = writeBuffers(*picture, arguments, frame); !written) return fail(written.error());
        Progress::tell(progress.get(), "render", double(frame + 1) / arguments.frames);
    }
    return kDone;
}

}  // namespace

Run addRenderCommand(CLI::App& app) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("render", "Draw a picture (PNG) of a volume or model");
    command->add_option("input", arguments->input, "a .svt or a model file")->required();
    command->add_option("-o,--output", arguments->output, "the picture to write")->required()->type_name("P.png");
    arguments->scene.addTo(*command);
    command->add_option("--write-scene", arguments->sceneOutput, "also write the scene that these options make")
        ->group("Scene")
        ->type_name("S.scene.json");
    command
        ->add_option("--frames", arguments->frames,
                     "so many pictures P_0000.png, ... of a section that moves, 1 to 10000")
        ->group("Scene")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    CLI::Option* level = command
                             ->add_option("--level", arguments->level,
                                          "level of detail, 0 (finest) to 6; default: as fine as the pixels show")
                             ->group("Style")
                             ->check(CLI::Range(0, 6));
    command->add_flag("--gl", arguments->gl, "draw by OpenGL ES 3.0, the finest level; needs a driver, but no display")
        ->group("Output")
        ->excludes(level);
    command->add_option("--labels", arguments->labelOutput, "also write the scalar of each pixel, 16-bit gray")
        ->group("Output")
        ->type_name("L.png");
    command
        ->add_option("--depth", arguments->depthOutput,
                     "also write the depth of each pixel in millimetres, 16-bit gray")
        ->group("Output")
        ->type_name("D.png");
    command->add_flag("-v,--verbose", arguments->verbose, "show all findings")->group("Output");
    arguments->build.addTo(*command);
    return [arguments] { return runRender(*arguments); };
}

}  // namespace svt::cli
