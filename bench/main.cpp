// svt_bench: times every stage, and beside it VTK, OpenVDB and libcitygml, in one run on one machine.
#include <bench/benches.hpp>
#include <bench/machine.hpp>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <unistd.h>
#include <algorithm>

#include <cstdio>
#include <fstream>
#include <string>

namespace svt::bench {

void tell(const std::string& text) { fmt::print(stderr, "svt_bench: {}\n", text); }

namespace {

Result<void> runAll(const BenchOptions& options, const std::vector<std::string>& parts, Report& report) {
    const auto isAsked = [&](const char* part) {
        return parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end();
    };
    const auto inputs = findInputs(options.scratch, report.skipped);
    if (!inputs) return inputs.error();
    if (isAsked("read"))
        if (auto done = benchRead(options, report); !done) return done;
    for (const Input& input : *inputs) {
        if (!isAsked("voxelize") && !isAsked("render") && !isAsked("stages")) break;
        const auto scene = loadScene(input);
        if (!scene) return scene.error();
        if (isAsked("voxelize"))
            if (auto done = benchVoxelize(*scene, options, report); !done) return done;
        if (isAsked("render"))
            if (auto done = benchRender(*scene, options, report); !done) return done;
        if (isAsked("stages"))
            if (auto done = benchStages(input, *scene, options, report); !done) return done;
    }
    return {};
}

int run(BenchOptions options, const std::vector<std::string>& parts, const std::string& jsonFile,
        const std::string& commit) {
    if (options.isQuick) options.measure = {3, 9, 2, 5};
    options.scratch = std::filesystem::temp_directory_path() / fmt::format("svt_bench_{}", getpid());
    std::filesystem::create_directories(options.scratch);
    Report report;
    report.machine = describeMachine();
    report.commit = commit;
    report.isQuick = options.isQuick;
    const auto done = runAll(options, parts, report);
    std::filesystem::remove_all(options.scratch);
    if (!done) {
        tell(done.error().toString());
        return 1;
    }
    fmt::print("{}", report.markdown());
    if (jsonFile.empty()) return 0;
    std::ofstream out(jsonFile);
    out << report.json().dump(1) << '\n';
    if (!out.good()) {
        tell(fmt::format("cannot write {}", jsonFile));
        return 5;
    }
    return 0;
}

}  // namespace
}  // namespace svt::bench

int main(int argc, char** argv) {
    CLI::App app("Times SVT stage by stage, beside VTK, OpenVDB and libcitygml in the same run. Tables on stdout.");
    svt::bench::BenchOptions options;
    std::vector<std::string> parts;
    std::string jsonFile, commit;
    app.add_flag("--quick", options.isQuick, "the small grid alone, fewer runs: about half a minute");
    app.add_option("--only", parts, "parts to run: read, voxelize, render, stages; all without it")
        ->check(CLI::IsMember({"read", "voxelize", "render", "stages"}));
    app.add_option("--json", jsonFile, "also write all figures to this file")->type_name("FILE");
    app.add_option("--commit", commit, "written into the figures");
    CLI11_PARSE(app, argc, argv);
    return svt::bench::run(std::move(options), parts, jsonFile, commit);
}
