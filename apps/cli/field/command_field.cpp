#include <apps/cli/field/field_add.hpp>
#include <apps/cli/field/field_export.hpp>
#include <apps/cli/field/field_tables.hpp>
#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/field_input.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/fields/svt_fields.hpp>
#include <svt/model/query.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {
namespace {

struct FieldListArguments {
    std::filesystem::path input;
    bool json = false;
};

struct FieldStatsArguments {
    std::filesystem::path input, output;
    std::string name, by;
    fields::StatisticsOptions options;
    bool json = false, csv = false;
};

struct FieldProbeArguments {
    std::filesystem::path input, output;
    std::string name;
    std::vector<double> at;
    bool json = false, csv = false;
};

struct FieldRemoveArguments {
    std::filesystem::path input, output;
    std::vector<std::string> names;
};

Result<int> runFieldList(const FieldListArguments& arguments) {
    SVT_DO(requireSvt(arguments.input));
    SVT_TRY(listed, fields::listFields(arguments.input));
    if (arguments.json) {
        print(fieldsJson(*listed));
        return kDone;
    }
    if (listed->empty()) note("the volume has no fields; add some with 'svt field add'");
    print(fieldTable(*listed), TableFormat::Text);
    return kDone;
}

// Writes a table and prints it. \param shown  the rows to print as text, if no file is written
Result<void> putTable(const Table& table, const Table& shown, const std::filesystem::path& output, bool isJson,
                      bool isCsv) {
    if (!output.empty()) SVT_DO(writeTable(table, output));
    TerminalProgress::hide();
    if (isJson || isCsv)
        print(table, isJson ? TableFormat::JsonRows : TableFormat::Csv);
    else if (output.empty())
        print(shown, TableFormat::Text);
    else
        summarize(fmt::format("{}: {} rows", output.string(), table.rows.size()));
    return {};
}

Result<int> runFieldStats(const FieldStatsArguments& arguments) {
    if (!arguments.by.empty()) SVT_DO(model::Query::parse(arguments.by));
    SVT_DO(requireSvt(arguments.input));
    const TerminalProgress progress;
    SVT_TRY(field, fields::readField(arguments.input, arguments.name));
    SVT_TRY(volume, volume::readSvt(arguments.input));
    SVT_TRY(rows, fields::statisticsRows(arguments.by, field->head, *volume));
    fields::StatisticsOptions options = arguments.options;
    if (field->head.components > 1) options.component = fields::StatisticsOptions::kMagnitude;
    SVT_TRY(statistics, fields::sumField(*field, *volume, options));
    const Table table = statisticsTable(field->head, *statistics, *rows, volume->labels, true);
    const Table shown = statisticsTable(field->head, *statistics, *rows, volume->labels, false);
    if (field->head.components > 1) note("the field is a vector; the figures are those of its length");
    if (rows->empty()) note(fmt::format("no component has voxels in the medium '{}' of the field", field->head.medium));
    SVT_DO(putTable(table, shown, arguments.output, arguments.json, arguments.csv));
    return kDone;
}

Result<int> runFieldProbe(const FieldProbeArguments& arguments) {
    SVT_DO(requireSvt(arguments.input));
    const TerminalProgress progress;
    SVT_TRY(field, fields::readField(arguments.input, arguments.name));
    SVT_TRY(volume, volume::readSvt(arguments.input));
    const Vec3d place{arguments.at[0], arguments.at[1], arguments.at[2]};
    SVT_TRY(table, probeTable(*field, *volume, std::span(&place, 1)));
    const bool isMissing =
        std::all_of(table->rows.begin(), table->rows.end(), [](const Row& row) { return row.back().isEmpty(); });
    SVT_DO(putTable(*table, *table, arguments.output, arguments.json, arguments.csv));
    if (isMissing)
        note(fmt::format("the field has no value at {},{},{}: the place is outside of its medium '{}' or of its places",
                         place.x, place.y, place.z, field->head.medium));
    return kDone;
}

Result<int> runFieldRemove(const FieldRemoveArguments& arguments) {
    SVT_DO(requireSvt(arguments.input));
    const std::filesystem::path& output = arguments.output.empty() ? arguments.input : arguments.output;
    SVT_TRY(bytes, fields::writeFields(arguments.input, output, {}, arguments.names));
    summarize(fmt::format("{}: {} {} removed, {:.1f} kB", output.string(), arguments.names.size(),
                          arguments.names.size() == 1 ? "field" : "fields", double(*bytes) / 1000));
    return kDone;
}

template <class All>
constexpr auto volumeInput(std::string_view help) {
    return member<&All::input>("volume", help, {.value = "F.svt", .isRequired = true, .file = FileUse::ModelOrVolume});
}
template <class All>
constexpr auto nameOption() {
    return member<&All::name>("name", "the name of the field, see 'svt field list'",
                              {.value = "NAME", .isRequired = true});
}
template <class All>
constexpr auto csvOption() {
    return member<&All::csv>("--csv", "print the rows as CSV on stdout", {.group = "Output"});
}
template <class All>
constexpr auto jsonRowsOption() {
    return member<&All::json>("--json", "print the rows as JSON on stdout", {.group = "Output", .excludes = "--csv"});
}

Members<FieldListArguments> membersOf(const FieldListArguments*) noexcept {
    using All = FieldListArguments;
    static constexpr Member<All> kMembers[] = {volumeInput<All>("a .svt"), jsonOption<&All::json>(),
                                               quietOption<All>()};
    return kMembers;
}

Members<FieldStatsArguments> membersOf(const FieldStatsArguments*) noexcept {
    using All = FieldStatsArguments;
    using fields::StatisticsOptions;
    static constexpr Member<All> kMembers[] = {
        volumeInput<All>("a .svt with the field"),
        nameOption<All>(),
        member<&All::by>(
            "--by",
            "a row for each feature that a query selects, such as class=BuildingRoom; storeys and other groups "
            "with all their parts",
            {.value = "QUERY", .otherwise = "all components in the medium of the field"}),
        member<&All::options, &StatisticsOptions::over>(
            "--over",
            "share of the volume above this value, in the unit of the field, and hours with the mean above it"),
        member<&All::options, &StatisticsOptions::under>(
            "--under", "share of the volume below this value, and hours with the mean below it"),
        member<&All::output>("-o,--output", "write the rows of all times to a file",
                             {.value = "FILE", .file = FileUse::Output, .formats = "csv|json|objectparquet"}),
        jsonRowsOption<All>(),
        csvOption<All>(),
        threadsOption<&All::options, &StatisticsOptions::threads>(),
        quietOption<All>(),
    };
    return kMembers;
}

Members<FieldProbeArguments> membersOf(const FieldProbeArguments*) noexcept {
    using All = FieldProbeArguments;
    static constexpr Member<All> kMembers[] = {
        volumeInput<All>("a .svt with the field"),
        nameOption<All>(),
        memberAs<record::Numbers<3>, &All::at>("--at", "the place in world space",
                                               {.value = "X,Y,Z", .unit = "metres", .isRequired = true}),
        member<&All::output>("-o,--output", "write the rows to a file",
                             {.value = "FILE", .file = FileUse::Output, .formats = "csv|json|objectparquet"}),
        jsonRowsOption<All>(),
        csvOption<All>(),
        quietOption<All>(),
    };
    return kMembers;
}

Members<FieldRemoveArguments> membersOf(const FieldRemoveArguments*) noexcept {
    using All = FieldRemoveArguments;
    static constexpr Member<All> kMembers[] = {
        member<&All::input>("volume", "the .svt with the fields",
                            {.value = "F.svt", .isRequired = true, .file = FileUse::OtherInput, .isReadAgain = true}),
        member<&All::names>("name", "names of the fields, see 'svt field list'", {.value = "NAME", .isRequired = true}),
        member<&All::output>("-o,--output", "the .svt to write",
                             {.value = "F.svt",
                              .otherwise = "the volume itself, which is replaced after all is written",
                              .file = FileUse::Output,
                              .formats = "svt"}),
        quietOption<All>(),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kFieldListCommand = commandOf<FieldListArguments, runFieldList>(
    "field-list", "List the fields of a volume: temperatures, smoke, sensors");
extern const CommandText kFieldAddCommand =
    commandOf<FieldAddArguments, runFieldAdd>("field-add", "Add the values of a simulation or of sensors to a volume");
extern const CommandText kFieldStatsCommand =
    commandOf<FieldStatsArguments, runFieldStats>("field-stats", "Statistics of a field per component or room");
extern const CommandText kFieldProbeCommand =
    commandOf<FieldProbeArguments, runFieldProbe>("field-probe", "Print the values of a field at a place over time");
extern const CommandText kFieldExportCommand = commandOf<FieldExportArguments, runFieldExport>(
    "field-export", "Write a field for other programs: VTK, NRRD, tables");
extern const CommandText kFieldRemoveCommand =
    commandOf<FieldRemoveArguments, runFieldRemove>("field-remove", "Remove fields from a volume");

}  // namespace svt::cli
