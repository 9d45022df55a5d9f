#include <apps/cli/cli.hpp>

#include <svt/core/file.hpp>
#include <svt/samples/sample.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {
namespace {

struct Arguments {
    std::string kind, format;
    std::filesystem::path output;
    samples::SampleOptions options;
};

Result<samples::SampleFormat> formatOf(const Arguments& arguments) {
    if (arguments.format == "citygml3") return samples::SampleFormat::CityGml3;
    if (arguments.format == "citygml2") return samples::SampleFormat::CityGml2;
    if (arguments.format == "cityjson") return samples::SampleFormat::CityJson2;
    if (arguments.format == "cityjsonseq") return samples::SampleFormat::CityJsonSeq2;
    const std::string extension = arguments.output.extension().string();
    if (extension == ".gml" || extension == ".xml") return samples::SampleFormat::CityGml3;
    if (extension == ".json") return samples::SampleFormat::CityJson2;
    if (extension == ".jsonl") return samples::SampleFormat::CityJsonSeq2;
    return Error(Code::BadArgument,
                 fmt::format("'{}': the extension tells no format; use .gml, .json, .jsonl or --format",
                             arguments.output.string()));
}

int runSample(const Arguments& arguments) {
    const auto format = formatOf(arguments);
    if (!format) return fail(format.error());
    const auto kind = arguments.kind == "house"   ? samples::SampleKind::House
                      : arguments.kind == "tower" ? samples::SampleKind::Tower
                                                  : samples::SampleKind::District;
    auto file = AtomicFile::create(arguments.output);
    if (!file) return fail(file.error());
    std::optional<Error> writeError;
    const auto written = samples::writeSample(kind, *format, arguments.options, [&](std::string_view text) {
        auto done = file->write(std::as_bytes(std::span(text)));
        if (!done) writeError = done.error();
        return done.hasValue();
    });
    if (writeError) return fail(*writeError);
    if (!written) return fail(written.error());
    if (auto committed = file->commit(); !committed) return fail(committed.error());
    return kDone;
}

}  // namespace

Run addSampleCommand(CLI::App& app) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("sample", "Write a generated model: a house, a tower of flats, a district");
    command->add_option("kind", arguments->kind, "house, tower or district")
        ->required()
        ->check(CLI::IsMember({"house", "tower", "district"}));
    command
        ->add_option("-o,--output", arguments->output,
                     "model to write: .gml (CityGML 3.0), .json (CityJSON 2.0), .jsonl (CityJSONSeq)")
        ->required();
    command
        ->add_option("--format", arguments->format,
                     "citygml3, citygml2, cityjson or cityjsonseq; default: by extension")
        ->check(CLI::IsMember({"citygml3", "citygml2", "cityjson", "cityjsonseq"}));
    auto& options = arguments->options;
    command->add_option("--seed", options.seed, "decides owners and the houses of a district")->capture_default_str();
    command->add_option("--storeys", options.storeys, "tower: number of storeys, 1 to 200")->capture_default_str();
    command->add_option("--flats", options.flatsPerStorey, "tower: flats on each storey, 2 to 8")
        ->capture_default_str();
    command->add_option("--columns", options.columns, "district: houses from west to east, 1 to 1000")
        ->capture_default_str();
    command->add_option("--rows", options.rows, "district: houses from south to north, 1 to 1000")
        ->capture_default_str();
    command->add_option("--turn", options.turnDegrees, "turn in plan, degrees counter-clockwise, -360 to 360")
        ->capture_default_str();
    command->add_flag("--thematic", options.thematic, "CityGML 2.0: walls only as surfaces, as LoD4 has them");
    return [arguments] { return runSample(*arguments); };
}

}  // namespace svt::cli
