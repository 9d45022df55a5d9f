#include "cli.hpp"
#include "render_vectors.hpp"

#include <svt/illustrate/section_plane.hpp>
#include <svt/illustrate/selection.hpp>
#include <svt/pipeline/style_sheet.hpp>
#include <svt/render/camera_presets.hpp>
#include <svt/render/png.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/lod_pyramid.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <optional>

namespace svt::cli {
namespace {

struct Arguments {
    std::filesystem::path input, output, labelOutput, depthOutput;
    BuildArguments build;
    VectorArguments vectors;
    std::string camera = "iso", size = "1280x720", background = "white";
    std::vector<std::string> hide, show, color, opacity, section;
    std::vector<double> eye, target;
    int samples = 4;
    std::optional<int> level;
    double edges = 0.5, fov = 30, zoom = 1;
    bool orthographic = false, transparent = false, verbose = false;
};

// "query:value", split at the last colon (or equals sign) behind which there is a value.
Result<std::pair<std::string, std::string>> splitValue(const std::string& text, std::string_view option,
                                                       std::string_view example) {
    std::size_t at = text.rfind(':');
    if (at == std::string::npos) at = text.rfind('=');
    if (at == std::string::npos || at == 0 || at + 1 == text.size())
        return Error(Code::BadArgument,
                     fmt::format("{} '{}': expected a query, a colon and a value, such as {}", option, text, example));
    return std::pair(text.substr(0, at), text.substr(at + 1));
}

Result<Vec3i> parseSize(const std::string& text) {
    const auto triple = [&]() -> Result<Vec3d> {
        const std::size_t at = text.find_first_of("xX,");
        if (at == std::string::npos)
            return Error(Code::BadFrame, fmt::format("--size '{}': expected pixels such as 1280x720", text));
        return parseTriple(text.substr(0, at) + "," + text.substr(at + 1) + ",1", "--size", "pixels");
    }();
    if (!triple) return Error(Code::BadFrame, fmt::format("--size '{}': expected pixels such as 1280x720", text));
    const auto inRange = [](double v) { return v >= 1 && v <= render::FrameSpec::kMaxSize && v == std::floor(v); };
    if (!inRange(triple->x) || !inRange(triple->y))
        return Error(Code::BadFrame, fmt::format("--size '{}': 1 to {} pixels along a side are possible", text,
                                                 render::FrameSpec::kMaxSize));
    return Vec3i{static_cast<std::int32_t>(triple->x), static_cast<std::int32_t>(triple->y), 1};
}

Result<std::vector<render::Style>> makeStyles(const volume::LabelTable& table, const Arguments& arguments) {
    std::vector<Vec3f> colors(table.labels.size());
    std::vector<float> opacities(table.labels.size());
    std::vector<std::uint8_t> isRecolored(table.labels.size(), 0);
    for (std::size_t l = 0; l < table.labels.size(); ++l) {
        colors[l] = table.labels[l].color;
        opacities[l] = table.labels[l].opacity;
    }
    if (!arguments.show.empty()) {
        std::vector<std::uint8_t> isShown(table.labels.size(), 0);
        for (const std::string& query : arguments.show) {
            const auto selected = illustrate::selectLabels(table, query);
            if (!selected) return selected.error();
            for (const std::uint32_t l : *selected) isShown[l] = 1;
        }
        for (std::size_t l = 0; l < isShown.size(); ++l)
            if (!isShown[l]) opacities[l] = 0;
    }
    for (const std::string& query : arguments.hide) {
        const auto selected = illustrate::selectLabels(table, query);
        if (!selected) return selected.error();
        for (const std::uint32_t l : *selected) opacities[l] = 0;
    }
    for (const std::string& text : arguments.color) {
        const auto parts = splitValue(text, "--color", "'name=\"Unterzug-1\":red'");
        if (!parts) return parts.error();
        const auto color = pipeline::parseColor(parts->second);
        if (!color) return Error(Code::BadArgument, "--color: " + color.error().message());
        const auto selected = illustrate::selectLabels(table, parts->first);
        if (!selected) return selected.error();
        for (const std::uint32_t l : *selected) {
            colors[l] = *color;
            isRecolored[l] = 1;
        }
    }
    for (const std::string& text : arguments.opacity) {
        const auto parts = splitValue(text, "--opacity", "'class=BuildingRoom:0.2'");
        if (!parts) return parts.error();
        char* rest = nullptr;
        const double value = std::strtod(parts->second.c_str(), &rest);
        if (*rest != '\0' || !(value >= 0 && value <= 1))
            return Error(Code::BadArgument,
                         fmt::format("--opacity '{}': {} is out of range; 0 to 1 (share of light stopped by 1 m)", text,
                                     parts->second));
        const auto selected = illustrate::selectLabels(table, parts->first);
        if (!selected) return selected.error();
        for (const std::uint32_t l : *selected) opacities[l] = static_cast<float>(value);
    }
    std::vector<render::Style> styles(table.scalarCount());
    styles[0].opacity = 0;
    for (std::size_t l = 0; l < table.labels.size(); ++l)
        for (volume::Scalar s = 0; s < table.labels[l].count; ++s) {
            const volume::Scalar scalar = table.labels[l].first + s;
            const bool hasPhase = !isRecolored[l] && table.labels[l].count > 1 && scalar < table.phaseColors.size();
            // A recoloured pattern keeps its joints as a darker shade.
            styles[scalar].color =
                hasPhase ? table.phaseColors[scalar] : colors[l] * (1.0f / (1.0f + 0.35f * float(s)));
            styles[scalar].opacity = opacities[l];
        }
    return styles;
}

Result<render::Camera> makeCamera(const volume::Grid& grid, const Arguments& arguments, Vec3i size) {
    if (!(arguments.fov > 0 && arguments.fov < 180))
        return Error(Code::BadCamera,
                     fmt::format("--fov {}: out of range; above 0 and below 180 degrees are possible", arguments.fov));
    render::PresetOptions options;
    options.aspect = double(size.x) / size.y;
    options.projection =
        arguments.orthographic ? render::Camera::Projection::Orthographic : render::Camera::Projection::Perspective;
    options.verticalFovDegrees = arguments.fov;
    auto camera = render::cameraPreset(arguments.camera, grid, options);
    if (!camera) return camera;
    // Given points are metres from the lower corner of the grid.
    if (arguments.eye.size() == 3)
        camera->eye = grid.origin() + Vec3d{arguments.eye[0], arguments.eye[1], arguments.eye[2]};
    if (arguments.target.size() == 3)
        camera->target = grid.origin() + Vec3d{arguments.target[0], arguments.target[1], arguments.target[2]};
    camera->eye = camera->target + (camera->eye - camera->target) / arguments.zoom;
    camera->orthographicHeight /= arguments.zoom;
    return camera;
}

Result<void> writeBuffers(const render::Frame& frame, const Arguments& arguments) {
    if (auto written = render::writePng(arguments.output, frame.color); !written) return written;
    if (!arguments.labelOutput.empty()) {
        const auto gray = render::grayFromLabels(frame.label);
        if (!gray) return gray.error();
        if (auto written = render::writePng(arguments.labelOutput, *gray); !written) return written;
    }
    if (!arguments.depthOutput.empty())
        return render::writePng(arguments.depthOutput, render::grayFromDepth(frame.depth, 0.001));
    return {};
}

int runRender(const Arguments& arguments) {
    const auto size = parseSize(arguments.size);
    if (!size) return fail(size.error());
    Diagnostics diagnostics;
    const TerminalProgress progress;
    const auto volume =
        loadVolume(arguments.input, arguments.vectors.forBuild(arguments.build), progress.get(), diagnostics);
    printDiagnostics(diagnostics, arguments.verbose);
    if (!volume) return fail(volume.error());
    render::FrameSpec spec;
    spec.width = size->x;
    spec.height = size->y;
    spec.samplesPerPixel = arguments.samples;
    spec.edges = static_cast<float>(arguments.edges);
    if (arguments.transparent) {
        spec.background.alpha = 0;
    } else {
        const auto background = pipeline::parseColor(arguments.background);
        if (!background) return fail(Error(Code::BadArgument, "--background: " + background.error().message()));
        spec.background.top = spec.background.bottom = *background;
    }
    const auto camera = makeCamera(volume->grid, arguments, *size);
    if (!camera) return fail(camera.error());
    spec.camera = *camera;
    auto styles = makeStyles(volume->labels, arguments);
    if (!styles) return fail(styles.error());
    render::Pass pass;
    pass.styles = std::move(*styles);
    for (const std::string& text : arguments.section) {
        const auto plane = illustrate::parseSectionPlane(text, *volume);
        if (!plane) return fail(plane.error());
        pass.clips.push_back(render::ClipRegion::plane(plane->normal, plane->point));
    }
    if (auto added = arguments.vectors.apply(*volume, pass); !added) return fail(added.error());
    spec.passes.push_back(std::move(pass));
    // Lines are drawn between objects, not between the phases of one object's pattern.
    spec.objectOfScalar = volume->labels.labelOfScalar();
    for (std::uint32_t& object : spec.objectOfScalar) ++object;

    render::CastOptions options;
    options.threads = arguments.build.threads;
    options.progress = progress.get();
    options.isAdaptive = true;
    const int level = arguments.level ? *arguments.level : render::levelForView(spec, volume->grid);
    const auto frame = [&]() -> Result<render::Frame> {
        if (level > 0) {
            const auto levels = volume::buildLodPyramid(volume->columns, volume->grid, level, arguments.build.threads);
            if (!levels) return levels.error();
            if (!levels->empty()) return render::castRays(levels->back(), spec, options);
        }
        const auto bricks = volume::BrickVolume::fromColumns(volume->columns, arguments.build.threads);
        if (!bricks) return bricks.error();
        return render::castRays(*bricks, volume->grid, spec, options);
    }();
    if (!frame) return fail(frame.error());
    if (auto written = writeBuffers(*frame, arguments); !written) return fail(written.error());
    return kDone;
}

}  // namespace

Run addRenderCommand(CLI::App& app) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("render", "Draw a picture (PNG) of a volume or model");
    command->add_option("input", arguments->input, "a .svt or a model file")->required();
    command->add_option("-o,--output", arguments->output, "the picture to write")->required()->type_name("P.png");
    std::string names;
    for (const std::string_view name : render::cameraPresetNames())
        names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
    command->add_option("--camera", arguments->camera, "one of " + names)->group("View")->capture_default_str();
    command->add_flag("--ortho", arguments->orthographic, "parallel projection")->group("View");
    command->add_option("--eye", arguments->eye, "where the viewer stands, metres from the lower corner of the model")
        ->group("View")
        ->expected(3)
        ->delimiter(',');
    command
        ->add_option("--target", arguments->target,
                     "what stands in the middle of the picture, metres from the lower corner")
        ->group("View")
        ->expected(3)
        ->delimiter(',');
    command->add_option("--fov", arguments->fov, "vertical field of view, degrees, above 0 and below 180")
        ->group("View")
        ->capture_default_str();
    command->add_option("--zoom", arguments->zoom, "nearer (above 1) or further than the preset, 0.01 to 100")
        ->group("View")
        ->check(CLI::Range(0.01, 100.0))
        ->capture_default_str();
    command->add_option("--size", arguments->size, "width x height in pixels, 1 to 16384")
        ->group("View")
        ->capture_default_str();
    command->add_option("--samples", arguments->samples, "rays per pixel: 1, 4, 9 or 16")
        ->group("View")
        ->check(CLI::IsMember({1, 4, 9, 16}))
        ->capture_default_str();
    command
        ->add_option("--section", arguments->section,
                     "cut away: z=1.2 or z>1.2 (above), y<3 (before), storey=EG+1.1, or A,B,C,D; metres from the lower "
                     "corner; may be repeated")
        ->group("View")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->add_option("--hide", arguments->hide, "hide what the query selects; may be repeated")
        ->group("Style")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("QUERY");
    command->add_option("--show", arguments->show, "show only what the query selects; may be repeated")
        ->group("Style")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("QUERY");
    command
        ->add_option("--color", arguments->color, "colour by query, such as 'name=\"Unterzug-1\":red'; may be repeated")
        ->group("Style")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("QUERY:COLOR");
    command
        ->add_option("--opacity", arguments->opacity,
                     "share of light stopped by 1 m, 0 to 1, by query; may be repeated")
        ->group("Style")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("QUERY:VALUE");
    command->add_option("--edges", arguments->edges, "strength of lines between objects, 0 to 1")
        ->group("Style")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    command->add_option("--background", arguments->background, "#rrggbb or a colour name")
        ->group("Style")
        ->capture_default_str();
    command->add_flag("--transparent", arguments->transparent, "leave the background transparent")->group("Style");
    command
        ->add_option("--level", arguments->level,
                     "level of detail, 0 (finest) to 6; default: as fine as the pixels show")
        ->group("Style")
        ->check(CLI::Range(0, 6));
    command->add_option("--labels", arguments->labelOutput, "also write the scalar of each pixel, 16-bit gray")
        ->group("Output")
        ->type_name("L.png");
    command
        ->add_option("--depth", arguments->depthOutput,
                     "also write the depth of each pixel in millimetres, 16-bit gray")
        ->group("Output")
        ->type_name("D.png");
    command->add_flag("-v,--verbose", arguments->verbose, "show all findings")->group("Output");
    arguments->vectors.addTo(*command);
    arguments->build.addTo(*command);
    return [arguments] { return runRender(*arguments); };
}

}  // namespace svt::cli
