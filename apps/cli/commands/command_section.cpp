#include <apps/cli/city/city_input.hpp>
#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/field_input.hpp>
#include <apps/cli/options/load_volume.hpp>
#include <apps/cli/options/materials_option.hpp>
#include <apps/cli/options/paper_scale.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/pdf_notes.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/city/city_walk.hpp>
#include <svt/compare/revisions.hpp>
#include <svt/compare/states_file.hpp>
#include <svt/core/file.hpp>
#include <svt/drawing/building_levels.hpp>
#include <svt/drawing/external_parts.hpp>
#include <svt/drawing/field_drawing.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/fields/field.hpp>
#include <svt/image/color_map.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/writers/drawing_formats.hpp>
#include <svt/writers/section_table.hpp>
#include <svt/writers/sheet_writer.hpp>
#include <svt/writers/view_drawing.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {
namespace {

struct SectionArguments {
    std::filesystem::path input, materials;
    std::vector<std::filesystem::path> outputs, tables;
    std::string plane, elevation;
    double scale = 100;
    drawing::SectionOptions section;
    writers::DxfOptions dxf;
    std::string field;
    drawing::FieldDrawingOptions fieldDrawing;
    image::ColorMap map = image::ColorMap::Viridis;
    bool revisions = false, json = false, verbose = false;
    pipeline::BuildOptions build;

    SectionArguments() { section.smallestArea = drawing::kSliverArea; }
};

Result<drawing::SectionPlane> planeOf(const SectionArguments& arguments, const volume::SemanticVolume& volume) {
    if (!arguments.elevation.empty()) return drawing::elevationPlane(arguments.elevation, volume);
    if (arguments.plane.empty()) return drawing::defaultSectionPlane(volume);
    return drawing::parseSectionPlane(arguments.plane, volume);
}

drawing::SectionOptions optionsOf(const SectionArguments& arguments, std::vector<std::string>& nothing) {
    drawing::SectionOptions options = arguments.section;
    if (!arguments.elevation.empty()) options.beyond.visible = true;
    options.threads = arguments.build.threads;
    options.nothing = &nothing;
    return options;
}

void noteExternals(const volume::SemanticVolume& volume) {
    const std::string sources = drawing::externalSources(drawing::findExternalParts(volume), volume.labels);
    if (!sources.empty()) note(sources);
}

// Prints the findings and writes the drawing.
Result<int> writeSection(const SectionArguments& arguments, const drawing::SectionDrawing& drawing,
                         const volume::SemanticVolume& volume, const std::vector<drawing::HatchChoice>& hatches,
                         const std::vector<std::string>& nothing, const writers::FieldLook& look = {}) {
    const drawing::SectionDrawing* const drawings[] = {&drawing};
    const std::vector<drawing::HatchUse> uses = usesIn(drawings, hatches);
    Diagnostics findings;
    if (arguments.elevation.empty() && (arguments.plane.empty() || arguments.plane.starts_with("storey=")))
        drawing::reportStoreys(volume, findings);
    drawing::reportSection(drawing, volume, findings);
    printVolumeFindings(findings, volume.source, arguments.input);
    noteHatches(uses);
    for (const std::string& message : nothing) note(message);
    if (const std::string chains = drawing::leftOutChains(drawings); !chains.empty()) note(chains);
    const bool isEmpty = drawing.components.empty() && drawing.beyond.empty();
    if (isEmpty && !nothing.empty()) note("nothing is drawn");
    if (isEmpty && nothing.empty())
        return Error(Code::BadSection,
                     fmt::format("the plane '{}' cuts no visible feature; move it, or see --show, --hide, "
                                 "--no-rooms and --min-area",
                                 !arguments.plane.empty()       ? arguments.plane
                                 : !arguments.elevation.empty() ? "of the elevation " + arguments.elevation
                                                                : "1.1 m above the ground floor"));
    for (const auto& paths : {arguments.outputs, arguments.tables})
        for (const std::filesystem::path& path : paths) {
            if (endingOf(path) == ".pdf") {
                SVT_TRY(pdf, writers::makeSectionPdf(drawing, volume, arguments.scale, look));
                notePdf(*pdf);
                SVT_DO(writeFileAtomically(path, pdf->bytes));
                continue;
            }
            SVT_DO(writers::writeDrawing(drawing, volume, path, {arguments.scale, arguments.dxf, look}));
            if (endingOf(path) == ".dxf" && arguments.dxf.isoLayers) noteExternals(volume);
        }
    TerminalProgress::hide();
    if (arguments.json) fmt::print(resultStream(), "{}", writers::makeSectionJson(drawing, volume, uses));
    return kDone;
}

// Cuts the tiles of a city, one by one, into one drawing.
Result<int> runCitySection(const SectionArguments& arguments) {
    if (!arguments.field.empty())
        return Error(Code::BadArgument, "--field: for one volume only; take a part of the city (svt city extract)");
    if (arguments.plane.empty())
        return Error(Code::BadArgument,
                     "a section of a city needs --plane, such as 'z=abs(50)'; for elevations, take a part of the city "
                     "(svt city extract)");
    if (arguments.section.beyond.isAny() || arguments.section.dimensions)
        return Error(Code::BadArgument,
                     "--beyond, --hidden, --above and --dimensions need the meshes of a model, which a city does "
                     "not store; leave them out");
    const TerminalProgress progress;
    std::vector<std::string> nothing;
    SVT_TRY(city, city::City::open(arguments.input));
    SVT_TRY(section, city::cutCity(*city, arguments.plane, optionsOf(arguments, nothing), progress.get()));
    // A query without result in one tile may have one in others.
    if (!section->drawing.components.empty()) nothing.clear();
    std::sort(nothing.begin(), nothing.end());
    nothing.erase(std::unique(nothing.begin(), nothing.end()), nothing.end());
    SVT_TRY(hatches, readHatches(arguments.materials, section->volume.labels));
    return writeSection(arguments, section->drawing, section->volume, *hatches, nothing);
}

// Refuses options of a field without a field, and a range that does not ascend.
Result<void> checkField(const SectionArguments& arguments) {
    const drawing::FieldDrawingOptions& options = arguments.fieldDrawing;
    if (options.range && !((*options.range)[0] < (*options.range)[1]))
        return Error(Code::BadArgument, fmt::format("--range {:g},{:g}: expected a first value below the second",
                                                    (*options.range)[0], (*options.range)[1]));
    const bool hasAny = options.time || options.isolines != 0 || options.bands || options.arrows || options.range ||
                        arguments.map != image::ColorMap::Viridis;
    if (arguments.field.empty() && hasAny)
        return Error(
            Code::BadArgument,
            "--time, --isolines, --bands, --arrows, --range and --map are for a field; give its name with --field");
    return {};
}

// The field on a section; none without --field.
Result<std::optional<drawing::FieldDrawing>> drawnField(const SectionArguments& arguments,
                                                        const drawing::SectionDrawing& drawing,
                                                        const volume::SemanticVolume& volume) {
    if (arguments.field.empty()) return std::optional<drawing::FieldDrawing>();
    if (!writers::kDrawsFields)
        return Error(
            Code::BadArgument,
            "the command for Node.js draws no fields in sections; use that of the .deb, or svt render --field");
    SVT_TRY(field, readFieldOf(arguments.input, arguments.field));
    drawing::FieldDrawingOptions options = arguments.fieldDrawing;
    options.threads = arguments.build.threads;
    SVT_TRY(drawn, drawing::drawField(drawing, volume, *field, options));
    if (drawn->bands.empty() && drawn->isolines.empty())
        note(fmt::format("the field '{}' has no value on the plane", arguments.field));
    return std::optional(std::move(*drawn));
}

// The two states of a difference volume, if their revisions are requested.
Result<std::optional<compare::ComparedStates>> readRevised(const SectionArguments& arguments) {
    if (!arguments.revisions) return std::optional<compare::ComparedStates>{};
    if (!arguments.field.empty())
        return Error(Code::BadArgument, "--revisions and --field exclude each other; draw one of them");
    if (volume::isSvtFile(arguments.input)) {
        if (!writers::kDrawsRevisions)
            return Error(Code::BadArgument,
                         "--revisions: the command for Node.js draws no revisions; use the native svt");
        SVT_TRY(states, compare::readStates(arguments.input));
        if (*states) return states;
    }
    return Error(Code::BadArgument,
                 "--revisions: '" + arguments.input.string() +
                     "' does not compare two states; svt diff OLD NEW -o CHANGES.svt writes such a file");
}

// Marks the changes since the old state.
Result<void> markSectionRevisions(const SectionArguments& arguments, const compare::ComparedStates& states,
                                  const volume::SemanticVolume& volume, drawing::SectionDrawing& drawing) {
    std::vector<std::string> ignored;  // results of queries that only the new state has
    drawing::SectionOptions options = optionsOf(arguments, ignored);
    options.dimensions = options.doorSwings = false;
    SVT_TRY(before, drawing::drawSection(states.was, drawing.plane, options));
    drawing::SectionDrawing* const drawings[] = {&drawing};
    const std::vector<drawing::Revision> revisions = compare::markRevisions(
        {.was = states.was, .is = volume, .comparison = states.comparison, .options = states.options},
        std::span(&*before, 1), drawings);
    note(fmt::format("the drawing shows the new state with {} of {} revisions", drawing.revisions.size(),
                     revisions.size()));
    for (const auto& paths : {arguments.outputs, arguments.tables})
        for (const std::filesystem::path& path : paths)
            if (const std::string ending = endingOf(path);
                ending == ".geojson" || ending == ".csv" || ending == ".json")
                note(fmt::format("{} has no revisions; .svg, .pdf and .dxf have them", shownText(path.string())));
    return {};
}

Result<int> runSection(const SectionArguments& arguments) {
    if (arguments.outputs.empty() && arguments.tables.empty() && !arguments.json)
        return Error(Code::BadArgument, "nothing to write; give -o D.svg, --table T.csv or --json");
    SVT_DO(checkField(arguments));
    if (isCity(arguments.input)) return runCitySection(arguments);
    const TerminalProgress progress;
    pipeline::BuildOptions build = arguments.build;
    build.vectors.meshes = true;
    SVT_TRY(states, readRevised(arguments));
    Result<volume::SemanticVolume> volume = *states
                                                ? Result<volume::SemanticVolume>(std::move((*states)->is))
                                                : loadVolume(arguments.input, build, progress.get(), arguments.verbose);
    SVT_DO(volume);
    SVT_TRY(hatches, readHatches(arguments.materials, volume->labels));
    SVT_TRY(plane, planeOf(arguments, *volume));
    if (plane->bound > 0)
        note(
            fmt::format("the floor under the plane comes from voxels and may be off by {:g} m; give the model itself, "
                        "or a volume that keeps its meshes",
                        plane->bound));
    std::vector<std::string> nothing;
    Progress::tell(progress.get(), "section", 0);
    SVT_TRY(drawing, drawing::drawSection(*volume, *plane, optionsOf(arguments, nothing)));
    if (*states) SVT_DO(markSectionRevisions(arguments, **states, *volume, *drawing));
    SVT_TRY(field, drawnField(arguments, *drawing, *volume));
    return writeSection(arguments, *drawing, *volume, *hatches, nothing,
                        {field->has_value() ? &**field : nullptr, image::mapColors(arguments.map)});
}

// NOLINTNEXTLINE(readability-function-size): a list
Members<SectionArguments> membersOf(const SectionArguments*) noexcept {
    using All = SectionArguments;
    static constexpr Member<All> kMembers[] = {
        modelInput<&All::input>(),
        member<&All::outputs>("-o,--output", "the drawing to write: .svg, .pdf, .dxf or .geojson",
                              {.value = "D.svg", .file = FileUse::Output, .formats = "svg|pdf|dxf|geojson"}),
        member<&All::plane>(
            "--plane",
            "z=1.2, y<3, x>4, z=abs(112.3) in the CRS, storey=NAME+1.1 (1.1 m over its floor), or A,B,C,D; metres "
            "from the lower corner",
            {.value = "PLANE",
             .otherwise = "1.1 m above the floor of the ground floor, or the middle",
             .group = "Drawing",
             .excludes = "--elevation",
             .isForProjects = true}),
        memberAs<record::Choice, &All::elevation>(
            "--elevation", "draw the outside of the model, seen from this side",
            {.choices = "north|north-east|east|south-east|south|south-west|west|north-west",
             .group = "Drawing",
             .isForProjects = true}),
        part<&All::section>("section", "--beyond|--hidden|--above|--dimensions|--dimension-unit"),
        member<&All::revisions>(
            "--revisions",
            "a .svt of svt diff: draw its new state, with clouds around the changes, dashed removed parts, "
            "and a table",
            {.group = "Drawing"}),
        part<&All::dxf>("dxf"),
        memberAs<PaperScale, &All::scale>("--scale", "scale of the SVG: 1:50 draws 1 m as 20 mm",
                                          {.value = "1:N", .group = "Drawing", .isForProjects = true}),
        part<&All::section>("section", "--hide|--show|--no-rooms"),
        member<&All::section, &drawing::SectionOptions::smallestArea>(
            "--min-area", "leave out polygons smaller than this",
            {.unit = "m2", .least = 0, .most = 1e9, .group = "Drawing", .isForProjects = true}),
        member<&All::field>(
            "--field",
            "draw this field of the volume: bands and lines of equal value, arrows of vectors, with a legend",
            {.value = "NAME", .group = "Field"}),
        member<&All::fieldDrawing, &drawing::FieldDrawingOptions::time>(
            "--time", "time of the field",
            {.unit = "seconds", .least = -1e12, .most = 1e12, .otherwise = "its first", .group = "Field"}),
        member<&All::fieldDrawing, &drawing::FieldDrawingOptions::isolines>(
            "--isolines", "draw lines of equal value, this step apart, in the unit of the field; 0: none",
            {.value = "STEP", .least = 0, .most = 1e12, .group = "Field"}),
        member<&All::fieldDrawing, &drawing::FieldDrawingOptions::bands>(
            "--bands", "fill bands of values, this step wide; 0: none",
            {.value = "STEP",
             .least = 0,
             .most = 1e12,
             .otherwise = "that of --isolines, or a round step for 8 to 20 bands",
             .group = "Field"}),
        member<&All::fieldDrawing, &drawing::FieldDrawingOptions::arrows>(
            "--arrows", "draw arrows of a field of vectors, this far apart; 0: none",
            {.unit = "metres",
             .least = 0,
             .most = 1e6,
             .otherwise = "a round number, with 40 to 100 arrows across the drawing",
             .group = "Field"}),
        member<&All::fieldDrawing, &drawing::FieldDrawingOptions::range>(
            "--range", "values of the field at the ends of the colour map",
            {.value = "A,B",
             .least = -1e12,
             .most = 1e12,
             .otherwise = "the least and the largest value of all times",
             .group = "Field"}),
        member<&All::map>("--map", "colour map of the field; vik is for values on both sides of a middle",
                          {.group = "Field"}),
        member<&All::materials>("--materials",
                                "table of materials with their hatches (CSV or JSON), before that of SVT",
                                {.value = "FILE", .group = "Drawing", .file = FileUse::OtherInput}),
        member<&All::tables>("--table", "areas per component and class: .json or .csv",
                             {.value = "T.csv", .group = "Output", .file = FileUse::Output, .formats = "json|csv"}),
        jsonOption<&All::json>("print the areas as JSON on stdout"),
        quietOption<All>(),
        verboseOption<&All::verbose>(),
        part<&All::build>("build"),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kSectionCommand =
    commandOf<SectionArguments, runSection>("section", "Draw what a plane cuts (SVG, PDF, DXF, GeoJSON)");

}  // namespace svt::cli
