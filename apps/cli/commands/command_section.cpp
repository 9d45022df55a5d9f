#include <apps/cli/cli.hpp>

#include <svt/core/file.hpp>
#include <svt/illustrate/section_drawing.hpp>
#include <svt/writers/dxf_drawing.hpp>
#include <svt/writers/geojson_drawing.hpp>
#include <svt/writers/section_table.hpp>
#include <svt/writers/svg_drawing.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace svt::cli {
namespace {

struct Arguments {
    std::filesystem::path input;
    std::vector<std::filesystem::path> outputs, tables;
    std::string plane, scale = "1:100";
    std::vector<std::string> show, hide;
    double minArea = 0.0001;
    bool noRooms = false, json = false, verbose = false;
    BuildArguments build;
};

// "1:50" or "50".
Result<double> parseScale(const std::string& text) {
    const std::string number = text.rfind("1:", 0) == 0 ? text.substr(2) : text;
    char* rest = nullptr;
    const double scale = std::strtod(number.c_str(), &rest);
    if (number.empty() || *rest != '\0' || !(scale >= 0.01 && scale <= 1e7))
        return Error(Code::BadArgument,
                     fmt::format("--scale '{}': expected 1:N with N from 0.01 to 10000000, such as 1:50", text));
    return scale;
}

Result<void> checkOutputs(const Arguments& arguments) {
    for (const std::filesystem::path& path : arguments.outputs)
        if (const std::string e = path.extension().string(); e != ".svg" && e != ".dxf" && e != ".geojson")
            return Error(Code::BadArgument, fmt::format("-o '{}': cannot write '{}'; possible are .svg, .dxf, .geojson",
                                                        path.string(), e));
    for (const std::filesystem::path& path : arguments.tables)
        if (const std::string e = path.extension().string(); e != ".json" && e != ".csv")
            return Error(Code::BadArgument,
                         fmt::format("--table '{}': cannot write '{}'; possible are .json, .csv", path.string(), e));
    if (arguments.outputs.empty() && arguments.tables.empty() && !arguments.json)
        return Error(Code::BadArgument, "nothing to write; give -o D.svg, --table T.csv or --json");
    return {};
}

Result<std::uint64_t> writeDrawing(const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                   const std::filesystem::path& path, double scale) {
    const std::string extension = path.extension().string();
    if (extension == ".dxf") return writers::writeDxf(drawing, volume, path);
    if (extension == ".geojson") return writers::writeGeojson(drawing, volume, path);
    writers::SvgOptions options;
    options.scale = scale;
    return writers::writeSvg(drawing, volume, path, options);
}

int runSection(const Arguments& arguments) {
    if (auto checked = checkOutputs(arguments); !checked) return fail(checked.error());
    const auto scale = parseScale(arguments.scale);
    if (!scale) return fail(scale.error());
    Diagnostics diagnostics;
    const TerminalProgress progress;
    const auto volume = loadVolume(arguments.input, arguments.build, progress.get(), diagnostics);
    printDiagnostics(diagnostics, arguments.verbose);
    if (!volume) return fail(volume.error());
    const auto plane = arguments.plane.empty() ? illustrate::defaultSectionPlane(*volume)
                                               : illustrate::parseSectionPlane(arguments.plane, *volume);
    if (!plane) return fail(plane.error());
    illustrate::SectionOptions options;
    options.show = arguments.show;
    options.hide = arguments.hide;
    options.spaces = !arguments.noRooms;
    options.smallestArea = arguments.minArea;
    options.threads = arguments.build.threads;
    const auto drawing = illustrate::drawSection(*volume, *plane, options);
    if (!drawing) return fail(drawing.error());
    if (drawing->components.empty())
        return fail(Error(Code::BadSection,
                          fmt::format("the plane '{}' cuts nothing that is shown; move it, or see --show, --hide, "
                                      "--no-rooms and --min-area",
                                      arguments.plane.empty() ? "1.1 m above the lowest floor" : arguments.plane)));
    for (const std::filesystem::path& path : arguments.outputs)
        if (auto written = writeDrawing(*drawing, *volume, path, *scale); !written) return fail(written.error());
    for (const std::filesystem::path& path : arguments.tables) {
        const std::string text = path.extension() == ".csv" ? writers::makeSectionCsv(*drawing, *volume)
                                                            : writers::makeSectionJson(*drawing, *volume);
        if (auto written = writeFileAtomically(path, text); !written) return fail(written.error());
    }
    if (arguments.json) fmt::print("{}", writers::makeSectionJson(*drawing, *volume));
    return kDone;
}

}  // namespace

Run addSectionCommand(CLI::App& app) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("section", "Draw what a plane cuts (SVG, DXF, GeoJSON)");
    command->add_option("input", arguments->input, "a .svt or a model file")->required();
    command
        ->add_option("-o,--output", arguments->outputs, "the drawing to write: .svg, .dxf or .geojson; may be repeated")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("D.svg");
    command
        ->add_option("--plane", arguments->plane,
                     "z=1.2, y<3, x>4, storey=EG+1.1, or A,B,C,D; metres from the lower corner; default: 1.1 m above "
                     "the floor of the lowest storey, or the middle")
        ->group("Drawing");
    command->add_option("--scale", arguments->scale, "of the SVG: 1:50 draws 1 m as 20 mm")
        ->group("Drawing")
        ->capture_default_str();
    command->add_option("--hide", arguments->hide, "leave out what the query selects; may be repeated")
        ->group("Drawing")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("QUERY");
    command->add_option("--show", arguments->show, "draw only what the query selects; may be repeated")
        ->group("Drawing")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("QUERY");
    command->add_flag("--no-rooms", arguments->noRooms, "leave out rooms, units and storeys")->group("Drawing");
    command->add_option("--min-area", arguments->minArea, "leave out polygons smaller than this, m2")
        ->group("Drawing")
        ->check(CLI::Range(0.0, 1e9))
        ->capture_default_str();
    command->add_option("--table", arguments->tables, "areas per component and class: .json or .csv; may be repeated")
        ->group("Output")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("T.csv");
    command->add_flag("--json", arguments->json, "print the areas as JSON on stdout")->group("Output");
    command->add_flag("-v,--verbose", arguments->verbose, "show all findings")->group("Output");
    arguments->build.addTo(*command);
    return [arguments] { return runSection(*arguments); };
}

}  // namespace svt::cli
