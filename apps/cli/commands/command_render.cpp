#include <apps/cli/commands/commands.hpp>
#include <apps/cli/options/build_options.hpp>
#include <apps/cli/options/scene_options.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>
#include <svt/illustrate/line_view.hpp>
#include <svt/illustrate/scene_painter.hpp>
#include <svt/image/png.hpp>
#include <svt/render/frame_buffers.hpp>
#include <svt/render_gl/egl_context.hpp>
#include <svt/render_gl/gl_renderer.hpp>
#include <svt/writers/view_drawing.hpp>

#include <fmt/format.h>

#include <optional>
#include <span>

namespace svt::cli {
namespace {

struct RenderArguments {
    std::filesystem::path input, output, labelOutput, depthOutput, sceneOutput;
    BuildArguments build;
    SceneArguments scene;
    int frames = 0;
    bool gl = false;
    bool verbose = false;
};

// Draws the finest level of one volume with OpenGL; created on first use.
class GlDrawer {
public:
    explicit GlDrawer(int threads) : threads_(threads) {}

    Result<render::Frame> draw(std::span<const render::DrawnVolume> volumes, const render::FrameSpec& spec) {
        if (volumes.size() > 1 || volumes[0].level() != nullptr)
            return Error(Code::BadFrame,
                         "--gl draws one volume at its finest level, and the passes of this scene draw others; leave "
                         "out --gl");
        if (!context_) {
            unlimitMemory();  // drivers reserve what they never use
            auto context = render_gl::EglContext::make();
            if (!context) return context.error();
            context_.emplace(std::move(*context));
        }
        if (drawn_ != &volumes[0].bricks()) {
            auto renderer = render_gl::GlRenderer::make(volumes[0].bricks(), volumes[0].grid(), {.threads = threads_});
            if (!renderer) return renderer.error();
            renderer_.emplace(std::move(*renderer));
            drawn_ = &volumes[0].bricks();
        }
        return renderer_->read(spec);
    }

private:
    int threads_;
    std::optional<render_gl::EglContext> context_;  // destroyed after the objects that use it
    std::optional<render_gl::GlRenderer> renderer_;
    const volume::BrickVolume* drawn_ = nullptr;
};

// Takes the finest level for every pass that names none, as OpenGL does.
void takeFinest(illustrate::Scene& scene) {
    for (illustrate::ScenePass& pass : scene.passes)
        if (!pass.form.level) pass.form.level = 0;
}

Result<void> writeBuffers(const render::Frame& frame, const RenderArguments& arguments, int number) {
    const auto at = [&](const std::filesystem::path& file) { return numberedFile(file, number, arguments.frames); };
    if (auto written = image::writePng(at(arguments.output), frame.color, arguments.scene.printedDpi()); !written)
        return written;
    if (!arguments.labelOutput.empty()) {
        const auto gray = render::grayFromLabels(frame.label);
        if (!gray) return gray.error();
        if (auto written = image::writePng(at(arguments.labelOutput), *gray); !written) return written;
    }
    if (!arguments.depthOutput.empty())
        return image::writePng(at(arguments.depthOutput), render::grayFromDepth(frame.depth, 0.001));
    return {};
}

// Whether nothing of the model is in a picture: no label, and no line or veil either, which would vary along a row.
bool isEmpty(const render::Frame& frame) {
    for (std::int32_t y = 0; y < frame.color.height(); ++y)
        for (std::int32_t x = 0; x < frame.color.width(); ++x)
            if (frame.label.at(x, y) != 0 || frame.color.at(x, y) != frame.color.at(0, y)) return false;
    return true;
}

// Options to keep the vector data of the model that a scene needs.
BuildArguments withVectors(BuildArguments build, const illustrate::Scene& scene) {
    for (const illustrate::ScenePass& pass : scene.passes) {
        build.vectors.edges = build.vectors.edges || !pass.lines.empty();
        build.vectors.meshes = build.vectors.meshes || !pass.meshes.empty();
    }
    return build;
}

// Tells which names are missing in a picture, and why.
void noteNames(const illustrate::Painting::Names& names) {
    if (names.hidden != 0) note(fmt::format("names: {} of what is not seen are left out", names.hidden));
    if (names.withoutRoom != 0)
        note(fmt::format("names: {} found no place; a larger --size or a narrower --names makes room",
                         names.withoutRoom));
}

bool isLineDrawing(const std::filesystem::path& output) {
    const std::string ending = endingOf(output);
    return ending == ".svg" || ending == ".pdf";
}

Result<void> writeLineView(const RenderArguments& arguments, const illustrate::LineView& view,
                           const volume::SemanticVolume& volume, int pixels, int number) {
    const int dpi = arguments.scene.printedDpi() > 0 ? arguments.scene.printedDpi() : 96;
    const double width = 25.4 * pixels / dpi;
    const auto path = numberedFile(arguments.output, number, arguments.frames);
    if (endingOf(path) == ".svg") {
        if (auto written = writeFileAtomically(path, writers::makeViewSvg(view, volume, width)); !written)
            return written.error();
        return {};
    }
    const auto pdf = writers::makeViewPdf(view, volume, width);
    if (!pdf) return pdf.error();
    if (auto written = writeFileAtomically(path, *pdf); !written) return written.error();
    return {};
}

// Lines instead of pixels: the scene's camera, what it shows, and the plane that cuts it.
int runLineDrawing(const RenderArguments& arguments) {
    if (arguments.gl || !arguments.labelOutput.empty() || !arguments.depthOutput.empty())
        return fail(Error(Code::BadArgument, "--gl, --labels and --depth are for PNG, not for line drawings"));
    Diagnostics diagnostics;
    TerminalProgress progress;
    BuildArguments build = arguments.build;
    build.vectors.meshes = true;
    const auto volume = loadVolume(arguments.input, build, progress.get(), diagnostics);
    printDiagnostics(diagnostics, arguments.verbose);
    if (!volume) return fail(volume.error());
    illustrate::LineViewOptions options;
    options.hidden = arguments.scene.hiddenLines == "dashed";
    options.threads = arguments.build.threads;
    for (int frame = 0; frame < arguments.frames; ++frame) {
        progress.beginPart(frame, arguments.frames);
        Progress::tell(progress.get(), "lines", 0);
        const auto scene = arguments.scene.toScene(frame, arguments.frames);
        if (!scene) return fail(scene.error());
        const auto spec = illustrate::makeFrameSpec(*scene, *volume);
        if (!spec) return fail(spec.error());
        const auto view = illustrate::drawLineView(*volume, *spec, options);
        if (!view) return fail(view.error());
        if (auto written = writeLineView(arguments, *view, *volume, scene->width, frame); !written)
            return fail(written.error());
        if (view->drawing.beyond.empty() && view->drawing.components.empty()) note("nothing is visible");
        if (frame == 0 && !arguments.sceneOutput.empty())
            if (auto written = writeFileAtomically(arguments.sceneOutput, illustrate::writeScene(*scene)); !written)
                return fail(written.error());
    }
    return kDone;
}

int runRender(const RenderArguments& arguments) {
    // Validate the request before any long work.
    const auto first = arguments.scene.toScene(0, arguments.frames);
    if (!first) return fail(first.error());
    if (isLineDrawing(arguments.output)) return runLineDrawing(arguments);
    Diagnostics diagnostics;
    TerminalProgress progress;
    const auto volume = loadVolume(arguments.input, withVectors(arguments.build, *first), progress.get(), diagnostics);
    printDiagnostics(diagnostics, arguments.verbose);
    if (!volume) return fail(volume.error());

    render::CastOptions options;
    options.threads = arguments.build.threads;
    options.progress = progress.get();
    options.isAdaptive = true;
    illustrate::ScenePainter painter(*volume, arguments.build.threads);
    // An answer, not an error, as for `svt query`: the query is well formed, and there is no such feature.
    std::vector<std::string> nothing;
    painter.tolerateNothing(&nothing);
    painter.reportTo(progress.get());
    GlDrawer gl(arguments.build.threads);
    const illustrate::ScenePainter::Draw drawByGl = [&](auto volumes, const auto& spec) {
        return gl.draw(volumes, spec);
    };
    int empty = 0;
    for (int frame = 0; frame < arguments.frames; ++frame) {
        progress.beginPart(frame, arguments.frames);
        auto scene = arguments.scene.toScene(frame, arguments.frames);
        if (!scene) return fail(scene.error());
        if (arguments.gl) takeFinest(*scene);
        const auto painting = arguments.gl ? painter.paint(*scene, drawByGl) : painter.paint(*scene, options);
        if (!painting) return fail(painting.error());
        empty += isEmpty(painting->frame);
        if (frame == 0) noteNames(painting->names);
        if (auto written = writeBuffers(painting->frame, arguments, frame); !written) return fail(written.error());
    }
    if (!arguments.sceneOutput.empty()) {
        const auto written = writeFileAtomically(arguments.sceneOutput, illustrate::writeScene(*first));
        if (!written) return fail(written.error());
    }
    for (const std::string& message : nothing) note(message);
    if (empty != 0)
        note(fmt::format("nothing is visible{}: all is hidden, cut away, fully transparent or outside of the view",
                         arguments.frames == 1 ? "" : fmt::format(" in {} of {} pictures", empty, arguments.frames)));
    return kDone;
}

}  // namespace

Action connectRender(Command& command) {
    auto arguments = std::make_shared<RenderArguments>();
    command.set("input", arguments->input);
    command.set("--output", arguments->output);
    arguments->scene.connect(command);
    command.set("--write-scene", arguments->sceneOutput);
    command.set("--frames", arguments->frames);
    command.set("--gl", arguments->gl);
    command.set("--labels", arguments->labelOutput);
    command.set("--depth", arguments->depthOutput);
    command.set("--verbose", arguments->verbose);
    arguments->build.connect(command);
    return [arguments] { return runRender(*arguments); };
}

}  // namespace svt::cli
