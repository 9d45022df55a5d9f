#include <apps/cli/field/field_add.hpp>

#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/core/machine.hpp>
#include <svt/field_readers/read_fields.hpp>
#include <svt/fields/field.hpp>
#include <svt/fields/field_sampler.hpp>
#include <svt/fields/svt_fields.hpp>
#include <svt/fields/units.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace svt::cli {
namespace {

field_readers::FieldReadOptions readOptions(const FieldAddArguments& arguments) {
    field_readers::FieldReadOptions options;
    options.quantity = arguments.quantity;
    options.unit = arguments.unit;
    options.medium = arguments.medium;
    if (arguments.from) options.firstTime = *arguments.from;
    if (arguments.to) options.lastTime = *arguments.to;
    options.timeStep = arguments.every.value_or(0);
    options.precision = arguments.precision;
    if (arguments.at.size() == 3) options.at = Vec3d{arguments.at[0], arguments.at[1], arguments.at[2]};
    options.places = arguments.places;
    // Values, their rounded copies and the file are in memory at once.
    if (const auto grant = memoryGrant()) options.maxBytes = std::min(options.maxBytes, grant->bytes / 3);
    return options;
}

// Gives the field the name of --name, and checks that no name is taken.
Result<void> nameFields(const FieldAddArguments& arguments, std::vector<fields::Field>& added) {
    if (!arguments.name.empty()) {
        if (added.size() > 1) {
            std::string names;
            for (const fields::Field& field : added) names += (names.empty() ? "" : ", ") + field.head.name;
            return Error(Code::BadArgument,
                         fmt::format("--name names one field, and the file has {}: {}; choose one with "
                                     "--quantity",
                                     added.size(), names));
        }
        added[0].head.name = arguments.name;
    }
    if (arguments.replace) return {};
    SVT_TRY(present, fields::readFieldHeads(arguments.volume));
    for (const fields::Field& field : added)
        for (const fields::FieldHead& head : *present)
            if (head.name == field.head.name)
                return Error(
                    Code::BadArgument,
                    fmt::format("the volume has a field '{}' already; replace it with --replace, or give another "
                                "name with --name",
                                head.name),
                    {arguments.volume.string(), 0, 0, {}});
    return {};
}

// Assumptions as plain notes, and the findings.
void printAddFindings(const Diagnostics& diagnostics) {
    Diagnostics findings;
    for (const Diagnostic& item : diagnostics.items())
        if (item.severity == Severity::Note)
            note(item.where.toString().empty() ? item.message : item.where.toString() + ": " + item.message);
        else
            findings.add(item.severity, item.code, item.message, item.where);
    printDiagnostics(findings, true);
}

std::string addedPlacesText(const fields::FieldHead& head) {
    const Vec3i size = head.lattice.size;
    return head.kind == fields::FieldKind::Grid ? fmt::format("{} x {} x {} nodes", size.x, size.y, size.z)
                                                : fmt::format("{} points", head.points.size());
}

// "temperature: 41 x 41 x 21 nodes, 31 times from 0 to 30 s, 20 to 254.3 °C, in steps of 0.005".
std::string fieldText(const fields::Field& field) {
    const fields::FieldHead& head = field.head;
    const std::string unit = fields::unitText(head.unit);
    const auto range = fields::rangeOf(field);
    std::string text = fmt::format("{}: {}, ", head.name, addedPlacesText(head));
    text += head.times.size() == 1 ? fmt::format("1 time, {:.6g} s", head.times[0])
                                   : fmt::format("{} times from {:.6g} to {:.6g} s", head.times.size(),
                                                 head.times.front(), head.times.back());
    if (head.epoch) text += fmt::format(" after {}", *head.epoch);
    text += range ? fmt::format(", {:.6g} to {:.6g} {}", range->first, range->second, unit) : ", no values";
    while (text.ends_with(' ')) text.pop_back();
    if (head.precision > 0) text += fmt::format(", in steps of {:.6g}", head.precision);
    return text;
}

Json fieldJson(const fields::Field& field) {
    const fields::FieldHead& head = field.head;
    const auto range = fields::rangeOf(field);
    Json json;
    json["name"] = head.name;
    json["kind"] = nameOf(head.kind);
    json["quantity"] = head.quantity;
    json["unit"] = head.unit;
    json["medium"] = head.medium;
    if (head.kind == fields::FieldKind::Grid)
        json["size"] = {head.lattice.size.x, head.lattice.size.y, head.lattice.size.z};
    else
        json["points"] = head.points.size();
    json["times"] = head.times;
    json["epoch"] = head.epoch ? Json(*head.epoch) : Json();
    json["range"] = range ? Json{range->first, range->second} : Json();
    json["precision"] = head.precision;
    json["by"] = head.by;
    json["parameters"] = head.parameters.empty() ? Json::object() : Json::parse(head.parameters, nullptr, false);
    return json;
}

}  // namespace

Result<int> runFieldAdd(const FieldAddArguments& arguments) {
    const TerminalProgress progress;
    if (!volume::isSvtFile(arguments.volume))
        return Error(Code::BadArgument, "fields are kept in a .svt; make one from the model with svt build",
                     {arguments.volume.string(), 0, 0, {}});
    Progress::tell(progress.get(), "read", 0);
    SVT_TRY(volume, volume::readSvt(arguments.volume));
    Diagnostics diagnostics;
    auto added = field_readers::readFields(arguments.file, *volume, readOptions(arguments), diagnostics);
    printAddFindings(diagnostics);
    if (!added) return added.error();
    SVT_DO(nameFields(arguments, *added));
    // A medium that selects nothing would show only later.
    for (const fields::Field& field : *added) SVT_DO(fields::mediumOf(field.head, *volume));
    Progress::tell(progress.get(), "write", 0);
    const std::filesystem::path& output = arguments.output.empty() ? arguments.volume : arguments.output;
    SVT_TRY(bytes, fields::writeFields(arguments.volume, output, *added));
    if (arguments.json) {
        Json json;
        json["volume"] = output.string();
        json["bytes"] = *bytes;
        json["fields"] = Json::array();
        for (const fields::Field& field : *added) json["fields"].push_back(fieldJson(field));
        json["findings"] = diagnosticsJson(diagnostics);
        print(json);
        return kDone;
    }
    for (const fields::Field& field : *added) summarize(fieldText(field));
    summarize(fmt::format("{}: {}, {} {}", output.string(), bytesText(*bytes), added->size(),
                          added->size() == 1 ? "field added" : "fields added"));
    return kDone;
}

Members<FieldAddArguments> membersOf(const FieldAddArguments*) noexcept {
    using All = FieldAddArguments;
    static constexpr Member<All> kMembers[] = {
        member<&All::volume>("volume", "the .svt that receives the fields",
                             {.value = "F.svt", .isRequired = true, .file = FileUse::OtherInput}),
        member<&All::file>(
            "file",
            "the file with values: .smv of FDS, .csv of sensors, .json of OGC SensorThings, .vti, .vtr or "
            ".pvd of VTK, .nrrd, a folder of OpenFOAM",
            {.value = "FILE", .isRequired = true, .file = FileUse::InputOrFolder}),
        member<&All::output>("-o,--output", "the .svt to write",
                             {.value = "F.svt",
                              .otherwise = "the volume itself, which is replaced after all is written",
                              .file = FileUse::Output,
                              .formats = "svt"}),
        member<&All::name>("--name", "name of the field, if the file has one",
                           {.value = "NAME", .otherwise = "by the quantity", .group = "Values"}),
        member<&All::replace>("--replace", "replace fields of the same name", {.group = "Values"}),
        member<&All::quantity>("--quantity", "the quantity to read of a file with several; names that of sensors",
                               {.value = "NAME", .otherwise = "all", .group = "Values"}),
        member<&All::unit>(
            "--unit",
            "UCUM code of the unit, such as Cel, K, kg/m3 or [ppm]; needed if the file states none; only Cel "
            "and K are converted into each other",
            {.value = "UNIT", .otherwise = "that of the file", .group = "Values"}),
        member<&All::medium>("--medium", "where the values count: air, solid, all, or a query",
                             {.value = "MEDIUM", .otherwise = "air; all for images", .group = "Values"}),
        member<&All::precision>(
            "--precision", "step between stored values, in the unit; 0 keeps them as 32-bit floats",
            {.least = 0, .otherwise = "at most 1/26000 of the range of the values; 0 for sensors", .group = "Values"}),
        member<&All::from>("--from", "first time",
                           {.unit = "seconds", .otherwise = "the first of the file", .group = "Times"}),
        member<&All::to>("--to", "last time",
                         {.unit = "seconds", .otherwise = "the last of the file", .group = "Times"}),
        member<&All::every>("--every", "time between kept values, at least",
                            {.unit = "seconds", .least = 0, .otherwise = "all times are kept", .group = "Times"}),
        memberAs<record::Numbers<3>, &All::at>("--at", "place of the file's origin in world space",
                                               {.value = "X,Y,Z",
                                                .unit = "metres",
                                                .otherwise = "as the file says, else the world's origin",
                                                .group = "Place"}),
        member<&All::places>(
            "--places",
            "table of the places of sensors: name,x,y,z in world space, or name,room with the id, the name "
            "or a query of a room",
            {.value = "F.csv", .group = "Place", .file = FileUse::OtherInput}),
        jsonOption<&All::json>(),
        verboseOption<&All::verbose>(),
        quietOption<All>(),
    };
    return kMembers;
}

}  // namespace svt::cli
