#include "cli.hpp"
#include "scene_options.hpp"

#include <svt/core/file.hpp>
#include <svt/illustrate/scene_painter.hpp>
#include <svt/render/png.hpp>

#include <fmt/format.h>

namespace svt::cli {
namespace {

struct Arguments {
    std::filesystem::path input, output, labelOutput, depthOutput, sceneOutput;
    BuildArguments build;
    SceneArguments scene;
    int frames = 1;
    bool verbose = false;
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
    illustrate::ScenePainter painter(*volume, arguments.build.threads);
    for (int frame = 0; frame < arguments.frames; ++frame) {
        const auto scene = arguments.scene.toScene(frame, arguments.frames);
        if (!scene) return fail(scene.error());
        const auto painting = painter.paint(*scene, options);
        if (!painting) return fail(painting.error());
        if (auto written = writeBuffers(painting->frame, arguments, frame); !written) return fail(written.error());
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
