#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/load_volume.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/cadastre_reports.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/pdf_notes.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/core/file.hpp>
#include <svt/drawing/line_view.hpp>
#include <svt/illustrate/scene.hpp>
#include <svt/readers/owner_table.hpp>
#include <svt/writers/ladm_writer.hpp>
#include <svt/writers/unit_report.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace svt::cli {
namespace {

struct CadastreArguments {
    std::filesystem::path input, owners;
    std::vector<std::filesystem::path> outputs;
    std::string unit;
    analyze::LegalSpaceOptions spaces;
    bool json = false, csv = false, verbose = false;
    pipeline::BuildOptions build;
};

using analyze::LandAdministration;

Result<LandAdministration> readAdministration(const CadastreArguments& arguments,
                                              const volume::SemanticVolume& volume) {
    if (arguments.owners.empty()) return analyze::makeLandAdministration(volume, nullptr, {}, arguments.spaces);
    SVT_TRY(text, readers::readOwnerTable(arguments.owners));
    SVT_TRY(owners, analyze::parseOwners(*text, arguments.owners.string(), volume.labels));
    return analyze::makeLandAdministration(volume, &*owners, arguments.owners.filename().string(), arguments.spaces);
}

// The legal spaces that the query selects; without a query, all with a body.
Result<std::vector<std::uint32_t>> selectSpaces(const CadastreArguments& arguments, const LandAdministration& all,
                                                const volume::SemanticVolume& volume) {
    std::vector<std::uint32_t> spaces;
    std::optional<std::vector<std::uint32_t>> selected;
    if (!arguments.unit.empty()) {
        SVT_TRY(labels, analyze::selectLabels(volume, arguments.unit));
        selected = std::move(*labels);
    }
    for (std::uint32_t s = 0; s < all.spaces.spaces.size(); ++s) {
        const analyze::LegalSpace& space = all.spaces.spaces[s];
        const bool isWanted = selected ? std::binary_search(selected->begin(), selected->end(), space.label)
                                       : space.body != analyze::SpaceBody::None;
        if (isWanted) spaces.push_back(s);
    }
    if (spaces.empty())
        return Error(
            Code::NothingSelected,
            "--pages-of: no legal unit is selected; select a BuildingUnit, or a feature of the table of owners");
    return spaces;
}

// The whole model from above and aside.
Result<drawing::LineView> drawBuilding(const volume::SemanticVolume& volume, int threads) {
    illustrate::Scene scene;
    scene.width = scene.height = 1000;
    scene.camera.isParallel = true;
    SVT_TRY(spec, illustrate::makeFrameSpec(scene, volume));
    drawing::LineViewOptions options;
    options.threads = threads;
    return drawing::drawLineView(volume, *spec, options);
}

Result<std::string> makeReports(const CadastreArguments& arguments, const LandAdministration& all,
                                const volume::SemanticVolume& volume) {
    SVT_TRY(spaces, selectSpaces(arguments, all, volume));
    std::optional<drawing::LineView> view;
    if (!volume.vectors.triangles.empty()) {
        SVT_TRY(drawn, drawBuilding(volume, arguments.build.threads));
        view = std::move(*drawn);
    }
    SVT_TRY(pdf, writers::makeUnitReports(all, *spaces, volume, view ? &*view : nullptr, arguments.build.threads));
    notePdf(*pdf);
    return std::move(pdf->bytes);
}

Result<std::string> makeOutput(const std::string& ending, const CadastreArguments& arguments,
                               const LandAdministration& all, const volume::SemanticVolume& volume) {
    if (ending == ".pdf") return makeReports(arguments, all, volume);
    if (ending == ".gpkg") return writers::makeLadmGeoPackage(all, volume);
    if (ending == ".json") return writers::makeLadmCityJson(all, volume);
    if (ending == ".ifc") return writers::makeLadmIfc(all, volume);
    return writers::makeLadmCityGml(all, volume);
}

void printNotes(const LandAdministration& all, const volume::SemanticVolume& volume) {
    const auto count = [&](analyze::SpaceBody body) {
        return std::count_if(all.spaces.spaces.begin(), all.spaces.spaces.end(),
                             [&](const analyze::LegalSpace& space) { return space.body == body; });
    };
    if (const auto n = count(analyze::SpaceBody::Voxels); n > 0)
        note(fmt::format("{} legal units have no closed solids: their bodies are made of voxels{}", n,
                         volume.vectors.triangles.empty() ? "; build the volume with --vectors meshes" : ""));
    if (const auto n = count(analyze::SpaceBody::None); n > 0)
        note(fmt::format("{} legal units have no geometry and no parts", n));
    if (!all.spaces.withoutFaces.empty())
        note(
            fmt::format("{} legal units have no boundary faces, such as '{}': their voxels need more boxes than {}, "
                        "or their faces do not settle; use a coarser --spacing, or close the solids",
                        all.spaces.withoutFaces.size(),
                        volume.labels.labels[all.spaces.spaces[all.spaces.withoutFaces.front()].label].id,
                        analyze::LegalSpaceOptions().maxBoxes));
    for (std::uint32_t unit = 0; unit < all.units.size(); ++unit)
        if (const auto sum = sumOfShares(all, unit, analyze::kOwnership); sum && *sum < 1 - 1e-9)
            note(fmt::format("the shares of ownership in '{}' add up to {:.6g}; the rest has no owner",
                             volume.labels.labels[all.units[unit].label].id, *sum));
    if (all.units.empty()) note("no legal unit has an owner: give a table with --owners, or units the attribute owner");
}

Result<int> runCadastre(const CadastreArguments& arguments) {
    if (!arguments.unit.empty()) SVT_DO(model::Query::parse(arguments.unit));
    const TerminalProgress progress;
    pipeline::BuildOptions build = arguments.build;
    build.vectors.meshes = true;
    SVT_TRY(volume, loadVolume(arguments.input, build, progress.get(), arguments.verbose));
    Progress::tell(progress.get(), "legal units", 0);
    SVT_TRY(all, readAdministration(arguments, *volume));
    printNotes(*all, *volume);
    for (const std::filesystem::path& output : arguments.outputs) {
        SVT_TRY(bytes, makeOutput(endingOf(output), arguments, *all, *volume));
        SVT_DO(writeFileAtomically(output, *bytes));
    }
    TerminalProgress::hide();
    if (arguments.json)
        print(cadastreJson(*all, *volume));
    else if (arguments.csv)
        print(relationTable(*all, *volume), TableFormat::Csv);
    else if (arguments.outputs.empty())
        printCadastre(*all, *volume);
    if (arguments.json || arguments.csv) return kDone;
    for (const std::filesystem::path& output : arguments.outputs)
        summarize(fmt::format("{}: {} legal units, {} parties, {} boundary faces, {} relations", output.string(),
                              all->spaces.spaces.size(), all->parties.size(), all->spaces.faces.size(),
                              all->spaces.relations.size()));
    return kDone;
}

Members<CadastreArguments> membersOf(const CadastreArguments*) noexcept {
    using All = CadastreArguments;
    using analyze::LegalSpaceOptions;
    static constexpr Member<All> kMembers[] = {
        modelInput<&All::input>("a .svt or a model file"),
        member<&All::outputs>("-o,--output",
                              "file to write: the land administration (.gpkg, CityGML 3.0 .gml, CityJSON .city.json, "
                              "IFC4 .ifc), or a page per "
                              "unit (.pdf)",
                              {.value = "FILE", .file = FileUse::Output, .formats = "gpkg|citygml|cityjson|ifc|pdf"}),
        member<&All::owners>(
            "--owners", "table of feature, owner, share, right and source: .csv, or .gpkg with such a table",
            {.value = "T.csv", .otherwise = "the attribute owner of the units", .file = FileUse::OtherInput}),
        member<&All::unit>("--pages-of", "legal units with a page in the PDF", {.value = "QUERY", .otherwise = "all"}),
        member<&All::spaces, &LegalSpaceOptions::widestGap>("--gap", "report gaps between legal units up to this width",
                                                            {.unit = "metres", .least = 0, .most = 100}),
        member<&All::json>("--json", "print units, owners and relations as JSON on stdout",
                           {.group = "Output", .excludes = "--csv"}),
        member<&All::csv>("--csv", "print the relations of units as CSV on stdout", {.group = "Output"}),
        verboseOption<&All::verbose>(),
        quietOption<All>(),
        part<&All::build>("build"),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kCadastreCommand = commandOf<CadastreArguments, runCadastre>(
    "cadastre", "Register legal units: owners, boundary faces and relations (ISO 19152)");

}  // namespace svt::cli
