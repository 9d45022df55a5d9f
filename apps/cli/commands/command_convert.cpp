#include <apps/cli/city/city_input.hpp>
#include <apps/cli/city/city_tiles.hpp>
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

// A row a feature, of all or of those that are selected.
int convertToTable(const ConvertArguments& arguments) {
    FeatureQuery query;
    query.input = arguments.input;
    query.output = arguments.output;
    query.query = !arguments.write.select.empty() ? arguments.write.select
                  : isCity(arguments.input)       ? "class=Building"
                                                  : "all";
    query.box = arguments.write.box;
    query.build = arguments.build;
    return runFeatureQuery(query);
}

int convertCity(const ConvertArguments& arguments) {
    const writers::VolumeFormat* format = writers::volumeFormatOf(arguments.output);
    const std::string_view name = format == nullptr ? "" : format->name;
    if (name == "objects" || name == "objectparquet") return convertToTable(arguments);
    if (name != "tileset")
        return fail(Error(Code::BadArgument,
                          "a city becomes 3D Tiles (.3dtiles) or a table of its buildings (.csv, .geojson, .gpkg, "
                          ".parquet) here; svt city extract takes a part, which becomes any format"));
    const bool isPart = !arguments.write.select.empty() || !arguments.write.box.empty() || arguments.write.level > 1;
    if (isPart || arguments.write.hasVoxels)
        return fail(Error(Code::BadArgument,
                          "--select, --box, --voxels and a --level over 1 are for the volume of a part; take it by svt "
                          "city extract, and convert that"));
    const auto city = city::City::open(arguments.input);
    if (!city) return fail(city.error());
    auto options = arguments.write.options({});
    if (!options) return fail(options.error());
    const TerminalProgress progress;
    const auto bytes = writeCityTiles(*city, arguments.output, *options, arguments.write.level, arguments.build.threads,
                                      progress.get());
    return bytes ? static_cast<int>(kDone) : fail(bytes.error());
}

int runConvert(const ConvertArguments& arguments) {
    const std::string ending = endingOf(arguments.output);
    if (ending == ".geojson" || ending == ".gpkg") return convertToTable(arguments);
    if (isCity(arguments.input)) return convertCity(arguments);
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
