#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/field_input.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/table.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/fields/nearest_voxel.hpp>
#include <svt/fields/svt_fields.hpp>
#include <svt/model/query.hpp>
#include <svt/simulate/spread.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>

#include <optional>

namespace svt::cli {
namespace {

using simulate::SensorPlace, simulate::SpreadResult;
using volume::kNoLabel;

struct SpreadArguments {
    std::filesystem::path input, output;
    std::string sensors;
    simulate::SpreadOptions options;
    bool json = false, csv = false;
};

Table sensorTable(const volume::SemanticVolume& volume, const fields::Field& sensors, const SpreadResult& result) {
    Table table;
    table.columns = {{"sensor", "sensor"}, {"id", "room"}, {"name", "name"}, {"volume", "m3 reached"}};
    for (const SensorPlace& sensor : result.sensors) {
        const std::string& id = sensors.head.points[sensor.point].id;
        if (sensor.label == kNoLabel) {
            table.rows.push_back({id, Cell(), Cell(), Cell()});
            continue;
        }
        const volume::Label& room = volume.labels.labels[sensor.label];
        table.rows.push_back({id, room.id, room.name, sensor.volume});
    }
    return table;
}

Json spreadJson(const volume::SemanticVolume& volume, const fields::Field& sensors, const SpreadResult& result) {
    const std::vector<volume::Label>& labels = volume.labels.labels;
    Json places = Json::array(), without = Json::array(), touching = Json::array();
    for (const SensorPlace& sensor : result.sensors) {
        const bool hasRoom = sensor.label != kNoLabel;
        places.push_back({{"id", sensors.head.points[sensor.point].id},
                          {"room", hasRoom ? Json(labels[sensor.label].id) : Json()},
                          {"volume", hasRoom ? Json(sensor.volume) : Json()}});
    }
    for (const std::uint32_t room : result.dry) without.push_back(labels[room].id);
    for (const auto& [one, other] : result.touching) touching.push_back({labels[one].id, labels[other].id});
    return {{"field", result.field.head.name},
            {"sensors", std::move(places)},
            {"roomsWithoutValues", std::move(without)},
            {"touchingRooms", std::move(touching)},
            {"nodes", result.nodes}};
}

void printNotes(const fields::Field& sensors, const SpreadResult& result) {
    std::vector<std::string> outside;
    for (const SensorPlace& sensor : result.sensors)
        if (sensor.label == kNoLabel) outside.push_back(sensors.head.points[sensor.point].id);
    if (!outside.empty())
        note(fmt::format("{} of {} sensors do not count, because no room lies within {} m: {}", outside.size(),
                         result.sensors.size(), fields::kWallReach, fmt::join(outside, ", ")));
    if (!result.dry.empty())
        note(fmt::format(
            "{} rooms have no values, because no sensor reaches their air; --open with a door lets air pass",
            result.dry.size()));
    if (!result.touching.empty())
        note(
            fmt::format("{} pairs of rooms touch each other without a wall; no air passes between them, unless --open "
                        "selects one of them",
                        result.touching.size()));
}

Result<int> runSpread(const SpreadArguments& arguments) {
    for (const std::string& query : arguments.options.open) SVT_DO(model::Query::parse(query));
    std::optional<TerminalProgress> progress(std::in_place);
    SVT_DO(requireSvt(arguments.input));
    SVT_TRY(sensors, fields::readField(arguments.input, arguments.sensors));
    SVT_TRY(volume, volume::readSvt(arguments.input));
    simulate::SpreadOptions options = arguments.options;
    options.progress = progress->get();
    auto result = simulate::spreadSensors(*volume, *sensors, options);
    progress.reset();
    if (!result) return result.error();
    if (!arguments.output.empty())
        SVT_DO(fields::writeFields(arguments.input, arguments.output, std::span(&result->field, 1)));
    printNotes(*sensors, *result);
    if (arguments.json)
        print(spreadJson(*volume, *sensors, *result));
    else if (arguments.csv || arguments.output.empty())
        print(sensorTable(*volume, *sensors, *result), arguments.csv ? TableFormat::Csv : TableFormat::Text);
    if (!arguments.output.empty())
        summarize(fmt::format("{}: field '{}', {} nodes with values, {} times", arguments.output.string(),
                              result->field.head.name, result->nodes, result->field.head.times.size()));
    return kDone;
}

Members<SpreadArguments> membersOf(const SpreadArguments*) noexcept {
    using All = SpreadArguments;
    using simulate::SpreadOptions;
    static constexpr Member<All> kMembers[] = {
        member<&All::input>("volume", "the .svt with the sensors",
                            {.value = "F.svt", .isRequired = true, .file = FileUse::ModelOrVolume}),
        member<&All::sensors>("sensors", "name of the field of sensors, see 'svt field list'",
                              {.value = "NAME", .isRequired = true}),
        member<&All::options, &SpreadOptions::open>(
            "--open", "doors and other components that air passes, or rooms that are open to their neighbours",
            {.value = "QUERY", .group = "Air"}),
        member<&All::options, &SpreadOptions::step>("--step", "distance between the nodes of the field",
                                                    {.unit = "metres", .least = 0.001, .most = 1000, .group = "Air"}),
        member<&All::output>("-o,--output", "write the volume with the new field",
                             {.value = "F.svt", .group = "Output", .file = FileUse::Output, .formats = "svt"}),
        member<&All::options, &SpreadOptions::name>("--name", "name of the new field",
                                                    {.value = "NAME", .group = "Output"}),
        member<&All::json>("--json", "print sensors and rooms as JSON on stdout",
                           {.group = "Output", .excludes = "--csv"}),
        member<&All::csv>("--csv", "print the sensors as CSV on stdout", {.group = "Output"}),
        quietOption<All>(),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kSimulateSpreadCommand = commandOf<SpreadArguments, runSpread>(
    "simulate-spread", "Continue the values of sensors through the air of their rooms");

}  // namespace svt::cli
