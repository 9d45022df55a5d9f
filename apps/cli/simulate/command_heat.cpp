#include <apps/cli/city/city_input.hpp>
#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/load_volume.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/file_content.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/terminal_progress.hpp>
#include <apps/cli/simulate/heat_report.hpp>

#include <svt/analyze/solid_overlaps.hpp>
#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/fields/svt_fields.hpp>
#include <svt/model/query.hpp>
#include <svt/simulate/heat_over_time.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>

#include <optional>

namespace svt::cli {
namespace {

constexpr double kMinute = 60, kHour = 3600;  // seconds

struct HeatArguments {
    std::filesystem::path input, output, materials;
    double outside = -5;
    std::vector<std::string> inside;
    double rsi = 0.13, rsiUp = 0.10, rsiDown = 0.17, rse = 0.04;
    std::string name = "temperature";
    bool isLeaky = false, json = false, csv = false;
    std::optional<double> hours, start;
    double step = simulate::TimeOptions().step / kMinute, every = simulate::TimeOptions().every / kHour;
    std::filesystem::path weather;
    pipeline::BuildOptions build;
};

Result<simulate::HeatOptions> optionsOf(const HeatArguments& arguments) {
    simulate::HeatOptions options;
    options.outside = arguments.outside;
    for (const std::string& text : arguments.inside) {
        SVT_TRY(rule, model::parseQueryValue(text, "QUERY:CELSIUS of --inside, such as 'name=Bath:24'"));
        options.inside.push_back({std::move(rule->query), rule->value});
    }
    if (!arguments.materials.empty()) {
        SVT_TRY(bytes, FileBytes::read(arguments.materials));
        SVT_TRY(rules, simulate::parseThermalRules(bytes->text(), arguments.materials.string()));
        for (const simulate::ThermalRule& rule : *rules) SVT_DO(model::Query::parse(rule.query));
        options.materials = std::move(*rules);
    }
    options.resistances = {arguments.rsi, arguments.rsiUp, arguments.rsiDown, arguments.rse};
    options.isLeaky = arguments.isLeaky;
    options.name = arguments.name;
    options.threads = arguments.build.threads;
    return options;
}

// The options of time; none without --hours.
Result<std::optional<simulate::TimeOptions>> timesOf(const HeatArguments& arguments) {
    if (!arguments.hours) {
        const HeatArguments usual;
        if (arguments.step != usual.step || arguments.every != usual.every || arguments.start ||
            !arguments.weather.empty())
            return Error(Code::BadArgument,
                         "--step, --every, --start and --weather are for temperatures over time; give --hours as well");
        return std::optional<simulate::TimeOptions>();
    }
    simulate::TimeOptions time;
    time.hours = *arguments.hours;
    time.step = kMinute * arguments.step;
    time.every = kHour * arguments.every;
    time.start = arguments.start;
    if (!arguments.weather.empty()) {
        SVT_TRY(bytes, FileBytes::read(arguments.weather));
        SVT_TRY(weather, simulate::parseWeather(bytes->text(), arguments.weather.string()));
        time.weather = std::move(*weather);
        if (time.weather.hasNoZone) note("the times of the weather have no zone; they count as UTC");
    }
    return std::optional(std::move(time));
}

Result<void> writeField(const HeatArguments& arguments, const volume::SemanticVolume& volume,
                        const fields::Field& field) {
    std::filesystem::path source = arguments.input;
    if (contentOf(arguments.input) != FileContent::Volume) {
        SVT_DO(volume::writeSvt(volume, arguments.output));
        source = arguments.output;
    }
    SVT_DO(fields::writeFields(source, arguments.output, std::span(&field, 1)));
    return {};
}

template <class HeatOutput>
void printHeat(const HeatArguments& arguments, const volume::SemanticVolume& volume, const HeatOutput& result) {
    if (arguments.json)
        print(heatJson(volume, result));
    else if (arguments.csv || arguments.output.empty())
        print(heatTable(volume, result), arguments.csv ? TableFormat::Csv : TableFormat::Text);
}

Result<int> runSteady(const HeatArguments& arguments, const volume::SemanticVolume& volume,
                      const simulate::HeatOptions& options, std::optional<TerminalProgress>& progress) {
    Diagnostics findings;
    auto result = simulate::simulateHeat(volume, options, findings);
    progress.reset();
    printVolumeFindings(findings, volume.source, arguments.input);
    if (!result) return result.error();
    if (!arguments.output.empty()) SVT_DO(writeField(arguments, volume, result->temperature));
    for (const std::string& text : heatNotes(volume, *result)) note(text);
    printHeat(arguments, volume, *result);
    if (!arguments.output.empty())
        summarize(fmt::format("{}: field '{}', {} rooms, {:.0f} W to outside air", arguments.output.string(),
                              arguments.name, result->rooms.size(), -result->outside.watts));
    return kDone;
}

Result<int> runOverTime(const HeatArguments& arguments, const volume::SemanticVolume& volume,
                        const simulate::HeatOptions& options, const simulate::TimeOptions& time,
                        std::optional<TerminalProgress>& progress) {
    Diagnostics findings;
    auto result = simulate::simulateHeatOverTime(volume, options, time, findings);
    progress.reset();
    printVolumeFindings(findings, volume.source, arguments.input);
    if (!result) return result.error();
    if (!arguments.output.empty()) SVT_DO(writeField(arguments, volume, result->temperature));
    for (const std::string& text : heatNotes(*result)) note(text);
    printHeat(arguments, volume, *result);
    if (!arguments.output.empty())
        summarize(fmt::format("{}: field '{}', {} rooms, {} times from 0 to {:g} h", arguments.output.string(),
                              arguments.name, result->times.front().rooms.size(), result->times.size(), time.hours));
    return kDone;
}

Result<int> runHeat(const HeatArguments& arguments) {
    if (isCity(arguments.input))
        return Error(Code::BadArgument,
                     "'" + arguments.input.string() + "' is a city; simulate parts of it (svt city extract)");
    SVT_TRY(options, optionsOf(arguments));
    SVT_TRY(time, timesOf(arguments));
    std::optional<TerminalProgress> progress(std::in_place);
    pipeline::BuildOptions build = arguments.build;
    // The faces of the model are planes of the volume; the file of -o keeps the meshes.
    build.vectors = {.meshes = true, .isRequired = false};
    SVT_TRY(volume, loadVolume(arguments.input, build, progress->get(), false));
    options->progress = progress->get();
    options->priority = analyze::labelsByPriority(volume->labels);
    return *time ? runOverTime(arguments, *volume, *options, **time, progress)
                 : runSteady(arguments, *volume, *options, progress);
}

Members<HeatArguments> membersOf(const HeatArguments*) noexcept {
    using All = HeatArguments;
    static constexpr Member<All> kMembers[] = {
        modelInput<&All::input>("a .svt or a model file"),
        member<&All::outside>("--outside", "temperature of outside air",
                              {.unit = "degrees Celsius", .least = -273.15, .most = 5000, .group = "Air"}),
        member<&All::inside>(
            "--inside", "temperature of the rooms that a query selects, such as 'name=Bath:24'",
            {.value = "QUERY:C", .otherwise = "by the model (SpaceTemperatureMin), else 20", .group = "Air"}),
        member<&All::rsi>("--rsi", "surface resistance inside at walls",
                          {.unit = "m2 K/W", .least = 0, .most = 100, .group = "Air"}),
        member<&All::rsiUp>("--rsi-up", "surface resistance inside at ceilings, where heat flows up",
                            {.unit = "m2 K/W", .least = 0, .most = 100, .group = "Air"}),
        member<&All::rsiDown>("--rsi-down", "surface resistance inside at floors, where heat flows down",
                              {.unit = "m2 K/W", .least = 0, .most = 100, .group = "Air"}),
        member<&All::rse>("--rse", "surface resistance outside",
                          {.unit = "m2 K/W", .least = 0, .most = 100, .group = "Air"}),
        member<&All::isLeaky>("--leaky", "compute although rooms are open to outside air, without the heat of this air",
                              {.group = "Air"}),
        member<&All::materials>("--materials",
                                "conductivities: a table with the columns query, conductivity, density, specificHeat",
                                {.value = "T.csv", .group = "Materials", .file = FileUse::OtherInput}),
        member<&All::hours>(
            "--hours", "compute temperatures over this time, with the heat that components store",
            {.unit = "hours", .least = 0, .most = 1e6, .otherwise = "the steady state", .group = "Time"}),
        member<&All::weather>("--weather", "temperatures of outside air: a table with the columns time and temperature",
                              {.value = "W.csv",
                               .otherwise = "the temperature of --outside",
                               .group = "Time",
                               .file = FileUse::OtherInput}),
        member<&All::start>("--start", "temperature of all components at first",
                            {.unit = "degrees Celsius",
                             .least = -273.15,
                             .most = 5000,
                             .otherwise = "the steady state at the first temperature of outside air",
                             .group = "Time"}),
        member<&All::step>("--step", "length of a step of time",
                           {.unit = "minutes", .least = 0.001, .most = 1e6, .group = "Time"}),
        member<&All::every>("--every", "time between results, a whole number of steps",
                            {.unit = "hours", .least = 0.0001, .most = 1e6, .group = "Time"}),
        member<&All::output>("-o,--output", "write the volume with the field of temperatures",
                             {.value = "F.svt", .group = "Output", .file = FileUse::Output, .formats = "svt"}),
        member<&All::name>("--name", "name of the field", {.value = "NAME", .group = "Output"}),
        member<&All::json>("--json", "print rooms, outside air and everything assumed as JSON on stdout",
                           {.group = "Output", .excludes = "--csv"}),
        member<&All::csv>("--csv", "print the rows as CSV on stdout", {.group = "Output"}),
        quietOption<All>(),
        part<&All::build>("build"),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kSimulateHeatCommand =
    commandOf<HeatArguments, runHeat>("simulate-heat", "Compute temperatures of walls, and the heat that rooms lose");

}  // namespace svt::cli
