#include <apps/cli/city/city_input.hpp>
#include <apps/cli/city/feature_query.hpp>
#include <apps/cli/commands/commands.hpp>
#include <apps/cli/options/build_options.hpp>
#include <apps/cli/options/write_options.hpp>
#include <apps/cli/output/file_content.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/volume/svt_file.hpp>
#include <svt/writers/volume_formats.hpp>

#include <utility>

namespace svt::cli {
namespace {

struct ConvertArguments {
    std::filesystem::path input, output;
    WriteArguments write;
    BuildArguments build;
};

int runConvert(const ConvertArguments& arguments) {
    if (isCity(arguments.input)) {
        if (endingOf(arguments.output) != ".csv")
            return fail(Error(Code::BadArgument,
                              "a city becomes a table of its buildings here (.csv); svt query -o writes .geojson and "
                              ".gpkg, and svt city extract takes a part, which becomes any format"));
        FeatureQuery query;
        query.input = arguments.input;
        query.output = arguments.output;
        query.query = arguments.write.select.empty() ? "class=Building" : arguments.write.select;
        query.box = arguments.write.box;
        query.build = arguments.build;
        return runFeatureQuery(query);
    }
    Diagnostics diagnostics;
    const TerminalProgress progress;
    BuildArguments build = arguments.build;
    // Of rooms, the bodies as the model has them.
    const writers::VolumeFormat* format = writers::volumeFormatOf(arguments.output);
    if (format != nullptr && format->name == "indoorgml") build.vectors = {.meshes = true, .isRequired = false};
    auto volume = loadVolume(arguments.input, build, progress.get(), diagnostics);
    printDiagnostics(diagnostics, false);
    if (!volume) return fail(volume.error());
    volume = arguments.write.partOf(std::move(*volume), build.threads);
    if (!volume) return fail(volume.error());
    Progress::tell(progress.get(), "write", 0);
    auto options = arguments.write.options(*volume);
    if (!options) return fail(options.error());
    if (options->model.empty() && contentOf(arguments.input) == FileContent::CityGml) options->model = arguments.input;
    options->threads = build.threads;
    options->progress = progress.get();
    const auto bytes = writers::writeVolume(*volume, arguments.output, *options);
    return bytes ? static_cast<int>(kDone) : fail(bytes.error());
}

}  // namespace

Action connectConvert(Command& command) {
    auto arguments = std::make_shared<ConvertArguments>();
    command.set("input", arguments->input);
    command.set("output", arguments->output);
    arguments->write.connect(command);
    arguments->build.connect(command);
    return [arguments] { return runConvert(*arguments); };
}

}  // namespace svt::cli
