#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/load_volume.hpp>
#include <apps/cli/options/materials_option.hpp>
#include <apps/cli/options/paper_scale.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/pdf_notes.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/compare/revisions.hpp>
#include <svt/compare/states_file.hpp>
#include <svt/core/file.hpp>
#include <svt/core/parallel.hpp>
#include <svt/core/text.hpp>
#include <svt/drawing/building_crop.hpp>
#include <svt/drawing/building_levels.hpp>
#include <svt/drawing/external_parts.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/volume_readers/read_label_volume.hpp>
#include <svt/writers/draw_sheets.hpp>
#include <svt/writers/office_sheets.hpp>
#include <svt/writers/sheet_geopackage.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>

namespace svt::cli {
namespace {

struct SheetsArguments {
    std::filesystem::path input, output, folder, dxfFolder, setFile, setOutput, materials, schedule;
    std::string title;
    drawing::TitleBlock block;
    std::optional<double> scale;
    std::optional<std::string> paper, language;
    std::optional<drawing::DimensionUnit> dimensionUnit;
    std::vector<std::string> hide;
    writers::DxfOptions dxf;
    bool noAbove = false, noDimensions = false, noTables = false, noTurn = false, verbose = false;
    pipeline::BuildOptions build;
};

// The set of the file, if given, with the changes of the options. Without sheets, the program chooses them.
Result<drawing::SheetSet> readSet(const SheetsArguments& arguments) {
    drawing::SheetSet set;
    if (!arguments.setFile.empty()) {
        SVT_TRY(file, FileBytes::read(arguments.setFile));
        SVT_TRY(parsed, drawing::parseSheetSet(file->text(), arguments.setFile.string()));
        set = std::move(*parsed);
    }
    if (arguments.paper) set.paper = *arguments.paper;
    if (arguments.language) set.language = *arguments.language;
    if (!arguments.title.empty()) set.title = arguments.title;
    const drawing::TitleBlock& block = arguments.block;
    for (const auto field : {&drawing::TitleBlock::number, &drawing::TitleBlock::creator,
                             &drawing::TitleBlock::approver, &drawing::TitleBlock::date, &drawing::TitleBlock::revision,
                             &drawing::TitleBlock::owner, &drawing::TitleBlock::documentType})
        if (!(block.*field).empty()) set.titleBlock.*field = block.*field;
    set.hide.insert(set.hide.end(), arguments.hide.begin(), arguments.hide.end());
    set.above = set.above && !arguments.noAbove;
    set.dimensions = set.dimensions && !arguments.noDimensions;
    set.dimensionUnit = arguments.dimensionUnit.value_or(set.dimensionUnit);
    set.tables = set.tables && !arguments.noTables;
    set.scale = arguments.scale.value_or(set.scale);
    return set;
}

// Prints the findings on inexact parts, once for all views.
void printFindings(const writers::SheetContent& content, const volume::SemanticVolume& volume,
                   const std::filesystem::path& input) {
    std::vector<const drawing::SectionDrawing*> drawings;
    for (const writers::DrawnView& view : content.views) drawings.push_back(&view.drawing);
    Diagnostics findings;
    drawing::reportStoreys(volume, findings);
    findings.append(content.findings);
    drawing::reportSections(drawings, volume, findings);
    printVolumeFindings(findings, volume.source, input);
}

void noteHatches(const writers::SheetContent& content, const std::vector<drawing::HatchChoice>& hatches) {
    std::vector<const drawing::SectionDrawing*> drawings;
    for (const writers::DrawnView& view : content.views) drawings.push_back(&view.drawing);
    cli::noteHatches(usesIn(drawings, hatches));
}

Result<void> makeFolder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) return Error(Code::CannotWrite, fmt::format("{}: {}", folder.string(), error.message()));
    return {};
}

// "plan-1", "section-1", "elevation-north". Names of storeys are not used, because they may have any characters.
std::string fileNameOf(const writers::SheetContent& content, std::size_t number) {
    const drawing::SheetView& view = content.views[number].view;
    if (view.kind == drawing::ViewKind::Elevation) return "elevation-" + view.name;
    std::size_t ofKind = 0;
    for (std::size_t n = 0; n <= number; ++n) ofKind += content.views[n].view.kind == view.kind ? 1 : 0;
    return fmt::format("{}-{}", view.kind == drawing::ViewKind::Plan ? "plan" : "section", ofKind);
}

Result<void> writeDxfFolder(const writers::SheetContent& content, const volume::SemanticVolume& volume,
                            const std::filesystem::path& folder, const writers::SheetOptions& options,
                            writers::DxfOptions dxf, int threads) {
    SVT_DO(makeFolder(folder));
    std::vector<drawing::ExternalPart> externals;
    if (dxf.isoLayers) {
        externals = drawing::findExternalParts(volume);
        dxf.externals = &externals;
        if (const std::string sources = drawing::externalSources(externals, volume.labels); !sources.empty())
            note(sources);
    }
    const std::vector<std::uint8_t> isAround = drawing::labelsAroundBuilding(volume);
    const auto batch = 4 * static_cast<std::size_t>(threads > 0 ? threads : hardwareThreads());  // files in memory
    for (std::size_t first = 0; first < content.views.size(); first += batch) {
        std::vector<Result<std::string>> texts(std::min(batch, content.views.size() - first), std::string());
        parallelFor(texts.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t n = begin; n < end; ++n)
                texts[n] = writers::makeSheetDxf(content, first + n, volume, options, dxf, isAround);
        });
        for (std::size_t n = 0; n < texts.size(); ++n) {
            const auto path = folder / (fileNameOf(content, first + n) + ".dxf");
            SVT_DO(checkNoStream(path));
            SVT_DO(texts[n]);
            SVT_DO(writeFileAtomically(path, *texts[n]));
        }
    }
    return {};
}

Result<void> writeSvgFolder(const std::vector<std::string>& sheets, const std::filesystem::path& folder) {
    SVT_DO(makeFolder(folder));
    for (std::size_t n = 0; n < sheets.size(); ++n) {
        const auto path = folder / fmt::format("sheet-{}.svg", n + 1);
        SVT_DO(checkNoStream(path));
        SVT_DO(writeFileAtomically(path, sheets[n]));
    }
    return {};
}

const std::filesystem::path& writtenName(const SheetsArguments& arguments) {
    for (const auto* path : {&arguments.output, &arguments.folder, &arguments.dxfFolder, &arguments.schedule})
        if (!path->empty()) return *path;
    return arguments.setOutput;
}

// Texts that name up to three of several things.
std::string firstNames(const std::vector<std::string>& names) {
    const std::size_t shown = std::min<std::size_t>(names.size(), 3);
    std::string text;
    for (std::size_t n = 0; n < shown; ++n) text += (n > 0 ? ", '" : "'") + names[n] + "'";
    return text + (shown < names.size() ? ", ..." : "");
}

// Points of reference and other small parts beside the building are not on the sheets.
void notePartsAway(const volume::SemanticVolume& volume) {
    std::vector<std::string> names;
    for (const std::uint32_t l : drawing::partsAwayFromBuilding(volume)) {
        const volume::Label& label = volume.labels.labels[l];
        names.push_back(label.name.empty() ? label.id : label.name);
    }
    if (!names.empty())
        note(fmt::format("{} small parts stand away from the building and are not on the sheets: {}", names.size(),
                         firstNames(names)));
}

// A scale without a paper selects the paper.
Result<void> selectPaper(const drawing::SheetSet& set, const writers::SheetContent& content,
                         const volume::SemanticVolume& volume, writers::SheetOptions& options) {
    if (!set.paper.empty() || !(set.scale > 0)) return {};
    SVT_TRY(paper, writers::smallestPaper(content, volume, options));
    options.paper = *paper;
    note(fmt::format("paper {}: the smallest on which all views fit at 1:{}", options.paper, set.scale));
    return {};
}

// Somebody who fills in a part of the title block learns about the rest.
void noteEmptyFields(const drawing::TitleBlock& block) {
    const std::vector<std::string> empty = writers::emptyBlockOptions(block);
    if (!(block == drawing::TitleBlock()) && !empty.empty())
        note(fmt::format("the title block has fields without a value; {} fill them", fmt::join(empty, ", ")));
}

// The set with its drawings.
struct DrawnSet {
    drawing::SheetSet set;
    volume::SemanticVolume volume;
    writers::SheetContent content;
    std::vector<drawing::HatchChoice> hatches;
    std::vector<std::string> nothing;  // queries that select nothing
};

// Marks the changes since the old state in all views, and lists them.
void markSheetRevisions(const compare::ComparedStates& states, DrawnSet& drawn) {
    writers::SheetContent& content = drawn.content;
    std::vector<drawing::SectionDrawing*> drawings;
    for (writers::DrawnView& view : content.views) drawings.push_back(&view.drawing);
    content.revisions = compare::markRevisions(
        {.was = states.was, .is = drawn.volume, .comparison = states.comparison, .options = states.options},
        content.before, drawings);
    content.before.clear();
    const auto shown = std::count_if(content.revisions.begin(), content.revisions.end(),
                                     [](const drawing::Revision& revision) { return revision.number != 0; });
    const std::size_t others = content.revisions.size() - std::size_t(shown);
    note(fmt::format("the volume compares two states; the sheets show the new one with {} revisions{}", shown,
                     others > 0 ? fmt::format(", and the table lists {} changes that no view shows", others) : ""));
    if (!content.revisions.empty())
        content.tables.insert(
            content.tables.begin(),
            writers::makeRevisionTable(content.revisions, writers::sheetOptionsOf(drawn.set).language));
}

Result<DrawnSet> drawSet(const SheetsArguments& arguments, volume::SemanticVolume volume, const Progress* progress,
                         const compare::ComparedStates* states = nullptr) {
    SVT_TRY(set, readSet(arguments));
    DrawnSet drawn{std::move(*set), std::move(volume), {}, {}, {}};
    SVT_TRY(hatches, readHatches(arguments.materials, drawn.volume.labels));
    drawn.hatches = std::move(*hatches);
    Progress::tell(progress, "sheets", 0);
    SVT_TRY(content, writers::drawSheets(drawn.set, drawn.volume, arguments.build.threads, &drawn.nothing,
                                         states != nullptr ? &states->was : nullptr));
    drawn.content = std::move(*content);
    if (states != nullptr) markSheetRevisions(*states, drawn);
    return drawn;
}

// A building that is turned against the axes of its CRS is drawn along its walls. A volume keeps its grid.
Result<DrawnSet> loadSet(const SheetsArguments& arguments, const Progress* progress) {
    if (volume::isSvtFile(arguments.input)) {
        SVT_TRY(states, compare::readStates(arguments.input));
        if (*states && !writers::kDrawsRevisions)
            return Error(
                Code::BadArgument,
                "the file compares two states, and the command for Node.js draws no revisions; use the native svt",
                {arguments.input.string(), 0, 0, {}});
        if (*states) return drawSet(arguments, std::move((*states)->is), progress, &**states);
    }
    pipeline::BuildOptions build = arguments.build;
    build.vectors.meshes = true;
    SVT_TRY(volume, loadVolume(arguments.input, build, progress, arguments.verbose));
    const bool isModel = !volume::isSvtFile(arguments.input) && !volume_readers::looksLikeLabelVolume(arguments.input);
    SVT_TRY(drawn, drawSet(arguments, std::move(*volume), progress));
    int turned = 0, straight = 0;  // plans
    for (const writers::DrawnView& view : drawn->content.views) {
        if (view.view.kind != drawing::ViewKind::Plan) continue;
        turned += view.drawing.chainsLeftOut == drawing::ChainsLeftOut::TurnedWalls ? 1 : 0;
        straight += view.drawing.dimensions.empty() ? 0 : 1;
    }
    if (turned <= straight || !isModel || arguments.noTurn || arguments.input == "-" ||
        build.axes != pipeline::AxesKind::World)
        return drawn;
    build.axes = pipeline::AxesKind::Building;
    Diagnostics findings;  // printed before
    SVT_TRY(along, loadVolume(arguments.input, build, progress, findings));
    note(
        "the building is turned against the axes of its coordinates; the sheets follow its walls (--no-turn keeps "
        "the axes)");
    return drawSet(arguments, std::move(*along), progress);
}

// The reasons why parts of the drawings are missing.
void noteGaps(const writers::SheetContent& content) {
    std::vector<const drawing::SectionDrawing*> drawings;
    for (const writers::DrawnView& view : content.views) drawings.push_back(&view.drawing);
    if (const std::string chains = drawing::leftOutChains(drawings); !chains.empty()) note(chains);
    if (content.openings && content.openings->unknown > 0)
        note(fmt::format("{} doors and windows have neither a shape nor a stated size; plans and schedules lack them",
                         content.openings->unknown));
}

Result<int> runSheets(const SheetsArguments& arguments) {
    if (arguments.output.empty() && arguments.folder.empty() && arguments.dxfFolder.empty() &&
        arguments.setOutput.empty() && arguments.schedule.empty())
        return Error(Code::BadArgument,
                     "nothing to write; give -o P.pdf, --svg DIR, --dxf DIR, --schedule S.csv or --write-sheets FILE");
    const TerminalProgress progress;
    const int threads = arguments.build.threads;
    SVT_TRY(drawn, loadSet(arguments, progress.get()));
    const drawing::SheetSet* const set = &drawn->set;
    const volume::SemanticVolume* const volume = &drawn->volume;
    const writers::SheetContent* const content = &drawn->content;
    writers::SheetOptions options = writers::sheetOptionsOf(*set);
    for (const std::string& message : drawn->nothing) note(message);
    printFindings(*content, *volume, arguments.input);
    notePartsAway(*volume);
    noteGaps(*content);
    SVT_DO(selectPaper(*set, *content, *volume, options));
    noteEmptyFields(set->titleBlock);
    noteHatches(*content, drawn->hatches);
    const bool isPdf = !arguments.output.empty() && endingOf(arguments.output) != ".gpkg";
    SVT_TRY(files, writers::makeSheetFiles(*content, *volume, options, isPdf, threads));
    if (isPdf) {
        notePdf(files->pdf);
        SVT_DO(writeFileAtomically(arguments.output, files->pdf.bytes));
    } else if (!arguments.output.empty()) {
        SVT_TRY(bytes, writers::makeSheetGeoPackage(*content, *volume));
        SVT_DO(writeFileAtomically(arguments.output, *bytes));
    }
    if (!arguments.folder.empty()) SVT_DO(writeSvgFolder(files->svg, arguments.folder));
    if (!arguments.dxfFolder.empty())
        SVT_DO(writeDxfFolder(*content, *volume, arguments.dxfFolder, options, arguments.dxf, threads));
    if (!arguments.schedule.empty())
        SVT_DO(writeFileAtomically(arguments.schedule, writers::makeCsv(writers::openingTable(
                                                           *content->openings, content->levels, volume->labels))));
    if (!arguments.setOutput.empty()) SVT_DO(writeFileAtomically(arguments.setOutput, drawing::writeSheetSet(*set)));
    TerminalProgress::hide();
    summarize(fmt::format("{}: {} sheets with {} views", writtenName(arguments).string(), files->svg.size(),
                          content->views.size()));
    return kDone;
}

// NOLINTNEXTLINE(readability-function-size): a list
Members<SheetsArguments> membersOf(const SheetsArguments*) noexcept {
    using All = SheetsArguments;
    using drawing::TitleBlock;
    using writers::DxfOptions;
    static constexpr Member<All> kMembers[] = {
        modelInput<&All::input>("a .svt or a model file"),
        member<&All::output>("-o,--output", "the sheets as one PDF, or the views as one GeoPackage (.gpkg)",
                             {.value = "P.pdf", .file = FileUse::Output, .formats = "pdf|gpkg"}),
        member<&All::folder>("--svg", "also write each sheet as sheet-N.svg",
                             {.value = "DIR", .file = FileUse::OutputFolder}),
        member<&All::dxfFolder>("--dxf", "also write each view as NAME.dxf, in metres",
                                {.value = "DIR", .file = FileUse::OutputFolder}),
        member<&All::schedule>("--schedule", "also write the schedule of doors and windows",
                               {.value = "S.csv", .file = FileUse::Output, .formats = "csv"}),
        member<&All::setFile>("--from", "the views of each sheet; other options change them",
                              {.value = "S.sheets.json", .group = "Sheets", .file = FileUse::OtherInput}),
        member<&All::setOutput>(
            "--write-sheets", "also write the views of each sheet",
            {.value = "S.sheets.json", .group = "Sheets", .file = FileUse::Output, .formats = "sheets"}),
        memberAs<PaperScale, &All::scale>(
            "--scale", "scale of all views: 1:50 draws 1 m as 20 mm",
            {.value = "1:N",
             .otherwise = "1:100, or the next of 1:200, 1:500, ... at which all views fit",
             .group = "Sheets",
             .isForProjects = true}),
        memberAs<record::Choice, &All::paper>("--paper", "size of a sheet, landscape",
                                              {.choices = "A4|A3|A2|A1|A0",
                                               .otherwise = "A3; with --scale, the smallest on which all views fit",
                                               .group = "Sheets",
                                               .isForProjects = true}),
        member<&All::title>("--title", "title block: name of the project",
                            {.value = "TEXT",
                             .otherwise = "the long name of the project in the file, or the name of the model",
                             .group = "Title block",
                             .isForProjects = true}),
        member<&All::block, &TitleBlock::number>("--number",
                                                 "title block: number of the drawings; each sheet adds its own",
                                                 {.value = "TEXT", .group = "Title block", .isForProjects = true}),
        member<&All::block, &TitleBlock::creator>("--creator", "title block: who made the drawings",
                                                  {.value = "TEXT", .group = "Title block", .isForProjects = true}),
        member<&All::block, &TitleBlock::approver>("--approver", "title block: who approved the drawings",
                                                   {.value = "TEXT", .group = "Title block", .isForProjects = true}),
        member<&All::block, &TitleBlock::date>("--issued", "title block: date of issue",
                                               {.value = "TEXT", .group = "Title block", .isForProjects = true}),
        member<&All::block, &TitleBlock::revision>("--revision", "title block: index of the revision",
                                                   {.value = "TEXT", .group = "Title block", .isForProjects = true}),
        member<&All::block, &TitleBlock::owner>("--owner", "title block: legal owner of the drawings",
                                                {.value = "TEXT", .group = "Title block", .isForProjects = true}),
        member<&All::block, &TitleBlock::documentType>(
            "--document-type", "title block: type of the document",
            {.value = "TEXT", .otherwise = "by the views of a sheet", .group = "Title block", .isForProjects = true}),
        member<&All::hide>("--hide", "leave out what the query selects",
                           {.value = "QUERY", .group = "Sheets", .isForProjects = true}),
        member<&All::dxf, &DxfOptions::isoLayers>("--iso-layers", "DXF: names of layers by ISO 13567",
                                                  {.group = "Sheets", .isForProjects = true}),
        member<&All::dxf, &DxfOptions::world>(
            "--world", "DXF: coordinates of the model's CRS; sections and elevations are upright in space",
            {.group = "Sheets", .isForProjects = true}),
        member<&All::noAbove>("--no-above", "plans without parts above the cut",
                              {.group = "Sheets", .isForProjects = true}),
        member<&All::noDimensions>("--no-dimensions", "plans and sections without dimensions",
                                   {.group = "Sheets", .isForProjects = true}),
        member<&All::dimensionUnit>("--dimension-unit",
                                    "unit of dimensions; m-cm is metres from 1 m, and centimetres below it",
                                    {.otherwise = "m-cm", .group = "Sheets", .isForProjects = true}),
        member<&All::noTurn>("--no-turn", "keep the axes of the coordinates, even if the walls are turned against them",
                             {.group = "Sheets", .isForProjects = true}),
        member<&All::noTables>("--no-tables", "no tables of rooms, floor areas and components",
                               {.group = "Sheets", .isForProjects = true}),
        memberAs<record::Choice, &All::language>(
            "--language", "language of the words on sheets",
            {.choices = "en|de", .otherwise = "en", .group = "Sheets", .isForProjects = true}),
        member<&All::materials>("--materials",
                                "table of materials with their hatches (CSV or JSON), before that of SVT",
                                {.value = "FILE", .group = "Sheets", .file = FileUse::OtherInput}),
        member<&All::verbose>("--verbose", "show all findings", {.group = "Output"}),
        quietOption<All>(),
        part<&All::build>("build"),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kSheetsCommand = commandOf<SheetsArguments, runSheets>(
    "sheets", "Draw plans, sections and elevations on sheets of paper (PDF, SVG)");

}  // namespace svt::cli
