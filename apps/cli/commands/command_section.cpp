#include <apps/cli/city/city_input.hpp>
#include <apps/cli/city/city_section.hpp>
#include <apps/cli/options/build_options.hpp>
#include <apps/cli/options/command_line.hpp>
#include <apps/cli/options/paper_scale.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/core/file.hpp>
#include <svt/illustrate/section_drawing.hpp>
#include <svt/writers/dxf_drawing.hpp>
#include <svt/writers/geojson_drawing.hpp>
#include <svt/writers/section_table.hpp>
#include <svt/writers/sheet_writer.hpp>
#include <svt/writers/svg_drawing.hpp>
#include <svt/writers/view_drawing.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {
namespace {

struct SectionArguments {
    std::filesystem::path input;
    std::vector<std::filesystem::path> outputs, tables;
    std::string plane, elevation, scale;
    std::vector<std::string> show, hide;
    double minArea = 0;
    illustrate::BeyondOptions beyond;
    writers::DxfOptions dxf;
    bool dimensions = false, noRooms = false, json = false, verbose = false;
    BuildArguments build;
};

Result<std::uint64_t> writeDrawing(const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                   const std::filesystem::path& path, double scale, const writers::DxfOptions& dxf) {
    const std::string ending = endingOf(path);
    if (ending == ".dxf") return writers::writeDxf(drawing, volume, path, dxf);
    if (ending == ".geojson") return writers::writeGeojson(drawing, volume, path);
    if (ending == ".pdf") {
        SVT_TRY(pdf, writers::makeSectionPdf(drawing, volume, scale));
        if (!writers::missingPdfLayers().empty()) note(writers::missingPdfLayers());
        return writeFileAtomically(path, *pdf);
    }
    writers::SvgOptions options;
    options.scale = scale;
    return writers::writeSvg(drawing, volume, path, options);
}

Result<illustrate::SectionPlane> planeOf(const SectionArguments& arguments, const volume::SemanticVolume& volume) {
    if (!arguments.elevation.empty()) return illustrate::elevationPlane(arguments.elevation, volume);
    if (arguments.plane.empty()) return illustrate::defaultSectionPlane(volume);
    return illustrate::parseSectionPlane(arguments.plane, volume);
}

illustrate::SectionOptions optionsOf(const SectionArguments& arguments, std::vector<std::string>& nothing) {
    illustrate::SectionOptions options;
    options.show = arguments.show;
    options.hide = arguments.hide;
    options.spaces = !arguments.noRooms;
    options.smallestArea = arguments.minArea;
    options.beyond = arguments.beyond;
    options.dimensions = arguments.dimensions;
    if (!arguments.elevation.empty()) options.beyond.visible = true;
    options.threads = arguments.build.threads;
    options.nothing = &nothing;
    return options;
}

// Tells what was drawn and what was not, and writes it.
int writeSection(const SectionArguments& arguments, const illustrate::SectionDrawing& drawing,
                 const volume::SemanticVolume& volume, const std::vector<std::string>& nothing, double scale) {
    Diagnostics findings;
    illustrate::reportSection(drawing, volume, findings);
    printDiagnostics(findings, true);
    for (const std::string& message : nothing) note(message);
    const bool isEmpty = drawing.components.empty() && drawing.beyond.empty();
    if (isEmpty && !nothing.empty()) note("nothing is drawn");
    if (isEmpty && nothing.empty())
        return fail(Error(Code::BadSection,
                          fmt::format("the plane '{}' cuts nothing that is shown; move it, or see --show, --hide, "
                                      "--no-rooms and --min-area",
                                      arguments.plane.empty() ? "1.1 m above the lowest floor" : arguments.plane)));
    for (const std::filesystem::path& path : arguments.outputs)
        if (auto written = writeDrawing(drawing, volume, path, scale, arguments.dxf); !written)
            return fail(written.error());
    for (const std::filesystem::path& path : arguments.tables) {
        const std::string text = endingOf(path) == ".csv" ? writers::makeSectionCsv(drawing, volume)
                                                          : writers::makeSectionJson(drawing, volume);
        if (auto written = writeFileAtomically(path, text); !written) return fail(written.error());
    }
    TerminalProgress::hide();
    if (arguments.json) fmt::print("{}", writers::makeSectionJson(drawing, volume));
    return kDone;
}

// Of a city: its tiles, one after the other, in one drawing.
int runCitySection(const SectionArguments& arguments, double scale) {
    if (arguments.plane.empty())
        return fail(Error(Code::BadArgument,
                          "a city is cut by a plane that --plane gives, such as 'z=abs(50)'; elevations are drawn of a "
                          "part (svt city extract)"));
    if (arguments.beyond.isAny() || arguments.dimensions)
        return fail(Error(Code::BadArgument,
                          "--beyond, --hidden, --above and --dimensions need the meshes of a model, which a city does "
                          "not keep; leave them out"));
    const TerminalProgress progress;
    std::vector<std::string> nothing;
    const auto section = cutCity(arguments.input, arguments.plane, optionsOf(arguments, nothing), progress.get());
    if (!section) return fail(section.error());
    // Queries that find nothing in one tile may find something in others.
    if (!section->drawing.components.empty()) nothing.clear();
    std::sort(nothing.begin(), nothing.end());
    nothing.erase(std::unique(nothing.begin(), nothing.end()), nothing.end());
    return writeSection(arguments, section->drawing, section->volume, nothing, scale);
}

int runSection(const SectionArguments& arguments) {
    if (arguments.outputs.empty() && arguments.tables.empty() && !arguments.json)
        return fail(Error(Code::BadArgument, "nothing to write; give -o D.svg, --table T.csv or --json"));
    if (!arguments.plane.empty() && !arguments.elevation.empty())
        return fail(Error(Code::BadArgument, "--plane and --elevation exclude each other; give one of them"));
    const auto scale = parseScale(arguments.scale);
    if (!scale) return fail(scale.error());
    if (isCity(arguments.input)) return runCitySection(arguments, *scale);
    Diagnostics diagnostics;
    const TerminalProgress progress;
    BuildArguments build = arguments.build;
    build.vectors.meshes = true;
    const auto volume = loadVolume(arguments.input, build, progress.get(), diagnostics);
    printDiagnostics(diagnostics, arguments.verbose);
    if (!volume) return fail(volume.error());
    const auto plane = planeOf(arguments, *volume);
    if (!plane) return fail(plane.error());
    if (plane->bound > 0)
        note(
            fmt::format("the floor under the plane comes from voxels and may be off by {:g} m; give the model itself, "
                        "or a volume that keeps its meshes",
                        plane->bound));
    std::vector<std::string> nothing;
    Progress::tell(progress.get(), "section", 0);
    const auto drawing = illustrate::drawSection(*volume, *plane, optionsOf(arguments, nothing));
    if (!drawing) return fail(drawing.error());
    return writeSection(arguments, *drawing, *volume, nothing, *scale);
}

constexpr Option kSection[] = {
    kModelInput[0],
    {.name = "-o,--output",
     .value = "D.svg",
     .help = "the drawing to write: .svg, .pdf, .dxf or .geojson",
     .mayRepeat = true,
     .file = FileUse::Output,
     .formats = "svg|pdf|dxf|geojson"},
    {.name = "--plane",
     .value = "PLANE",
     .otherwise = "1.1 m above the floor of the lowest storey, or the middle",
     .help = "z=1.2, y<3, x>4, z=abs(112.3) in the CRS, storey=NAME+1.1 (1.1 m over its floor), or A,B,C,D; metres "
             "from the lower corner",
     .group = "Drawing"},
    {.name = "--elevation",
     .choices = "north|east|south|west",
     .help = "the outside, seen from there: what stands behind a plane before the model",
     .group = "Drawing"},
    {.name = "--beyond", .kind = Flag, .help = "also draw what is seen behind the plane", .group = "Drawing"},
    {.name = "--hidden",
     .kind = Flag,
     .help = "also draw the edges behind it that are hidden, dashed",
     .group = "Drawing"},
    {.name = "--above",
     .kind = Flag,
     .help = "also draw what is cut away, as seen from the plane, dashed and dotted",
     .group = "Drawing"},
    {.name = "--dimensions",
     .kind = Flag,
     .help = "plans: chains of dimensions around the building: openings, rooms, overall",
     .group = "Drawing"},
    {.name = "--iso-layers", .kind = Flag, .help = "DXF: names of layers after ISO 13567", .group = "Drawing"},
    {.name = "--world",
     .kind = Flag,
     .help = "DXF: coordinates of the model's CRS; upright drawings stand in space",
     .group = "Drawing"},
    {.name = "--scale",
     .value = "1:N",
     .byDefault = "1:100",
     .help = "scale of the SVG: 1:50 draws 1 m as 20 mm",
     .group = "Drawing"},
    {.name = "--hide",
     .value = "QUERY",
     .help = "leave out what the query selects",
     .group = "Drawing",
     .mayRepeat = true},
    {.name = "--show",
     .value = "QUERY",
     .help = "draw only what the query selects",
     .group = "Drawing",
     .mayRepeat = true},
    {.name = "--no-rooms", .kind = Flag, .help = "leave out rooms, units and storeys", .group = "Drawing"},
    {.name = "--min-area",
     .kind = Number,
     .unit = "m2",
     .least = 0,
     .most = 1e9,
     .byDefault = "0.0001",
     .help = "leave out polygons smaller than this",
     .group = "Drawing"},
    {.name = "--table",
     .value = "T.csv",
     .help = "areas per component and class: .json or .csv",
     .group = "Output",
     .mayRepeat = true,
     .file = FileUse::Output,
     .formats = "json|csv"},
    {.name = "--json", .kind = Flag, .help = "print the areas as JSON on stdout", .group = "Output"},
};

Action connectSection(Command& command) {
    auto arguments = std::make_shared<SectionArguments>();
    command.set("input", arguments->input);
    command.set("--output", arguments->outputs);
    command.set("--plane", arguments->plane);
    command.set("--elevation", arguments->elevation);
    command.set("--beyond", arguments->beyond.visible);
    command.set("--hidden", arguments->beyond.hidden);
    command.set("--above", arguments->beyond.above);
    command.set("--dimensions", arguments->dimensions);
    command.set("--iso-layers", arguments->dxf.isoLayers);
    command.set("--world", arguments->dxf.world);
    command.set("--scale", arguments->scale);
    command.set("--hide", arguments->hide);
    command.set("--show", arguments->show);
    command.set("--no-rooms", arguments->noRooms);
    command.set("--min-area", arguments->minArea);
    command.set("--table", arguments->tables);
    command.set("--json", arguments->json);
    command.set("--verbose", arguments->verbose);
    arguments->build.connect(command);
    return [arguments] { return runSection(*arguments); };
}

}  // namespace

extern const CommandText kSectionCommand{.name = "section",
                                         .help = "Draw what a plane cuts (SVG, PDF, DXF, GeoJSON)",
                                         .sets = {kSection, kQuiet, kVerbose, kGrid, kModel, kMemory, kStyle, kVoxels},
                                         .connect = connectSection};

}  // namespace svt::cli
