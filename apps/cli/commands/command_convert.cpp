#include <apps/cli/city/city_input.hpp>
#include <apps/cli/city/city_tiles.hpp>
#include <apps/cli/city/feature_query.hpp>
#include <apps/cli/options/build_options.hpp>
#include <apps/cli/options/command_line.hpp>
#include <apps/cli/options/shared_options.hpp>
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

constexpr Option kConvert[] = {
    kModelInput[0],
    {.name = "output",
     .value = "FILE",
     .help = kVolumeFormats,
     .isRequired = true,
     .file = FileUse::Output,
     .formats = kVolumeFormats},
    {.name = "--select",
     .value = "QUERY",
     .help = "only the voxels of what the query selects; the rest becomes background",
     .group = "Part"},
    {.name = "--box",
     .kind = Number,
     .value = "X0,Y0,Z0,X1,Y1,Z1",
     .unit = "metres",
     .help = "only the samples in this box of world coordinates",
     .group = "Part",
     .count = 6,
     .leastCount = 6},
    {.name = "--level",
     .kind = Whole,
     .least = 0,
     .most = 6,
     .byDefault = "0",
     .help = "coarser by 2^level along each axis: a cell has the label that fills most of it",
     .group = "Part"},
    {.name = "--encoding",
     .choices = "gzip|raw",
     .byDefault = "gzip",
     .help = "samples of NRRD, VTI and TIFF: compressed or raw",
     .group = "Output"},
    {.name = "--texture",
     .choices = "pixel|image|composed|atlas",
     .byDefault = "pixel",
     .help = "samples of X3D and of CityGML: pixel (numbers in the document), image (an NRRD beside it) or composed "
             "(PNG slices beside it); of X3D also atlas (one PNG of colours beside it, as X3DOM shows volumes)",
     .group = "Output"},
    {.name = "--model",
     .value = "FILE",
     .otherwise = "the input, where that is CityGML",
     .help = "of an .ade.gml: the CityGML that the volume was built from, which is kept as it is",
     .group = "Output",
     .file = FileUse::OtherInput},
    {.name = "--citygml",
     .choices = "2.0|3.0",
     .otherwise = "that of the model; 3.0 without one",
     .help = "of an .ade.gml: the version of CityGML",
     .group = "Output"},
    {.name = "--zarr",
     .choices = "2|3",
     .byDefault = "2",
     .help = "of a .zarr: 2 (OME-NGFF 0.4) or 3 (OME-NGFF 0.5, sharded)",
     .group = "Output"},
    {.name = "--meshes",
     .kind = Flag,
     .help = "of a .precomputed: also the surface of each label, for the 3D view",
     .group = "Output"},
    {.name = "--sharded",
     .kind = Flag,
     .help = "of a .precomputed: up to 64 chunks in a file, packed; the web server has to answer requests for ranges",
     .group = "Output"},
    {.name = "--place",
     .kind = Number,
     .value = "LAT,LON,HEIGHT",
     .unit = "degrees and metres",
     .otherwise = "that of the CRS",
     .help = "of a .3dtiles: where on the globe the lower corner is",
     .group = "Output",
     .count = 3,
     .leastCount = 3},
    {.name = "--lift",
     .kind = Number,
     .value = "M",
     .byDefault = "0",
     .help = "of a .3dtiles: metres added to heights, such as the height of the geoid where they are over the sea",
     .group = "Output"},
    {.name = "--voxels",
     .kind = Flag,
     .help = "of a .3dtiles: voxels by draft extensions, as Cesium has them for trial, not surfaces",
     .group = "Output"},
    {.name = "--level-sets",
     .kind = Flag,
     .help = "of a .vdb: each class as signed distances to its surface, three voxels to both sides, not as a mask",
     .group = "Output"},
    {.name = "--max-voxels",
     .kind = Whole,
     .least = 1,
     .most = 1e12,
     .byDefault = "16777216",
     .help = "most samples that a document is to hold as numbers, most voxels of a .vox",
     .group = "Output"},
    {.name = "--merge",
     .choices = "label|class|material",
     .byDefault = "label",
     .help = "of an .fds and of lists of boxes: what becomes boxes together",
     .group = "Output"},
    {.name = "--max-boxes",
     .kind = Whole,
     .least = 1,
     .most = 1e8,
     .byDefault = "1000000",
     .help = "of an .fds and of lists of boxes: more are refused",
     .group = "Output"},
    {.name = "--holes",
     .value = "QUERY",
     .help = "of an .fds: components that are open, such as doors",
     .group = "Output"},
    {.name = "--vents",
     .value = "QUERY",
     .help = "of an .fds: components with a vent on both sides, such as windows",
     .group = "Output"},
    kFaces,
};

Action connectConvert(Command& command) {
    auto arguments = std::make_shared<ConvertArguments>();
    command.set("input", arguments->input);
    command.set("output", arguments->output);
    arguments->write.connect(command);
    arguments->build.connect(command);
    return [arguments] { return runConvert(*arguments); };
}

}  // namespace

extern const CommandText kConvertCommand{.name = "convert",
                                         .help = "Write a volume in another format",
                                         .sets = {kConvert, kQuiet, kGrid, kModel, kMemory, kStyle, kVoxels},
                                         .connect = connectConvert};

}  // namespace svt::cli
