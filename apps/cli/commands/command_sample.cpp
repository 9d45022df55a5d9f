#include <apps/cli/options/catalog.hpp>
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
    samples::SampleKind kind = samples::SampleKind::House;
    std::optional<samples::SampleFormat> format;
    std::filesystem::path output;
    samples::SampleOptions options;
};

// The caller has checked that the ending is one of these.
samples::SampleFormat formatOf(const SampleArguments& arguments) {
    using enum samples::SampleFormat;
    if (arguments.format) return *arguments.format;
    const std::string ending = endingOf(arguments.output);
    return ending == ".ifc" ? Ifc4 : ending == ".jsonl" ? CityJsonSeq2 : ending == ".json" ? CityJson2 : CityGml3;
}

Result<int> runSample(const SampleArguments& arguments) {
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
        quietOption<All>(),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kSampleCommand =
    commandOf<SampleArguments, runSample>("sample", "Write a generated model: a house, a tower of flats, a district");

}  // namespace svt::cli
