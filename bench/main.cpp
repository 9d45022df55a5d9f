// svt_bench: times every stage together with VTK, OpenVDB, libcitygml and the paper's own method, in one run on one
// machine. scripts/bench.py runs it part by part and makes the tables.
#include <bench/benches.hpp>
#include <bench/machine.hpp>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <unistd.h>
#include <algorithm>

#include <cstdio>
#include <fstream>
#include <map>
#include <string>

namespace svt::bench {

void tell(const std::string& text) { fmt::print(stderr, "svt_bench: {}\n", text); }

namespace {

const std::vector<std::string> kParts{"read", "voxelize", "render", "stages", "scaling"};
const std::map<std::string, ProfilePiece> kPieces{{"count", ProfilePiece::Count},
                                                  {"prepare", ProfilePiece::Prepare},
                                                  {"voxelize", ProfilePiece::Voxelize},
                                                  {"opaque", ProfilePiece::Opaque},
                                                  {"translucent", ProfilePiece::Translucent}};

struct Arguments {
    BenchOptions options;
    std::vector<std::string> parts;
    std::string jsonFile, profile;
};

Result<void> runParts(const Arguments& arguments, const std::vector<Input>& inputs, Report& report) {
    const BenchOptions& options = arguments.options;
    const auto isAsked = [&](const char* part) {
        return arguments.parts.empty() ||
               std::find(arguments.parts.begin(), arguments.parts.end(), part) != arguments.parts.end();
    };
    if (isAsked("read"))
        if (auto done = benchRead(options, report); !done) return done;
    for (const Input& input : inputs) {
        if (options.isQuick && input.name == kTurnedHouse) continue;
        SVT_TRY(workload, loadWorkload(input));
        if (isAsked("voxelize"))
            if (auto done = benchVoxelize(*workload, options, report); !done) return done;
        if (isAsked("render"))
            if (auto done = benchRender(*workload, options, report); !done) return done;
        if (isAsked("stages"))
            if (auto done = benchStages(input, *workload, options, report); !done) return done;
        if (isAsked("scaling") && (input.name == kHouse || input.name == kTurnedHouse))
            if (auto done = benchScaling(*workload, options, report); !done) return done;
    }
    if (isAsked("scaling") && !options.isQuick) return benchDistrict(options, report);
    return {};
}

Result<void> runAll(const Arguments& arguments, Report& report) {
    SVT_TRY(inputs, findInputs(arguments.options.scratch, report.skipped));
    if (arguments.profile.empty()) return runParts(arguments, *inputs, report);
    return runProfilePiece(kPieces.at(arguments.profile), inputs->front());
}

int run(Arguments arguments) {
    BenchOptions& options = arguments.options;
    if (options.isQuick) options.measure = {0.05, 3, 9, 2, 3};
    options.scratch = std::filesystem::temp_directory_path() / fmt::format("svt_bench_{}", getpid());
    std::filesystem::create_directories(options.scratch);
    if (!options.pictures.empty()) std::filesystem::create_directories(options.pictures);
    Report report;
    report.machine = describeMachine();
    const auto done = runAll(arguments, report);
    std::filesystem::remove_all(options.scratch);
    if (!done) {
        tell(done.error().toString());
        return 1;
    }
    if (!arguments.profile.empty()) return 0;
    const std::string text = report.json().dump(1) + '\n';
    if (arguments.jsonFile.empty()) {
        fmt::print("{}", text);
        return 0;
    }
    std::ofstream out(arguments.jsonFile);
    out << text << std::flush;
    if (!out.good()) {
        tell(fmt::format("cannot write {}", arguments.jsonFile));
        return 5;
    }
    return 0;
}

}  // namespace
}  // namespace svt::bench

int main(int argc, char** argv) {
    CLI::App app(
        "Times SVT stage by stage, beside VTK, OpenVDB, libcitygml and the paper's own method. JSON on stdout.");
    svt::bench::Arguments arguments;
    std::vector<std::string> pieces;
    for (const auto& [name, piece] : svt::bench::kPieces) pieces.push_back(name);
    app.add_flag("--quick", arguments.options.isQuick, "the small grid alone, without the turned house, fewer runs");
    app.add_option("--only", arguments.parts, "parts to run: read, voxelize, render, stages, scaling; all without it")
        ->check(CLI::IsMember(svt::bench::kParts));
    app.add_option("--json", arguments.jsonFile, "write the figures to this file instead")->type_name("FILE");
    app.add_option("--pictures", arguments.options.pictures, "also write the pictures that are compared, as PNG")
        ->type_name("FOLDER");
    app.add_option("--profile", arguments.profile,
                   "run one piece once with one thread, for a profiler; `count` prints "
                   "how many crossings and rays the pieces have")
        ->check(CLI::IsMember(pieces));
    CLI11_PARSE(app, argc, argv);
    return svt::bench::run(std::move(arguments));
}
