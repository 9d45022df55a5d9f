#include <apps/cli/city/city_input.hpp>
#include <apps/cli/city/feature_query.hpp>
#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/load_volume.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/query_reports.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/city/city_walk.hpp>
#include <svt/readers/owner_table.hpp>

#include <fmt/format.h>

#include <optional>

namespace svt::cli {
namespace {

struct QueryArguments {
    std::filesystem::path input;
    std::string query;
    std::string with, along;
    std::filesystem::path owners, parcels;
    std::vector<double> parcelHeights;
    bool neighbors = false, overlaps = false, gaps = false, areas = false;
    pipeline::BuildOptions build;
    FeatureQuery features;
    bool json = false, csv = false;

    [[nodiscard]] int reportCount() const {
        return !with.empty() + !along.empty() + !owners.empty() + !parcels.empty() + neighbors + overlaps + gaps +
               areas;
    }
    [[nodiscard]] TableFormat format() const {
        return json ? TableFormat::JsonRows : csv ? TableFormat::Csv : TableFormat::Text;
    }
};

Result<int> printFeatures(const volume::SemanticVolume& volume, const Labels& selected,
                          const QueryArguments& arguments) {
    With with;
    if (!arguments.with.empty()) {
        SVT_TRY(parsed, parseWith(arguments.with));
        with = *parsed;
    }
    const int threads = arguments.build.threads;
    if (arguments.json)
        print(featureJson(volume, selected, with, threads));
    else
        print(featureTable(volume, selected, with, threads), arguments.format());
    return kDone;
}

Result<Table> makeReport(const volume::SemanticVolume& volume, const Labels& selected, const QueryArguments& arguments,
                         const Progress* progress) {
    const int threads = arguments.build.threads;
    if (arguments.neighbors) return neighborTable(volume, selected, threads);
    // These reports list rows at the selected features: at a flat, those at its rooms and walls.
    const auto withParts = [&] { return analyze::Extents(volume.labels).withParts(selected); };
    if (arguments.overlaps) return overlapTable(volume, withParts());
    if (arguments.gaps) return gapTable(volume, withParts());
    if (arguments.areas) {
        Diagnostics findings;
        auto areas = areaTable(volume, withParts(), threads, findings);
        printVolumeFindings(findings, volume.source, arguments.input);
        return areas;
    }
    if (!arguments.along.empty()) {
        SVT_TRY(ray, illustrate::parsePickRay(arguments.along, volume.grid));
        return rayTable(volume, selected, *ray, threads);
    }
    SVT_TRY(parcels, loadParcels(arguments.parcels, arguments.build, progress, volume, arguments.parcelHeights));
    return parcelTable(volume, selected, *parcels, threads);
}

Result<int> printReport(const volume::SemanticVolume& volume, const Labels& selected, const QueryArguments& arguments) {
    std::optional<TerminalProgress> progress(std::in_place);
    Progress::tell(progress->get(), "report", 0);
    SVT_TRY(table, makeReport(volume, selected, arguments, progress->get()));
    if (Progress::isCancelled(progress->get())) return Error(Code::Cancelled, "the report was stopped");
    progress.reset();
    if (table->rows.empty() && !selected.empty()) note("the report is empty: it has no rows for the selected features");
    print(*table, arguments.format());
    return kDone;
}

Result<int> printOwners(const volume::SemanticVolume& volume, const Labels& selected, const QueryArguments& arguments) {
    SVT_TRY(text, readers::readOwnerTable(arguments.owners));
    SVT_TRY(owners, analyze::parseOwners(*text, arguments.owners.string(), volume.labels));
    const Labels withParts = analyze::Extents(volume.labels).withParts(selected);
    const OwnerReport report = ownerReport(volume, withParts, *owners, arguments.build.threads);
    if (!owners->shared.empty())
        note(fmt::format(
            "{:.3f} m3 belong to several features of the table, such as '{}'; they count once, divided "
            "equally between these features",
            report.json["sharedSpace"]["volume"].get<double>(), volume.labels.labels[owners->shared.front()].id));
    if (arguments.json) {
        print(report.json);
    } else if (arguments.csv) {
        print(report.components, TableFormat::Csv);
    } else {
        for (const Table* table : {&report.totals, &report.features, &report.common, &report.components}) {
            if (table != &report.totals && table->rows.empty()) continue;
            if (table != &report.totals) fmt::print("\n");
            print(*table, TableFormat::Text);
        }
    }
    return kDone;
}

Result<int> runCityOverlaps(const QueryArguments& arguments) {
    SVT_TRY(city, city::City::open(arguments.input));
    SVT_TRY(overlaps, city::cityOverlaps(*city, arguments.query, TerminalProgress().get()));
    Table table;
    table.columns = {{"a", "a"},     {"aName", "name"}, {"b", "b"},           {"bName", "name"},
                     {"voxels", ""}, {"volume", "m3"},  {"tiles", "in tiles"}};
    for (const auto& [a, b, voxels, volume, tiles] : *overlaps)
        table.rows.push_back({a.id, a.name, b.id, b.name, voxels, volume, tiles});
    if (table.rows.empty()) note("no two selected buildings claim the same space");
    print(table, arguments.format());
    return kDone;
}

// Queries a city, or a volume with options that are answered feature by feature.
Result<int> runFeatures(const QueryArguments& arguments) {
    if (isCity(arguments.input) && arguments.overlaps && !arguments.features.isAsked())
        return runCityOverlaps(arguments);
    const bool hasFaces = arguments.with == "faces";
    if (arguments.reportCount() > (hasFaces ? 1 : 0))
        return Error(Code::BadArgument,
                     isCity(arguments.input)
                         ? "reports need one volume; take a part of the city (svt city extract), or leave out "
                           "--neighbours, --along, --gaps, --areas, --owners, --parcels, and --with except for faces"
                         : "-o, --box, --by, --cut, --sort, --first, --leaks and --roofs exclude reports; leave out "
                           "--neighbours, --along, --overlaps, --gaps, --areas, --owners, --parcels, and --with except "
                           "for faces");
    FeatureQuery query = arguments.features;
    query.faces = hasFaces;
    query.input = arguments.input;
    query.query = arguments.query;
    query.build = arguments.build;
    query.format = arguments.format();
    return runFeatureQuery(query);
}

Result<int> runQuery(const QueryArguments& arguments) {
    SVT_DO(model::Query::parse(arguments.query));
    if (!arguments.parcelHeights.empty() && arguments.parcels.empty())
        return Error(Code::BadArgument, "--parcel-heights is for --parcels; give both");
    if (arguments.reportCount() > 1)
        return Error(
            Code::BadArgument,
            "--with, --neighbours, --along, --overlaps, --gaps, --areas, --owners and --parcels exclude each other; "
            "give one of them");
    if (isCity(arguments.input) || arguments.features.isAsked()) return runFeatures(arguments);
    pipeline::BuildOptions build = arguments.build;
    const bool hasMeshes =
        arguments.with.find("box") != std::string::npos || arguments.with.find("faces") != std::string::npos;
    if (arguments.areas || arguments.overlaps || hasMeshes || !arguments.parcels.empty()) build.vectors.meshes = true;
    SVT_TRY(volume, loadVolume(arguments.input, build, TerminalProgress().get(), false));
    auto selected = analyze::selectLabels(*volume, arguments.query);
    if (!selected && selected.error().code() == Code::NothingSelected) {
        // An answer, not an error: the query is valid, but selects no feature.
        note(selected.error().message());
        selected = Labels();
    }
    if (!selected) return selected.error();
    if (!arguments.owners.empty()) return printOwners(*volume, *selected, arguments);
    if (arguments.reportCount() == 0 || !arguments.with.empty()) return printFeatures(*volume, *selected, arguments);
    return printReport(*volume, *selected, arguments);
}

// NOLINTNEXTLINE(readability-function-size): a list
Members<QueryArguments> membersOf(const QueryArguments*) noexcept {
    using All = QueryArguments;
    static constexpr Member<All> kMembers[] = {
        modelInput<&All::input>(),
        member<&All::query>("query", "such as 'class=BuildingRoom and volume>20'",
                            {.value = "QUERY", .isRequired = true}),
        member<&All::with>("--with",
                           "more columns, any of volume (how it is known), surface (m2 by voxels), faces (m2 of "
                           "the model by kind) and box, such as volume,surface",
                           {.value = "LIST", .group = "Report"}),
        member<&All::neighbors>("--neighbours", "neighbours of each feature, with the shared area",
                                {.group = "Report"}),
        member<&All::along>("--along", "features along a ray: a point in metres from the lower corner, and a direction",
                            {.value = "X,Y,Z:DX,DY,DZ", .group = "Report"}),
        member<&All::overlaps>("--overlaps", "space that two features claim", {.group = "Report"}),
        member<&All::gaps>("--gaps", "enclosed air that belongs to no feature", {.group = "Report"}),
        member<&All::areas>("--areas",
                            "rooms with area, height and volume, then floor areas by DIN 277-1 per storey and in total",
                            {.group = "Report"}),
        member<&All::owners>("--owners",
                             "ownership: a table of feature, owner and share (.csv, .gpkg); walls between owners are "
                             "divided",
                             {.value = "T.csv", .group = "Report", .file = FileUse::OtherInput}),
        member<&All::parcels>(
            "--parcels",
            "share of each feature per parcel; the parcels are a volume on the same grid, a model, or "
            "polygons: .geojson, .gpkg, .shp",
            {.value = "FILE", .group = "Report", .file = FileUse::ModelOrVolume}),
        memberAs<record::Numbers<2>, &All::parcelHeights>(
            "--parcel-heights", "lowest and highest point of parcels that are polygons, in heights of the CRS",
            {.value = "LOW,HIGH", .unit = "metres", .otherwise = "no limits", .group = "Report"}),
        member<&All::features, &FeatureQuery::output>(
            "-o,--output",
            "write rows with footprint, height, volume and attributes: .csv, .geojson, .gpkg or .parquet",
            {.value = "FILE",
             .group = "Features",
             .file = FileUse::Output,
             .formats = "csv|geojson|gpkg|objectparquet"}),
        worldBox<&All::features, &FeatureQuery::box>("only features whose box meets this box of world coordinates",
                                                     "Features"),
        member<&All::features, &FeatureQuery::by>(
            "--by", "sums of m3 and m2 by class, material, storey or other attributes, such as material,storey",
            {.value = "KEYS", .group = "Features"}),
        member<&All::features, &FeatureQuery::cut>(
            "--cut", "only features that a plane cuts, such as 'z=abs(120)' (metres above datum)",
            {.value = "PLANE", .group = "Features"}),
        memberAs<record::Choice, &All::features, &FeatureQuery::sort>(
            "--sort", "the largest first", {.choices = "volume|area|height", .group = "Features"}),
        member<&All::features, &FeatureQuery::first>(
            "--first", "maximum number of rows",
            {.least = 1, .most = 1000000, .otherwise = "all; 100 with --sort", .group = "Features"}),
        member<&All::features, &FeatureQuery::leaks>(
            "--leaks", "only solids whose shell has holes in the model, which the build closed or filled",
            {.group = "Features"}),
        member<&All::features, &FeatureQuery::roofs>(
            "--roofs", "outlines of roofs as well: their area, and a second layer of the file of -o",
            {.group = "Features"}),
        member<&All::json>("--json", "print rows as JSON on stdout", {.group = "Output", .excludes = "--csv"}),
        member<&All::csv>("--csv", "print rows as CSV on stdout", {.group = "Output"}),
        quietOption<All>(),
        part<&All::build>("build"),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kQueryCommand =
    commandOf<QueryArguments, runQuery>("query", "List the features that a query selects, and their surroundings");

}  // namespace svt::cli
