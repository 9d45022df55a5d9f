#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/core/file.hpp>
#include <svt/samples/sample.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {
namespace {

struct SampleArguments {
    samples::SampleKind kind = samples::SampleKind::House;
    std::optional<samples::SampleFormat> format;
    std::filesystem::path output, changeList;
    samples::SampleOptions options;
};

// The caller has checked that the ending is one of these.
samples::SampleFormat formatOf(const SampleArguments& arguments) {
    using enum samples::SampleFormat;
    if (arguments.format) return *arguments.format;
    const std::string ending = endingOf(arguments.output);
    return ending == ".ifc" ? Ifc4 : ending == ".jsonl" ? CityJsonSeq2 : ending == ".json" ? CityJson2 : CityGml3;
}

// The word of `svt diff` for an edit. With other ids too, another class means that another object has the space.
std::string_view changeOf(samples::SampleEdit edit, bool hasNewIds) {
    using enum samples::SampleEdit;
    switch (edit) {
        case Move: return "moved";
        case Rotate:
        case Resize:
        case Hole: return "changed";
        case Delete: return "removed";
        case Duplicate: return "added";
        case Reclass: return hasNewIds ? "reassigned" : "same";
        case Rename: break;
    }
    return "same";
}

Json changeJson(const samples::SampleChange& change, bool hasNewIds) {
    const auto ids = [](const std::optional<std::string>& id) { return id ? Json{*id} : Json::array(); };
    Json json;
    json["edit"] = nameOf(change.edit);
    json["change"] = changeOf(change.edit, hasNewIds);
    json["old"] = ids(change.was);
    json["new"] = ids(change.is);
    json["vector"] = change.vector ? Json{change.vector->x, change.vector->y, change.vector->z} : Json();
    json["rotation"] = change.rotation ? Json(*change.rotation) : Json();
    json["added"] = change.added;
    json["removed"] = change.removed;
    Json& properties = json["properties"] = Json::object();
    if (!change.was || !change.is) return json;
    if (change.className.first != change.className.second)
        properties["class"] = {change.className.first, change.className.second};
    if (change.name.first != change.name.second) properties["name"] = {change.name.first, change.name.second};
    return json;
}

Result<void> writeChangeList(const SampleArguments& arguments) {
    SVT_TRY(changes, samples::describeChanges(arguments.kind, formatOf(arguments), arguments.options));
    Json json;
    Json& rows = json["rows"] = Json::array();
    for (const samples::SampleChange& change : changes->edits) rows.push_back(changeJson(change, changes->hasNewIds));
    json["newIds"] = changes->hasNewIds;
    json["newTriangles"] = changes->hasNewTriangles;
    json["reordered"] = changes->isReordered;
    SVT_DO(writeFileAtomically(arguments.changeList, json.dump(2) + "\n"));
    return {};
}

// Refuses options of other samples and formats, because they would have no effect.
Result<void> checkOptions(const SampleArguments& arguments) {
    using samples::SampleFormat;
    using samples::SampleKind;
    const samples::SampleOptions& given = arguments.options;
    const samples::SampleOptions usual;
    const SampleFormat format = formatOf(arguments);
    const struct {
        bool isGiven, hasEffect;
        std::string_view text;
    } all[] = {
        {given.storeys != usual.storeys || given.flatsPerStorey != usual.flatsPerStorey,
         arguments.kind == SampleKind::Tower, "--storeys and --flats: only for the sample tower"},
        {given.columns != usual.columns || given.rows != usual.rows, arguments.kind == SampleKind::District,
         "--columns and --rows: only for the sample district"},
        {given.thematic, format == SampleFormat::CityGml2, "--thematic: only for CityGML 2.0 (--format citygml2)"},
        {given.bakeOpenings, format == SampleFormat::Ifc4, "--bake-openings: only for IFC (-o FILE.ifc)"},
    };
    for (const auto& option : all)
        if (option.isGiven && !option.hasEffect) return Error(Code::BadArgument, std::string(option.text));
    return {};
}

Result<int> runSample(const SampleArguments& arguments) {
    SVT_DO(checkOptions(arguments));
    if (!arguments.changeList.empty() && !arguments.options.change)
        return Error(Code::BadArgument, "--change-list needs --change with a seed");
    SVT_TRY(file, AtomicFile::create(arguments.output));
    std::optional<Error> writeError;
    const TerminalProgress progress;
    Progress::tell(progress.get(), "write", 0);
    const auto written =
        samples::writeSample(arguments.kind, formatOf(arguments), arguments.options, [&](std::string_view text) {
            auto done = Progress::isCancelled(progress.get())
                            ? Result<void>(Error(Code::Cancelled, "stopped while writing"))
                            : file->write(text);
            if (!done) writeError = done.error();
            return done.hasValue();
        });
    if (writeError) return *writeError;
    if (!written) return written.error();
    if (!arguments.changeList.empty()) SVT_DO(writeChangeList(arguments));
    SVT_DO(file->commit());
    return kDone;
}

Members<SampleArguments> membersOf(const SampleArguments*) noexcept {
    using All = SampleArguments;
    using samples::SampleOptions;
    static constexpr Member<All> kMembers[] = {
        member<&All::kind>("kind", "house, tower or district", {.isRequired = true}),
        member<&All::output>(
            "-o,--output",
            "model to write: .gml (CityGML 3.0), .json (CityJSON 2.0), .jsonl (CityJSONSeq), .ifc (IFC4)",
            {.value = "FILE",
             .isRequired = true,
             .file = FileUse::Output,
             .formats = "citygml|cityjson|cityjsonseq|ifc"}),
        member<&All::format>("--format", "format of the model", {.otherwise = "by extension"}),
        member<&All::options, &SampleOptions::seed>("--seed", "seed of owners and of the houses of a district",
                                                    {.least = 0}),
        member<&All::options, &SampleOptions::storeys>("--storeys", "tower: number of storeys",
                                                       {.least = 1, .most = 200}),
        member<&All::options, &SampleOptions::flatsPerStorey>("--flats", "tower: flats on each storey",
                                                              {.least = 2, .most = 8}),
        member<&All::options, &SampleOptions::columns>("--columns", "district: houses from west to east",
                                                       {.least = 1, .most = 1000}),
        member<&All::options, &SampleOptions::rows>("--rows", "district: houses from south to north",
                                                    {.least = 1, .most = 1000}),
        member<&All::options, &SampleOptions::turnDegrees>(
            "--turn", "turn in plan", {.unit = "degrees counter-clockwise", .least = -360, .most = 360}),
        member<&All::options, &SampleOptions::thematic>("--thematic",
                                                        "CityGML 2.0: walls only as surfaces, as in LoD4"),
        member<&All::options, &SampleOptions::bakeOpenings>(
            "--bake-openings", "IFC: openings as holes of the bodies, without IfcOpeningElement"),
        member<&All::options, &SampleOptions::change>("--change", "house: seed of edits, for known answers of svt diff",
                                                      {.value = "SEED", .least = 0}),
        member<&All::changeList>("--change-list", "file for the known answer of --change (.json)",
                                 {.value = "FILE", .file = FileUse::Output, .formats = "json"}),
        quietOption<All>(),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kSampleCommand =
    commandOf<SampleArguments, runSample>("sample", "Write a generated model: a house, a tower of flats, a district");

}  // namespace svt::cli
