#include <apps/cli/city/city_input.hpp>
#include <apps/cli/city/feature_query.hpp>
#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/load_volume.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/file_content.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/city/city_tiles3d.hpp>
#include <svt/core/text.hpp>
#include <svt/frontend/volume_part.hpp>
#include <svt/record/record.hpp>
#include <svt/writers/globe_heights.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace svt::cli {
namespace {

struct ConvertArguments {
    std::filesystem::path input, output;
    frontend::VolumePart part;
    writers::VolumeWriteOptions write;
    bool roofs = false;
    pipeline::BuildOptions build;
};

// Writes one row per feature: all features, or the selected ones.
Result<int> convertToTable(const ConvertArguments& arguments) {
    FeatureQuery query;
    query.input = arguments.input;
    query.output = arguments.output;
    query.query = !arguments.part.select.empty() ? arguments.part.select
                  : isCity(arguments.input)      ? "class=Building"
                                                 : "all";
    query.box = arguments.part.box;
    query.roofs = arguments.roofs;
    query.build = arguments.build;
    return runFeatureQuery(query);
}

// The options of a struct that differ from their defaults: "--place, --lift".
template <record::Recorded T>
std::string changedOptions(const T& given) {
    std::vector<std::string_view> names;
    for (const record::Member<T>& member : record::membersOf<T>())
        if (member.write(member.option, given) != member.write(member.option, T()))
            names.push_back(member.option.option);
    return fmt::format("{}", fmt::join(names, ", "));
}

// Refuses options of other formats than that of the output, because they would have no effect.
// \param format  of writers::volumeFormats(); empty: a table of features
Result<void> checkFormatOptions(const writers::VolumeWriteOptions& given, std::string_view format) {
    const struct Owned {
        std::string options;
        std::string_view formats;
    } all[] = {{given.texture != writers::VolumeWriteOptions().texture ? "--texture" : "", "x3d|ade"},
               {changedOptions(given.cityGml), "ade"},
               {changedOptions(given.zarr), "zarr"},
               {changedOptions(given.precomputed), "precomputed"},
               {changedOptions(given.tileset), "tileset"},
               {changedOptions(given.vdb), "vdb"},
               {changedOptions(given.boxes), "fds|boxes|boxesjson"},
               {changedOptions(given.foam), "foam"}};
    for (const Owned& owned : all) {
        const std::vector<std::string_view> formats = splitChoices(owned.formats);
        if (owned.options.empty() || std::ranges::find(formats, format) != formats.end()) continue;
        return Error(Code::BadArgument, fmt::format("{}: only for {}, and the output has another format", owned.options,
                                                    fmt::join(formats, ", ")));
    }
    return {};
}

// Without --lift and --place: raises a tileset by the geoid, and says so or that the grid is missing.
void setLift(const std::string& crsName, Vec3d corner, writers::TilesetWriteOptions& options) {
    if (options.lift || options.place) return;
    const writers::GlobeHeights heights = writers::globeHeights(crsName, corner);
    options.lift = heights.lift;
    note(heights.remark);
}

// States the sources of surfaces if there are several, or another one than --from requires.
void noteSurfaces(const volume::SemanticVolume& volume, const writers::VolumeWriteOptions& options, bool isTileset) {
    using writers::MeshChoice;
    const MeshChoice choice = writers::meshChoice(options, isTileset ? MeshChoice::Open : MeshChoice::Closed);
    if (choice == MeshChoice::None) return;
    const writers::SurfaceCounts counts = writers::countSurfaces(volume, choice);
    const bool isRefused = options.from == writers::SurfaceSource::Meshes && counts.voxels > 0;
    if (counts.voxels > 0 && (counts.meshes > 0 || isRefused))
        note(fmt::format("surfaces: {} features have the faces of the model, {} the surface of their voxels",
                         counts.meshes, counts.voxels));
}

Result<int> convertCity(const ConvertArguments& arguments) {
    const writers::VolumeFormat* format = writers::volumeFormatOf(arguments.output);
    const std::string_view name = format == nullptr ? "" : format->name;
    if (name == "objects" || name == "objectparquet") return convertToTable(arguments);
    if (name != "tileset")
        return Error(Code::BadArgument,
                     "a city can only be converted to 3D Tiles (.3dtiles) or a table of its buildings (.csv, .geojson, "
                     ".gpkg, .parquet); for other formats, take a part with svt city extract, and convert that");
    const bool isPart = !arguments.part.select.empty() || !arguments.part.box.empty() || arguments.part.level > 1;
    if (isPart || arguments.write.tileset.hasVoxels)
        return Error(Code::BadArgument,
                     "--select, --box, --voxels and a --level over 1 need one volume; take a part of the city with svt "
                     "city extract, and convert that");
    SVT_TRY(city, city::City::open(arguments.input));
    const TerminalProgress progress;
    writers::VolumeWriteOptions options = arguments.write;
    setLift(city->crsName(), city->box().min, options.tileset);
    SVT_TRY(report, city::writeCityTiles(*city, arguments.output, options, arguments.part.level,
                                         arguments.build.threads, progress.get()));
    const bool wantsMeshes = writers::meshChoice(options, writers::MeshChoice::Open) != writers::MeshChoice::None;
    if (wantsMeshes && report->voxelTiles > 0)
        note(
            fmt::format("{} of {} tiles have no meshes, and the surfaces of their voxels; cities that are built now "
                        "keep meshes",
                        report->voxelTiles, report->tiles));
    return kDone;
}

Result<int> runConvert(const ConvertArguments& arguments) {
    const writers::VolumeFormat* written = writers::volumeFormatOf(arguments.output);
    SVT_DO(checkFormatOptions(arguments.write, written == nullptr ? std::string_view() : written->name));
    const std::string ending = endingOf(arguments.output);
    if (ending == ".geojson" || ending == ".gpkg") return convertToTable(arguments);
    if (isCity(arguments.input)) return convertCity(arguments);
    const TerminalProgress progress;
    pipeline::BuildOptions build = arguments.build;
    // IndoorGML gets the bodies of rooms from the model, glTF and 3D Tiles its surfaces.
    const writers::VolumeFormat* format = writers::volumeFormatOf(arguments.output);
    const bool hasSurfaces = format != nullptr && (format->name == "glb" || format->name == "tileset");
    const bool needsMeshes = hasSurfaces || (format != nullptr && format->name == "indoorgml");
    if (needsMeshes) build.vectors = {.meshes = true, .isRequired = false};
    SVT_TRY(volume, loadVolume(arguments.input, build, progress.get(), false));
    volume = arguments.part.of(std::move(*volume), build.threads);
    if (!volume) return volume.error();
    Progress::tell(progress.get(), "write", 0);
    writers::VolumeWriteOptions options = arguments.write;
    std::filesystem::path& model = options.cityGml.model;
    if (model.empty() && contentOf(arguments.input) == FileContent::CityGml) model = arguments.input;
    options.threads = build.threads;
    options.progress = progress.get();
    if (format != nullptr && format->name == "tileset" && !volume->crsName.empty())
        setLift(volume->crsName, volume->grid.origin(), options.tileset);
    Diagnostics notes;
    options.diagnostics = &notes;
    SVT_DO(writers::writeVolume(*volume, arguments.output, options));
    for (const Diagnostic& item : notes.items()) note(item.message);
    if (hasSurfaces && !options.tileset.hasVoxels) noteSurfaces(*volume, options, format->name == "tileset");
    return kDone;
}

// The formats of the output: writers::volumeFormats(), and tables with one row per feature (writers::FeatureLayer).
struct Outputs {
    std::string names, help;

    Outputs() {
        std::vector<std::string_view> endings;
        for (const writers::VolumeFormat& format : writers::volumeFormats()) {
            names += fmt::format("{}|", format.name);
            for (const std::string_view ending : splitChoices(format.endings)) endings.push_back(ending);
        }
        names += "geojson|gpkg";
        endings.insert(endings.end(), {".geojson", ".gpkg"});
        help = fmt::format("file to write; the extension selects the format: {}", fmt::join(endings, ", "));
    }
};

Members<ConvertArguments> membersOf(const ConvertArguments*) noexcept {
    using All = ConvertArguments;
    static const Outputs kOutputs;
    static const Member<All> kMembers[] = {
        modelInput<&All::input>(),
        member<&All::output>("output", kOutputs.help,
                             {.value = "FILE", .isRequired = true, .file = FileUse::Output, .formats = kOutputs.names}),
        part<&All::part>("part"),
        part<&All::write>("write"),
        member<&All::roofs>("--roofs",
                            "tables of features: outlines of roofs as well, in a column and as a second layer",
                            {.group = "Tables"}),
        quietOption<All>(),
        part<&All::build>("build"),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kConvertCommand =
    commandOf<ConvertArguments, runConvert>("convert", "Write a volume in another format");

}  // namespace svt::cli
