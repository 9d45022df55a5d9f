#include "cli.hpp"
#include "json_output.hpp"

#include <svt/illustrate/selection.hpp>

#include <fmt/format.h>

namespace svt::cli {
namespace {

struct Arguments {
    std::filesystem::path input;
    std::string query;
    BuildArguments build;
    bool json = false;
};

int runQuery(const Arguments& arguments) {
    if (auto parsed = model::Query::parse(arguments.query); !parsed) return fail(parsed.error());
    Diagnostics diagnostics;
    Result<volume::SemanticVolume> volume = [&] {
        const TerminalProgress progress;
        return loadVolume(arguments.input, arguments.build, progress.get(), diagnostics);
    }();
    printDiagnostics(diagnostics, false);
    if (!volume) return fail(volume.error());
    const auto selected = illustrate::selectLabels(volume->labels, arguments.query);
    if (!selected) return fail(selected.error());
    if (arguments.json) {
        Json rows = Json::array();
        for (const std::uint32_t l : *selected) rows.push_back(labelJson(volume->labels, l, volume->grid));
        print(rows);
        return kDone;
    }
    fmt::print("{:<28} {:<28} {:<24} {:>10} {:>12}\n", "id", "class", "name", "m3", "voxels");
    for (const std::uint32_t l : *selected) {
        const volume::Label& label = volume->labels.labels[l];
        fmt::print("{:<28} {:<28} {:<24} {:>10.3f} {:>12}\n", label.id, label.className, label.name, label.volume,
                   label.voxels);
    }
    return kDone;
}

}  // namespace

Run addQueryCommand(CLI::App& app) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("query", "List the features that a query selects");
    command->add_option("input", arguments->input, "a .svt or a model file")->required();
    command->add_option("query", arguments->query, "such as 'class=BuildingRoom and volume>20'")->required();
    command->add_flag("--json", arguments->json, "print rows as JSON on stdout")->group("Output");
    arguments->build.addTo(*command);
    return [arguments] { return runQuery(*arguments); };
}

}  // namespace svt::cli
