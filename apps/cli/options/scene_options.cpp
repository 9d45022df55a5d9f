#include <apps/cli/options/scene_options.hpp>

#include <apps/cli/cli.hpp>

#include <svt/core/file.hpp>
#include <svt/image/color_text.hpp>
#include <svt/render/camera_presets.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace svt::cli {
namespace {

using illustrate::Context;
using illustrate::Scene;

// Splits "query:value" at the last colon (or equals sign) that is followed by a value.
Result<std::pair<std::string, std::string>> splitValue(const std::string& text, std::string_view option,
                                                       std::string_view example) {
    std::size_t at = text.rfind(':');
    if (at == std::string::npos) at = text.rfind('=');
    if (at == std::string::npos || at == 0 || at + 1 == text.size())
        return Error(Code::BadArgument,
                     fmt::format("{} '{}': expected a query, a colon and a value, such as {}", option, text, example));
    return std::pair(text.substr(0, at), text.substr(at + 1));
}

constexpr int kDefaultDpi = 300;

bool isMetric(const std::string& size) { return size.size() > 2 && size.compare(size.size() - 2, 2, "mm") == 0; }

// "1280x720" pixels, or "160x90mm" at `dpi`.
Result<void> parseSize(const std::string& text, int dpi, Scene& scene) {
    const auto bad = [&] {
        return Error(Code::BadFrame,
                     fmt::format("--size '{}': expected pixels such as 1280x720, or 160x90mm for print", text));
    };
    const bool inPrint = isMetric(text);
    const std::string numbers = inPrint ? text.substr(0, text.size() - 2) : text;
    const std::size_t at = numbers.find_first_of("xX,");
    if (at == std::string::npos) return bad();
    const auto triple = parseTriple(numbers.substr(0, at) + "," + numbers.substr(at + 1) + ",1", "--size", "pixels");
    if (!triple) return bad();
    const double width = inPrint ? std::round(triple->x * dpi / 25.4) : triple->x;
    const double height = inPrint ? std::round(triple->y * dpi / 25.4) : triple->y;
    const auto inRange = [](double v) { return v >= 1 && v <= render::FrameSpec::kMaxSize && v == std::floor(v); };
    if (!inRange(width) || !inRange(height))
        return Error(Code::BadFrame, fmt::format("--size '{}': 1 to {} pixels along a side are possible", text,
                                                 render::FrameSpec::kMaxSize));
    scene.width = static_cast<std::int32_t>(width);
    scene.height = static_cast<std::int32_t>(height);
    return {};
}

// Interpolates "z=0..6" for the frame; other texts are unchanged.
Result<std::string> movedSection(const std::string& text, int frame, int frames) {
    const std::size_t dots = text.find("..");
    if (dots == std::string::npos) return text;
    const std::size_t begin = text.find_last_of("=<>+", dots);
    const auto bad = [&] {
        return Error(Code::BadArgument,
                     fmt::format("--section '{}': expected two numbers such as z=0..6 for a plane that moves", text));
    };
    if (begin == std::string::npos) return bad();
    char* rest = nullptr;
    const std::string first = text.substr(begin + 1, dots - begin - 1), last = text.substr(dots + 2);
    const double from = std::strtod(first.c_str(), &rest);
    if (first.empty() || *rest != '\0') return bad();
    const double to = std::strtod(last.c_str(), &rest);
    if (last.empty() || *rest != '\0') return bad();
    if (frames < 2)
        return Error(Code::BadArgument,
                     fmt::format("--section '{}' moves; --frames says in how many pictures, 2 or more", text));
    return fmt::format("{}{:.6g}", text.substr(0, begin + 1), from + (to - from) * frame / (frames - 1));
}

Result<void> addStyles(const SceneArguments& arguments, illustrate::ScenePass& pass) {
    for (const std::string& text : arguments.color) {
        const auto parts = splitValue(text, "--color", "'name=\"Unterzug-1\":red'");
        if (!parts) return parts.error();
        const auto color = image::parseColor(parts->second);
        if (!color) return Error(Code::BadArgument, "--color: " + color.error().message());
        pass.styles.push_back({parts->first, *color, {}, {}, false});
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
        pass.styles.push_back({parts->first, {}, static_cast<float>(value), {}, false});
    }
    for (const std::string& text : arguments.hatchOf) {
        const auto parts = splitValue(text, "--hatch-of", "'class=WallSurface:insulation'");
        if (!parts) return parts.error();
        const auto hatch = render::hatchFromName(parts->second);
        if (!hatch)
            return Error(Code::BadArgument, fmt::format("--hatch-of '{}': '{}' is no hatch; possible are {}", text,
                                                        parts->second, fmt::join(render::hatchNames(), ", ")));
        pass.styles.push_back({parts->first, {}, {}, *hatch, false});
    }
    return {};
}

Result<void> addVectors(const SceneArguments& arguments, illustrate::ScenePass& pass) {
    pass.meshes.insert(pass.meshes.end(), arguments.meshes.begin(), arguments.meshes.end());
    if (!arguments.wireframe) return {};
    illustrate::SceneLines lines;
    lines.select = *arguments.wireframe;
    if (arguments.wireWidth) lines.width = static_cast<float>(*arguments.wireWidth);
    if (arguments.wireColor) {
        const auto color = image::parseColor(*arguments.wireColor);
        if (!color) return Error(Code::BadArgument, "--wire-color: " + color.error().message());
        lines.color = *color;
    }
    lines.hidden = arguments.hiddenLines == "dashed" ? render::HiddenLines::Dashed
                   : arguments.hiddenLines == "none" ? render::HiddenLines::None
                                                     : render::HiddenLines::Faint;
    pass.lines.push_back(lines);
    return {};
}

std::string either(const std::string& a, const std::string& b) {
    return a.empty() || b.empty() ? a + b : fmt::format("{} or {}", a, b);
}

// A plane of a region, quoted in case its storey name contains blanks.
std::string quoted(const std::string& plane) {
    const bool needsQuotes =
        plane.find_first_of(" ()") != std::string::npos && plane.find_first_of("\"'") == std::string::npos;
    return needsQuotes ? fmt::format("'{}'", plane) : plane;
}

Result<void> addPass(const SceneArguments& arguments, int frame, int frames, Scene& scene) {
    illustrate::ScenePass& pass = scene.passes.front();
    pass.show.insert(pass.show.end(), arguments.show.begin(), arguments.show.end());
    pass.hide.insert(pass.hide.end(), arguments.hide.begin(), arguments.hide.end());
    if (auto added = addStyles(arguments, pass); !added) return added;
    if (auto added = addVectors(arguments, pass); !added) return added;
    std::string section;
    for (const std::string& text : arguments.sections) {
        const auto moved = movedSection(text, frame, frames);
        if (!moved) return moved.error();
        section = either(section, quoted(*moved));
    }
    if (!arguments.keep.empty()) pass.keep = arguments.keep;
    if (!arguments.cut.empty()) pass.cut = either(pass.cut, fmt::format("({})", arguments.cut));
    // With a lens, sections cut only inside it.
    if (arguments.lens.empty()) pass.cut = either(pass.cut, section);
    if (!arguments.shell.empty()) pass.form.shell = illustrate::shellLevelFromName(arguments.shell);
    const Context context = arguments.context == "ghost"   ? Context::Ghost
                            : arguments.context == "solid" ? Context::Solid
                            : arguments.context == "shell" ? Context::Shell
                                                           : Context::None;
    if (!arguments.lens.empty()) addLens(scene, arguments.lens, section, context);
    if (!arguments.highlights.empty()) addHighlight(scene, arguments.highlights, context);
    if (!arguments.cutaway.empty()) addCutaway(scene, arguments.cutaway, 0.15);
    if (arguments.contextLevel && scene.passes.size() == 2) scene.passes.front().form.level = arguments.contextLevel;
    for (illustrate::ScenePass& any : scene.passes)
        if (arguments.level && !any.form.level) any.form.level = arguments.level;
    return {};
}

Result<Scene> readScene(const std::filesystem::path& file) {
    constexpr std::size_t kMaxBytes = std::size_t{16} << 20;
    const auto mapped = MappedFile::open(file);
    if (!mapped) return mapped.error();
    if (mapped->bytes().size() > kMaxBytes)
        return Error(Code::InputTooBig, fmt::format("{}: a scene of more than 16 MiB", file.string()));
    return illustrate::parseScene(mapped->text(), file.string());
}

}  // namespace

int SceneArguments::printedDpi() const { return dpi ? *dpi : size && isMetric(*size) ? kDefaultDpi : 0; }

Result<Scene> SceneArguments::toScene(int frame, int frames) const {
    Scene scene;
    if (!sceneFile.empty()) {
        auto read = readScene(sceneFile);
        if (!read) return read;
        scene = std::move(*read);
    }
    if (size)
        if (auto parsed = parseSize(*size, dpi.value_or(kDefaultDpi), scene); !parsed) return parsed.error();
    if (samples) scene.samples = *samples;
    if (look) scene.look = *illustrate::lookFromName(*look);
    if (camera) scene.camera.preset = *camera;
    if (!around.empty()) scene.camera.around = around;
    if (isParallel) scene.camera.isParallel = true;
    if (fov) scene.camera.fieldOfView = *fov;
    if (zoom) scene.camera.zoom = *zoom;
    if (eye.size() == 3) scene.camera.eye = Vec3d{eye[0], eye[1], eye[2]};
    if (target.size() == 3) scene.camera.target = Vec3d{target[0], target[1], target[2]};
    if (background) {
        const auto parsed = image::parseColor(*background);
        if (!parsed) return Error(Code::BadArgument, "--background: " + parsed.error().message());
        scene.background = *parsed;
    }
    if (isTransparent) scene.isTransparent = true;
    const auto narrow = [](double value) { return static_cast<float>(value); };
    if (edges) scene.lineStrength = narrow(*edges);
    if (lineWidth) scene.lineWidth = narrow(*lineWidth);
    if (cutWidth) scene.cutWidth = narrow(*cutWidth);
    if (hasHatches) scene.hasHatches = true;
    if (hatchSpacing) scene.hatchSpacing = hatchSpacing;
    scene.names.insert(scene.names.end(), names.begin(), names.end());
    if (auto added = addPass(*this, frame, frames, scene); !added) return added.error();
    return scene;
}

void SceneArguments::addTo(CLI::App& command) {
    const auto list = [&](const char* name, std::vector<std::string>& to, const char* what, const char* group,
                          const char* type) {
        command.add_option(name, to, what)
            ->group(group)
            ->expected(1)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
            ->type_name(type);
    };
    const std::string presets = fmt::format("{}", fmt::join(render::cameraPresetNames(), ", "));
    command.add_option("--camera", camera, "one of " + presets + "; default: iso")->group("View");
    command.add_option("--around", around, "the view shows what the query selects, as large as it fits")
        ->group("View")
        ->type_name("QUERY");
    command.add_flag("--ortho", isParallel, "parallel projection")->group("View");
    command.add_option("--eye", eye, "where the viewer stands, metres from the lower corner of the model")
        ->group("View")
        ->expected(3)
        ->delimiter(',');
    command.add_option("--target", target, "what stands in the middle of the picture, metres from the lower corner")
        ->group("View")
        ->expected(3)
        ->delimiter(',');
    command.add_option("--fov", fov, "vertical field of view, degrees, above 0 and below 180; default: 30")
        ->group("View");
    command.add_option("--zoom", zoom, "nearer (above 1) or further than the preset, 0.01 to 100")
        ->group("View")
        ->check(CLI::Range(0.01, 100.0));
    command.add_option("--size", size, "width x height in pixels, or such as 160x90mm; default: 1280x720")
        ->group("View");
    command.add_option("--dpi", dpi, "pixels an inch, for sizes in mm and written to the picture; default: 300")
        ->group("View")
        ->check(CLI::Range(1, 4800));
    command.add_option("--samples", samples, "rays per pixel: 1, 4, 9 or 16; default: 4")
        ->group("View")
        ->check(CLI::IsMember({1, 4, 9, 16}));
    list("--section", sections,
         "cut away: z=1.2 or z>1.2 (above), y<3 (before), storey=EG+1.1, or A,B,C,D; metres from the lower corner; "
         "z=0..6 moves with --frames; may be repeated",
         "Cut", "PLANE");
    command.add_option("--cut", cut, "cut away a region, such as 'z>1.2 and not box(2,2,0,4,4,3)'")
        ->group("Cut")
        ->type_name("REGION");
    command.add_option("--keep", keep, "draw nothing outside of a region, such as storey(EG)")
        ->group("Cut")
        ->type_name("REGION");
    CLI::Option* lensOption =
        command
            .add_option("--lens", lens, "S-Lens: in this region the model is cut by --section, the rest is the context")
            ->group("Illustrate")
            ->type_name("REGION");
    list("--highlight", highlights, "the selected, lit whatever stands in front; the rest is the context", "Illustrate",
         "QUERY");
    CLI::Option* cutawayOption =
        command.add_option("--cutaway", cutaway, "take away what hides the selected, and no more than that")
            ->group("Illustrate")
            ->type_name("QUERY");
    CLI::Option* highlightOption = command.get_option("--highlight");
    lensOption->excludes(highlightOption)->excludes(cutawayOption);
    highlightOption->excludes(cutawayOption);
    command.add_option("--context", context, "what is around a lens or highlight: ghost, solid, shell or none")
        ->group("Illustrate")
        ->check(CLI::IsMember({"ghost", "solid", "shell", "none"}))
        ->capture_default_str();
    command
        .add_option("--context-level", contextLevel,
                    "level of detail of what is around a lens, highlight or cutaway, 0 (finest) to 6")
        ->group("Illustrate")
        ->check(CLI::Range(0, 6));
    command.add_option("--shell", shell, "draw only the hulls of components, rooms, units, storeys or the building")
        ->group("Illustrate")
        ->check(CLI::IsMember({"component", "room", "unit", "storey", "building"}));
    list("--names", names, "name the selected at the sides of the picture, with leader lines; may be repeated",
         "Illustrate", "QUERY");
    command
        .add_option_function<std::string>(
            "--wireframe", [this](const std::string& text) { wireframe = text; },
            "draw the edges of what the query selects, at their depth inside the volume; without a query: of all that "
            "is visible")
        ->group("Lines")
        ->expected(0, 1)
        ->default_str("")
        ->type_name("QUERY");
    command.add_option("--hidden-lines", hiddenLines, "lines behind something opaque")
        ->group("Lines")
        ->check(CLI::IsMember({"faint", "dashed", "none"}))
        ->capture_default_str();
    command.add_option("--wire-width", wireWidth, "pixels, 0.1 to 64; default: 1")
        ->group("Lines")
        ->check(CLI::Range(0.1, 64.0));
    command.add_option("--wire-color", wireColor, "#rrggbb or a colour name")->group("Lines");
    list("--vectors", meshes,
         "draw what the query selects as meshes, not as voxels; size<M: all that is shorter than M metres along each "
         "axis; may be repeated",
         "Lines", "QUERY");
    list("--hide", hide, "hide what the query selects; may be repeated", "Style", "QUERY");
    list("--show", show, "show only what the query selects; may be repeated", "Style", "QUERY");
    list("--color", color, "colour by query, such as 'name=\"Unterzug-1\":red'; may be repeated", "Style",
         "QUERY:COLOR");
    list("--opacity", opacity, "share of light stopped by 1 m, 0 to 1, by query; may be repeated", "Style",
         "QUERY:VALUE");
    command.add_option("--look", look, "plain, paper (for print), blueprint or dark; default: plain")
        ->group("Style")
        ->check(CLI::IsMember({"plain", "paper", "blueprint", "dark"}));
    command
        .add_flag("--hatch", hasHatches, "hatch what is cut, by material or class; paper and blueprint do so anyway")
        ->group("Style");
    list("--hatch-of", hatchOf,
         "hatch by query: masonry, concrete, reinforced-concrete, timber, insulation, earth, "
         "steel, glass, general or none; may be repeated",
         "Style", "QUERY:HATCH");
    command.add_option("--hatch-spacing", hatchSpacing, "distance of hatch lines, metres; default: about 10 pixels")
        ->group("Style")
        ->check(CLI::Range(0.0001, 10000.0));
    command.add_option("--edges", edges, "strength of lines between objects, 0 to 1; default: 0.5")
        ->group("Style")
        ->check(CLI::Range(0.0, 1.0));
    command.add_option("--line-width", lineWidth, "width of lines between objects, pixels, 0 to 16; default: 1")
        ->group("Style")
        ->check(CLI::Range(0.0, 16.0));
    command.add_option("--cut-width", cutWidth, "width of lines around what is cut, pixels, 0 to 16; default: by look")
        ->group("Style")
        ->check(CLI::Range(0.0, 16.0));
    command.add_option("--level", level, "level of detail, 0 (finest) to 6; default: as fine as the pixels show")
        ->group("Style")
        ->check(CLI::Range(0, 6));
    command.add_option("--background", background, "#rrggbb or a colour name; default: by look")->group("Style");
    command.add_flag("--transparent", isTransparent, "leave the background transparent")->group("Style");
    command.add_option("--scene", sceneFile, "scene file; the other options change it")
        ->group("Scene")
        ->type_name("S.scene.json");
}

}  // namespace svt::cli
