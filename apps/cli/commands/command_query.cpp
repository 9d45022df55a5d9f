#include <apps/cli/city/city_input.hpp>
#include <apps/cli/city/city_overlaps.hpp>
#include <apps/cli/city/feature_query.hpp>
#include <apps/cli/options/build_options.hpp>
#include <apps/cli/options/command_line.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/query_reports.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/core/file.hpp>

#include <fmt/format.h>

namespace svt::cli {
namespace {

struct QueryArguments {
    std::filesystem::path input;
    std::string query;
    std::string with, along;
    std::filesystem::path owners, parcels;
    bool neighbors = false, overlaps = false, gaps = false, areas = false;
    BuildArguments build;
    FeatureQuery features;
    bool json = false, csv = false;

    [[nodiscard]] int reportCount() const {
        return !with.empty() + !along.empty() + !owners.empty() + !parcels.empty() + neighbors + overlaps + gaps +
               areas;
    }
};

void printFeatures(const volume::LabelTable& table, const Labels& selected) {
    fmt::print("{:<28} {:<28} {:<24} {:>10} {:>12}\n", "id", "class", "name", "m3", "voxels");
    for (const std::uint32_t l : selected) {
        const volume::Label& label = table.labels[l];
        fmt::print("{:<28} {:<28} {:<24} {:>10.3f} {:>12}\n", label.id, label.className, label.name, label.volume,
                   label.voxels);
    }
}

int printFeatures(const volume::SemanticVolume& volume, const Labels& selected, const QueryArguments& arguments) {
    With with;
    if (!arguments.with.empty()) {
        const auto parsed = parseWith(arguments.with);
        if (!parsed) return fail(parsed.error());
        with = *parsed;
    }
    const int threads = arguments.build.threads;
    if (arguments.json)
        print(featureJson(volume, selected, with, threads));
    else if (arguments.csv)
        featureTable(volume, selected, with, threads).printCsv();
    else if (!arguments.with.empty())
        featureTable(volume, selected, with, threads).printText();
    else
        printFeatures(volume.labels, selected);
    return kDone;
}

Result<Table> makeReport(const volume::SemanticVolume& volume, const Labels& selected, const QueryArguments& arguments,
                         const Progress* progress) {
    const int threads = arguments.build.threads;
    if (arguments.neighbors) return neighborTable(volume, selected, threads);
    if (arguments.overlaps) return overlapTable(volume, selected);
    if (arguments.gaps) return gapTable(volume, selected);
    if (arguments.areas) return areaTable(volume, selected, threads);
    if (!arguments.along.empty()) {
        SVT_TRY(ray, illustrate::parsePickRay(arguments.along, volume.grid));
        return rayTable(volume, selected, *ray, threads);
    }
    Diagnostics diagnostics;
    const auto parcels = loadVolume(arguments.parcels, arguments.build, progress, diagnostics, &volume.grid);
    printDiagnostics(diagnostics, false);
    if (!parcels) return parcels.error();
    return parcelTable(volume, selected, *parcels, threads);
}

int printTable(const Table& table, const QueryArguments& arguments) {
    if (arguments.json)
        print(table.toJson());
    else if (arguments.csv)
        table.printCsv();
    else
        table.printText();
    return kDone;
}

int printReport(const volume::SemanticVolume& volume, const Labels& selected, const QueryArguments& arguments) {
    const auto table = [&]() -> Result<Table> {
        const TerminalProgress progress;
        Progress::tell(progress.get(), "report", 0);
        auto made = makeReport(volume, selected, arguments, progress.get());
        if (Progress::isCancelled(progress.get())) return Error(Code::Cancelled, "the report was stopped");
        return made;
    }();
    if (!table) return fail(table.error());
    if (table->rows.empty() && !selected.empty()) note("the report is empty: it has nothing of what the query selects");
    return printTable(*table, arguments);
}

int printOwners(const volume::SemanticVolume& volume, const Labels& selected, const QueryArguments& arguments) {
    const auto file = FileBytes::read(arguments.owners);
    if (!file) return fail(file.error());
    const auto owners = analyze::parseOwners(file->text(), arguments.owners.string(), volume.labels);
    if (!owners) return fail(owners.error());
    const OwnerReport report = ownerReport(volume, selected, *owners, arguments.build.threads);
    if (arguments.json) {
        print(report.json);
    } else if (arguments.csv) {
        report.components.printCsv();
    } else {
        report.totals.printText();
        fmt::print("\n");
        report.components.printText();
    }
    return kDone;
}

int runCityOverlaps(const QueryArguments& arguments) {
    const auto table = [&] {
        const TerminalProgress progress;
        return cityOverlaps(arguments.input, arguments.query, progress.get());
    }();
    if (!table) return fail(table.error());
    if (table->rows.empty()) note("no two buildings of what the query selects claim the same space");
    return printTable(*table, arguments);
}

// Of a city, or with options that are answered feature by feature.
int runFeatures(const QueryArguments& arguments) {
    if (isCity(arguments.input) && arguments.overlaps && !arguments.features.isAsked())
        return runCityOverlaps(arguments);
    if (arguments.reportCount() > 0)
        return fail(Error(Code::BadArgument,
                          isCity(arguments.input)
                              ? "reports are of one volume; take a part of the city (svt city extract), or leave out "
                                "--with, --neighbours, --along, --gaps, --areas, --owners and --parcels"
                              : "-o, --box, --by, --cut, --sort, --first and --leaks go without reports; leave out "
                                "--with, --neighbours, --along, --overlaps, --gaps, --areas, --owners and --parcels"));
    FeatureQuery query = arguments.features;
    query.input = arguments.input;
    query.query = arguments.query;
    query.build = arguments.build;
    query.json = arguments.json;
    query.csv = arguments.csv;
    return runFeatureQuery(query);
}

int runQuery(const QueryArguments& arguments) {
    if (auto parsed = model::Query::parse(arguments.query); !parsed) return fail(parsed.error());
    if (arguments.reportCount() > 1)
        return fail(Error(
            Code::BadArgument,
            "--with, --neighbours, --along, --overlaps, --gaps, --areas, --owners and --parcels exclude each other; "
            "give one of them"));
    if (arguments.json && arguments.csv)
        return fail(Error(Code::BadArgument, "--json and --csv exclude each other; give one of them"));
    if (isCity(arguments.input) || arguments.features.isAsked()) return runFeatures(arguments);
    Diagnostics diagnostics;
    Result<volume::SemanticVolume> volume = [&] {
        const TerminalProgress progress;
        BuildArguments build = arguments.build;
        if (arguments.areas || arguments.overlaps) build.vectors.meshes = true;
        return loadVolume(arguments.input, build, progress.get(), diagnostics);
    }();
    printDiagnostics(diagnostics, false);
    if (!volume) return fail(volume.error());
    auto selected = analyze::selectLabels(volume->labels, arguments.query);
    if (!selected && selected.error().code() == Code::NothingSelected) {
        // An answer, not an error: the query is well formed, and there is no such feature.
        note(selected.error().message());
        selected = Labels();
    }
    if (!selected) return fail(selected.error());
    if (!arguments.owners.empty()) return printOwners(*volume, *selected, arguments);
    if (arguments.reportCount() == 0 || !arguments.with.empty()) return printFeatures(*volume, *selected, arguments);
    return printReport(*volume, *selected, arguments);
}

constexpr Option kQuery[] = {
    kModelInput[0],
    {.name = "query", .value = "QUERY", .help = "such as 'class=BuildingRoom and volume>20'", .isRequired = true},
    {.name = "--with",
     .value = "LIST",
     .help = "more columns, any of volume (by voxels), surface (m2) and box, such as volume,surface",
     .group = "Report"},
    {.name = "--neighbours",
     .kind = Flag,
     .help = "what each feature touches, with the shared area",
     .group = "Report"},
    {.name = "--along",
     .value = "X,Y,Z:DX,DY,DZ",
     .help = "what lies along a ray: a point in metres from the lower corner, and a direction",
     .group = "Report"},
    {.name = "--overlaps", .kind = Flag, .help = "space that two features claim", .group = "Report"},
    {.name = "--gaps", .kind = Flag, .help = "enclosed air that belongs to no feature", .group = "Report"},
    {.name = "--areas",
     .kind = Flag,
     .help = "rooms with area, height and volume, then floor areas after DIN 277-1 of each storey and in all",
     .group = "Report"},
    {.name = "--owners",
     .value = "T.csv",
     .help = "who owns what: a table of feature and owner; walls between owners are divided",
     .group = "Report",
     .file = FileUse::OtherInput},
    {.name = "--parcels",
     .value = "FILE",
     .help = "how much of each feature lies in which parcel: a volume on the same grid, or a model",
     .group = "Report",
     .file = FileUse::ModelOrVolume},
    {.name = "-o,--output",
     .value = "FILE",
     .help = "write rows with outline, height, volume and attributes: .csv, .geojson, .gpkg or .parquet",
     .group = "Features",
     .file = FileUse::Output,
     .formats = "csv|geojson|gpkg|objectparquet"},
    {.name = "--box",
     .kind = Number,
     .value = "X0,Y0,Z0,X1,Y1,Z1",
     .unit = "metres",
     .help = "only features whose box meets this box of world coordinates",
     .group = "Features",
     .count = 6,
     .leastCount = 6},
    {.name = "--by",
     .value = "KEYS",
     .help = "sums of m3 and m2 by attributes or class, such as function,district",
     .group = "Features"},
    {.name = "--cut",
     .value = "PLANE",
     .help = "only features that a plane cuts, such as 'z=abs(120)' (metres above datum)",
     .group = "Features"},
    {.name = "--sort", .choices = "volume|area|height", .help = "the largest first", .group = "Features"},
    {.name = "--first",
     .kind = Whole,
     .least = 1,
     .most = 1000000,
     .otherwise = "all; 100 with --sort",
     .help = "maximum number of rows",
     .group = "Features"},
    {.name = "--leaks",
     .kind = Flag,
     .help = "only solids whose shell has holes in the model, which were closed or filled all the same",
     .group = "Features"},
    {.name = "--json", .kind = Flag, .help = "print rows as JSON on stdout", .group = "Output"},
    {.name = "--csv", .kind = Flag, .help = "print rows as CSV on stdout", .group = "Output"},
};

Action connectQuery(Command& command) {
    auto arguments = std::make_shared<QueryArguments>();
    command.set("input", arguments->input);
    command.set("query", arguments->query);
    command.set("--with", arguments->with);
    command.set("--neighbours", arguments->neighbors);
    command.set("--along", arguments->along);
    command.set("--overlaps", arguments->overlaps);
    command.set("--gaps", arguments->gaps);
    command.set("--areas", arguments->areas);
    command.set("--owners", arguments->owners);
    command.set("--parcels", arguments->parcels);
    command.set("--json", arguments->json);
    command.set("--csv", arguments->csv);
    command.set("--output", arguments->features.output);
    command.set("--box", arguments->features.box);
    command.set("--by", arguments->features.by);
    command.set("--cut", arguments->features.cut);
    command.set("--sort", arguments->features.sort);
    command.set("--first", arguments->features.first);
    command.set("--leaks", arguments->features.leaks);
    arguments->build.connect(command);
    return [arguments] { return runQuery(*arguments); };
}

}  // namespace

extern const CommandText kQueryCommand{.name = "query",
                                       .help = "List the features that a query selects, and what is around them",
                                       .sets = {kQuery, kQuiet, kGrid, kModel, kMemory, kStyle, kVoxels},
                                       .connect = connectQuery};

}  // namespace svt::cli
