#include <apps/cli/options/command_line.hpp>
#include <apps/cli/options/shared_options.hpp>
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
    std::string kind, format;
    std::filesystem::path output;
    samples::SampleOptions options;
};

// The ending is one of these, which is checked before.
samples::SampleFormat formatOf(const SampleArguments& arguments) {
    const std::string ending = endingOf(arguments.output);
    if (arguments.format == "citygml3") return samples::SampleFormat::CityGml3;
    if (arguments.format == "citygml2") return samples::SampleFormat::CityGml2;
    if (arguments.format == "ifc" || (arguments.format.empty() && ending == ".ifc")) return samples::SampleFormat::Ifc4;
    if (arguments.format == "cityjson") return samples::SampleFormat::CityJson2;
    if (arguments.format == "cityjsonseq" || ending == ".jsonl") return samples::SampleFormat::CityJsonSeq2;
    return ending == ".json" ? samples::SampleFormat::CityJson2 : samples::SampleFormat::CityGml3;
}

int runSample(const SampleArguments& arguments) {
    const auto kind = arguments.kind == "house"   ? samples::SampleKind::House
                      : arguments.kind == "tower" ? samples::SampleKind::Tower
                                                  : samples::SampleKind::District;
    auto file = AtomicFile::create(arguments.output);
    if (!file) return fail(file.error());
    std::optional<Error> writeError;
    const TerminalProgress progress;
    Progress::tell(progress.get(), "write", 0);
    const auto written = samples::writeSample(kind, formatOf(arguments), arguments.options, [&](std::string_view text) {
        auto done = Progress::isCancelled(progress.get())
                        ? Result<void>(Error(Code::Cancelled, "stopped while writing"))
                        : file->write(text);
        if (!done) writeError = done.error();
        return done.hasValue();
    });
    if (writeError) return fail(*writeError);
    if (!written) return fail(written.error());
    if (auto committed = file->commit(); !committed) return fail(committed.error());
    return kDone;
}

constexpr Option kSample[] = {
    {.name = "kind", .choices = "house|tower|district", .help = "house, tower or district", .isRequired = true},
    {.name = "-o,--output",
     .value = "FILE",
     .help = "model to write: .gml (CityGML 3.0), .json (CityJSON 2.0), .jsonl (CityJSONSeq), .ifc (IFC4)",
     .isRequired = true,
     .file = FileUse::Output,
     .formats = "citygml|cityjson|cityjsonseq|ifc"},
    {.name = "--format",
     .choices = "citygml3|citygml2|cityjson|cityjsonseq|ifc",
     .otherwise = "by extension",
     .help = "format of the model"},
    {.name = "--seed",
     .kind = Whole,
     .least = 0,
     .byDefault = "1",
     .help = "decides owners and the houses of a district"},
    {.name = "--storeys", .kind = Whole, .least = 1, .most = 200, .byDefault = "8", .help = "tower: number of storeys"},
    {.name = "--flats", .kind = Whole, .least = 2, .most = 8, .byDefault = "4", .help = "tower: flats on each storey"},
    {.name = "--columns",
     .kind = Whole,
     .least = 1,
     .most = 1000,
     .byDefault = "4",
     .help = "district: houses from west to east"},
    {.name = "--rows",
     .kind = Whole,
     .least = 1,
     .most = 1000,
     .byDefault = "3",
     .help = "district: houses from south to north"},
    {.name = "--turn",
     .kind = Number,
     .unit = "degrees counter-clockwise",
     .least = -360,
     .most = 360,
     .byDefault = "0",
     .help = "turn in plan"},
    {.name = "--thematic", .kind = Flag, .help = "CityGML 2.0: walls only as surfaces, as LoD4 has them"},
};

Action connectSample(Command& command) {
    auto arguments = std::make_shared<SampleArguments>();
    command.set("kind", arguments->kind);
    command.set("--output", arguments->output);
    command.set("--format", arguments->format);
    samples::SampleOptions& options = arguments->options;
    command.set("--seed", options.seed);
    command.set("--storeys", options.storeys);
    command.set("--flats", options.flatsPerStorey);
    command.set("--columns", options.columns);
    command.set("--rows", options.rows);
    command.set("--turn", options.turnDegrees);
    command.set("--thematic", options.thematic);
    return [arguments] { return runSample(*arguments); };
}

}  // namespace

extern const CommandText kSampleCommand{.name = "sample",
                                        .help = "Write a generated model: a house, a tower of flats, a district",
                                        .sets = {kSample, kQuiet},
                                        .connect = connectSample};

}  // namespace svt::cli
