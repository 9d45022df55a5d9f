#include <apps/cli/city/city_input.hpp>
#include <apps/cli/diff/city_comparison.hpp>
#include <apps/cli/diff/comparison_page.hpp>
#include <apps/cli/diff/comparison_reports.hpp>
#include <apps/cli/diff/comparison_topics.hpp>
#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/load_volume.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/compare/compare_states.hpp>
#include <svt/compare/difference_volume.hpp>
#include <svt/compare/states_file.hpp>
#include <svt/core/file.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

namespace svt::cli {
namespace {

enum class Align : std::uint8_t { None, Translation };
constexpr auto namesOf(Align) {
    return std::to_array<Name<Align>>({{Align::None, "none"}, {Align::Translation, "translation"}});
}

struct DiffArguments {
    std::filesystem::path was, is;
    std::vector<std::filesystem::path> outputs;
    compare::CompareOptions options;
    Align align = Align::None;
    pipeline::BuildOptions build;
    bool json = false, csv = false, all = false, verbose = false;
};

// A state with meshes, from a .svt or a model.
compare::StateSource sourceOf(const std::filesystem::path& file, const DiffArguments& arguments,
                              const Progress* progress) {
    auto read = [&, progress, isAgain = false](const volume::Grid* grid) mutable -> Result<volume::SemanticVolume> {
        pipeline::BuildOptions build = arguments.build;
        build.vectors.meshes = true;
        build.extendsGrid = grid != nullptr;
        return loadVolume(file, build, progress, arguments.verbose && !std::exchange(isAgain, true), grid);
    };
    return {std::move(read), volume::isSvtFile(file)};
}

// The vector is reported, so that nobody takes a shifted model for a changed one, or the reverse.
void printAlignment(const compare::ComparedStates& states) {
    switch (states.alignment) {
        case compare::Alignment::NotAsked: return;
        case compare::Alignment::NotFound:
            return note(
                "no common translation is found: fewer than half of the objects with one shape agree; the models stay "
                "in their places");
        case compare::Alignment::Aligned: return note("the models are aligned; no translation is applied");
        case compare::Alignment::Moved:
            return note(fmt::format("the new model is moved by {:.4f}, {:.4f}, {:.4f} m for the comparison",
                                    states.shift.x, states.shift.y, states.shift.z));
    }
}

void printNotes(const Compared& compared) {
    if (compared.comparison.isReferenceSystemUnknown)
        note("the reference system of a model is unknown; the coordinates are compared as they are");
    const auto withoutFaces = [](const volume::SemanticVolume& volume) { return volume.vectors.triangles.empty(); };
    if (withoutFaces(compared.was) || withoutFaces(compared.is))
        note("a volume has no meshes, so voxels decide; build it with --vectors meshes for exact volumes");
    if (!compare::overlapInSpace(compared.was.grid, compared.is.grid))
        note("the models do not overlap in space; to compare them at one place, use --align translation");
    if (!compared.comparison.isOnOneLattice)
        note(
            "the two volumes have different sample positions, so objects without closed meshes have no volumes; give "
            "one "
            "state as a model file");
    if (const std::string ambiguous = ambiguousText(compared.comparison); !ambiguous.empty()) note(ambiguous);
    if (!compared.comparison.isComplete)
        note("some pairs of objects have too many faces for exact volumes; their volumes come from voxels");
}

// Both states as one volume, and its pictures, made for the first output that needs them.
class Difference {
public:
    Difference(const Compared& compared, int threads) : compared_(compared), threads_(threads) {}

    [[nodiscard]] const Result<volume::SemanticVolume>& volume() {
        if (!volume_) volume_ = compare::makeDifferenceVolume(compared_.was, compared_.is, compared_.comparison);
        return *volume_;
    }
    // Null if the states have no common volume; reason() gives the cause.
    [[nodiscard]] ChangePictures* pictures() {
        if (!pictures_ && volume()) pictures_ = std::make_unique<ChangePictures>(*volume(), threads_);
        return pictures_.get();
    }
    [[nodiscard]] std::string reason() { return volume() ? std::string() : volume().error().message(); }

private:
    const Compared& compared_;
    int threads_;
    std::optional<Result<volume::SemanticVolume>> volume_;
    std::unique_ptr<ChangePictures> pictures_;
};

// The day in UTC. Without the time of day, equal comparisons of one day give equal files.
std::string today() {
    const std::chrono::year_month_day day(std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()));
    return fmt::format("{:04}-{:02}-{:02}T00:00:00Z", int(day.year()), unsigned(day.month()), unsigned(day.day()));
}

Result<void> writeTopics(const std::filesystem::path& output, const Compared& compared, Difference& difference) {
    constexpr std::size_t kMostTopics = 100;
    std::vector<std::uint32_t> rows = rowsByVolume(compared.comparison);
    if (rows.size() > kMostTopics) {
        note(fmt::format("{} has the {} largest of {} changes; -o changes.csv has all", shownText(output.string()),
                         kMostTopics, rows.size()));
        rows.resize(kMostTopics);
    }
    ChangePictures* pictures = rows.empty() ? nullptr : difference.pictures();
    if (!rows.empty() && pictures == nullptr)
        note(fmt::format("{} has no pictures: {}", shownText(output.string()), difference.reason()));
    SVT_TRY(topics, changeTopics(compared, rows, pictures));
    SVT_TRY(bytes, writers::makeBcf(*topics, "svt diff", today()));
    SVT_DO(writeFileAtomically(output, *bytes));
    return {};
}

Result<void> writeOutput(const std::filesystem::path& output, const Compared& compared, Difference& difference) {
    const std::string ending = endingOf(output);
    if (ending == ".svt") {
        const auto& volume = difference.volume();
        if (!volume && !compare::overlapInSpace(compared.was.grid, compared.is.grid))
            return Error(
                volume.error().code(),
                fmt::format("'{}': the models do not overlap in space, and one volume of both is not possible; "
                            "to compare them at one place, use --align translation ({})",
                            output.string(), volume.error().message()));
        if (!volume) return volume.error();
        SVT_DO(compare::writeDifference(*volume, compared, output));
    } else if (ending == ".csv") {
        SVT_DO(writeFileAtomically(output, writers::makeCsv(comparisonTable(compared, true))));
    } else if (ending == ".html") {
        const bool isDrawn = compared.comparison.isDifferent();
        ChangePictures* pictures = isDrawn ? difference.pictures() : nullptr;
        const std::string reason = isDrawn && pictures == nullptr ? difference.reason() : std::string();
        SVT_TRY(page, comparisonPage(compared, pictures, reason));
        SVT_DO(writeFileAtomically(output, *page));
    } else if (ending == ".bcf") {
        SVT_DO(writeTopics(output, compared, difference));
    } else {
        SVT_DO(writeFileAtomically(output, comparisonFile(compared)));
    }
    return {};
}

// Two cities have rows only: no pictures and no common volume.
Result<int> runCityDiff(const DiffArguments& arguments) {
    for (const std::filesystem::path& input : {arguments.was, arguments.is})
        if (!isCity(input))
            return Error(Code::BadArgument,
                         "'" + input.string() + "' is not a city, and the other input is one; compare two cities");
    if (arguments.align != Align::None)
        return Error(Code::BadArgument, "--align moves single models; cities are compared in their places");
    for (const std::filesystem::path& output : arguments.outputs)
        if (const std::string ending = endingOf(output); ending != ".csv" && ending != ".json")
            return Error(Code::BadArgument, "'" + output.string() +
                                                "': two cities can be written as .csv and .json; for pages, issues and "
                                                "volumes compare parts of them (svt city extract)");
    const TerminalProgress progress;
    compare::CompareOptions options = arguments.options;
    options.threads = arguments.build.threads;
    options.progress = progress.get();
    SVT_TRY(was, city::City::open(arguments.was));
    SVT_TRY(is, city::City::open(arguments.is));
    SVT_TRY(comparison, compareCities(*was, *is, options));
    if (was->crsName().empty() || is->crsName().empty())
        note("the reference system of a city is unknown; the coordinates are compared as they are");
    if (comparison->changedTiles > 0 && !comparison->hasMeshes)
        note("the tiles have no meshes, so voxels decide; changes smaller than a voxel may be missing");
    for (const std::filesystem::path& output : arguments.outputs)
        SVT_DO(writeFileAtomically(
            output, endingOf(output) == ".csv"
                        ? writers::makeCsv(comparison->rows)
                        : cityComparisonJson(*comparison).dump(2, ' ', false, Json::error_handler_t::replace) + "\n"));
    TerminalProgress::hide();
    if (arguments.json)
        print(cityComparisonJson(*comparison));
    else if (arguments.csv)
        print(comparison->rows, TableFormat::Csv);
    else if (comparison->isDifferent())
        print(comparison->rows, TableFormat::Text);
    if (!arguments.json && !arguments.csv) summarize(citySummary(*comparison));
    return comparison->isDifferent() ? kDifferent : kDone;
}

Result<int> runDiff(const DiffArguments& arguments) {
    if (isCity(arguments.was) || isCity(arguments.is)) return runCityDiff(arguments);
    const TerminalProgress progress;
    compare::CompareOptions options = arguments.options;
    options.threads = arguments.build.threads;
    options.progress = progress.get();
    SVT_TRY(states, compare::compareStates(sourceOf(arguments.was, arguments, progress.get()),
                                           sourceOf(arguments.is, arguments, progress.get()),
                                           arguments.align == Align::Translation, options));
    const Compared compared = states->compared(shownText(arguments.was.string()), shownText(arguments.is.string()));
    printAlignment(*states);
    printNotes(compared);
    Difference difference(compared, arguments.build.threads);
    for (const std::filesystem::path& output : arguments.outputs) SVT_DO(writeOutput(output, compared, difference));
    TerminalProgress::hide();
    if (arguments.json)
        print(comparisonJson(compared));
    else if (arguments.csv)
        print(comparisonTable(compared, true), TableFormat::Csv);
    else if (const Table table = comparisonTable(compared, arguments.all, 3); !table.rows.empty())
        print(table, TableFormat::Text);
    if (!arguments.json && !arguments.csv) summarize(comparisonSummary(compared.comparison));
    return compared.comparison.isDifferent() ? kDifferent : kDone;
}

Members<DiffArguments> membersOf(const DiffArguments*) noexcept {
    using All = DiffArguments;
    using compare::CompareOptions;
    static constexpr Member<All> kMembers[] = {
        member<&All::was>("old", "the old state: a .svt, a model file or a city",
                          {.value = "OLD", .isRequired = true, .file = FileUse::ModelOrVolume}),
        member<&All::is>("new", "the new state: a .svt or a model file, also in another format, or a city",
                         {.value = "NEW", .isRequired = true, .file = FileUse::ModelOrVolume}),
        member<&All::outputs>(
            "-o,--output",
            "file to write: all rows (.csv, .json), a page with pictures (.html), issues for BIM programs (.bcf), or "
            "both states as a volume whose colours show the changes (.svt)",
            {.value = "FILE", .file = FileUse::Output, .formats = "csv|json|html|bcf|svt"}),
        member<&All::options, &CompareOptions::match>(
            "--match", "how objects are matched: by space and ids, by space only, or by ids only",
            {.group = "Comparison"}),
        member<&All::options, &CompareOptions::tolerance>(
            "--tolerance", "an object whose faces are within this distance is the same",
            {.unit = "metres", .least = 0.000001, .most = 1000, .group = "Comparison"}),
        member<&All::options, &CompareOptions::properties>("--properties",
                                                           "properties that are compared: class, name, storey and all "
                                                           "attributes (all), without attributes (names), or none",
                                                           {.group = "Comparison"}),
        member<&All::align>("--align", "moves the new model by the translation that most objects share, and reports it",
                            {.group = "Comparison"}),
        member<&All::all>("--all", "print objects that are the same, too", {.group = "Output"}),
        member<&All::json>("--json", "print rows and summary as JSON on stdout",
                           {.group = "Output", .excludes = "--csv"}),
        member<&All::csv>("--csv", "print all rows as CSV on stdout", {.group = "Output"}),
        verboseOption<&All::verbose>(),
        quietOption<All>(),
        part<&All::build>("build"),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kDiffCommand = commandOf<DiffArguments, runDiff>(
    "diff", "Compare two states of a building: moved, changed, added, removed objects");

}  // namespace svt::cli
