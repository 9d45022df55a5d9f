#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/mesh/mesh_set.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/volume/volume_part.hpp>
#include <svt/volume_readers/read_label_volume.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <string_view>

namespace svt::cli {
namespace {

struct BuildArguments {
    std::vector<std::filesystem::path> inputs;
    std::filesystem::path output;
    std::filesystem::path gridOf, labels;
    pipeline::BuildOptions build;
    std::string only;
    std::vector<double> box;
    bool json = false, verbose = false, strict = false;

    // By default, meshes are stored if possible.
    BuildArguments() { build.vectors = {.meshes = true, .isRequired = false}; }
};

void printSummary(const pipeline::BuildOutput& built, std::uint64_t fileBytes, const BuildArguments& arguments) {
    const auto dimension = built.volume.grid.dimension();
    const auto spacing = built.volume.grid.spacing();
    summarize(fmt::format("{}: {} objects, {} x {} x {} samples of {:.4g} x {:.4g} x {:.4g} m, {:.1f} kB in {:.2f} s",
                          arguments.output.string(), built.report.objects, dimension.x, dimension.y, dimension.z,
                          spacing.x, spacing.y, spacing.z, double(fileBytes) / 1000, built.report.seconds.total));
    if (const auto& choice = built.report.spacing)
        summarize(fmt::format("spacing: {}; --spacing or --dimension gives another", choice->reason));
}

// Names objects without voxels: smaller than a voxel, or in the space of others.
void noteLost(const volume::LabelTable& table) {
    constexpr std::size_t kShown = 3;
    std::vector<std::string> lost;
    std::size_t count = 0, all = 0;
    for (const volume::Label& label : table.labels) {
        if (label.count == 0) continue;
        ++all;
        if (label.voxels > 0) continue;
        if (++count <= kShown) lost.push_back(fmt::format("'{}'", label.name.empty() ? label.id : label.name));
    }
    if (count == 0) return;
    note(fmt::format("{} of {} objects have no voxels: they are smaller than a voxel, or others have their space: {}{}",
                     count, all, fmt::join(lost, ", "), count > kShown ? ", ..." : ""));
}

// Null if options define the grid.
Json chosenSpacingJson(const std::optional<pipeline::SpacingChoice>& choice) {
    if (!choice) return nullptr;
    return {{"spacing", choice->spacing},
            {"reason", choice->reason},
            {"surfaceVoxels", choice->forecast.surfaceVoxels},
            {"bytes", choice->forecast.bytes}};
}

Result<volume::Grid> gridOfVolume(const std::filesystem::path& path, const pipeline::BuildOptions& build) {
    if (build.dimension || build.spacing || build.axes != pipeline::AxesKind::World)
        return Error(Code::BadArgument,
                     "--grid-of excludes --dimension, --spacing and --axes; the other volume has them already");
    SVT_TRY(volume, volume::readSvt(path));
    return volume->grid;
}

std::string ifcTypeOf(const volume::Label& label) {
    for (const Attribute& attribute : label.attributes)
        if (attribute.name == "ifcType") return toText(attribute.value);
    return {};
}

// The products of IFC files that were read, read in part or skipped; null for models of other formats.
Json productsJson(const volume::LabelTable& table, const Diagnostics& diagnostics) {
    std::map<std::string, std::string> typeOf;
    std::size_t withShape = 0;
    for (const volume::Label& label : table.labels)
        if (std::string type = ifcTypeOf(label); !type.empty()) {
            withShape += label.filling == volume::Filling::None ? 0 : 1;
            typeOf.emplace(label.id, std::move(type));
        }
    if (typeOf.empty()) return nullptr;
    Json partial = Json::array(), skipped = Json::array();
    for (const Diagnostic& finding : diagnostics.items()) {
        if (finding.code != Code::ReadInPart && finding.code != Code::ShapeNotRead) continue;
        (finding.code == Code::ReadInPart ? partial : skipped)
            .push_back({{"id", finding.where.id}, {"class", typeOf[finding.where.id]}, {"reason", finding.message}});
    }
    return {{"read", withShape}, {"partial", std::move(partial)}, {"skipped", std::move(skipped)}};
}

// Takes a label volume of another program unchanged; voxelizes models.
Result<pipeline::BuildOutput> builtOf(const BuildArguments& arguments, const pipeline::BuildOptions& options,
                                      Diagnostics& diagnostics) {
    const bool isVolume =
        arguments.inputs.size() == 1 && volume_readers::looksLikeLabelVolume(arguments.inputs.front());
    if (!isVolume && !arguments.labels.empty())
        return Error(Code::BadArgument,
                     "--labels describes the values of a label volume (NRRD, VTI, NIfTI, TIFF), but the input is not a "
                     "single label volume; omit --labels");
    if (!isVolume) return pipeline::buildVolume(arguments.inputs, options, &diagnostics);
    if (options.dimension || options.spacing || options.grid || options.axes != pipeline::AxesKind::World)
        return Error(Code::BadArgument,
                     "the input is a label volume, which has its own grid; leave out --dimension, --spacing, --axes "
                     "and --grid-of, or make it coarser with svt convert --level");
    const auto start = std::chrono::steady_clock::now();
    SVT_TRY(read, volume_readers::readLabelVolume(arguments.inputs.front(),
                                                  {arguments.labels, 0, options.progress, &diagnostics}));
    pipeline::BuildOutput output{std::move(*read), {}};
    for (const volume::Label& label : output.volume.labels.labels) output.report.objects += label.count > 0 ? 1 : 0;
    output.report.seconds.read = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return output;
}

// Reduces a volume to the samples in --box, and to the components that --only selects, in the box around them.
Result<void> takePart(const BuildArguments& arguments, volume::SemanticVolume& volume) {
    if (arguments.box.size() == 6) {
        const auto& b = arguments.box;
        SVT_TRY(cropped, volume::volumeIn(volume, {{b[0], b[1], b[2]}, {b[3], b[4], b[5]}}));
        volume = std::move(*cropped);
    }
    if (arguments.only.empty()) return {};
    SVT_TRY(labels, analyze::selectWithParts(volume, arguments.only));
    SVT_DO(analyze::boxAround(*labels, volume, fmt::format("the selection of --only '{}'", arguments.only)));
    SVT_TRY(selected, volume::selectedVolume(volume, *labels));
    // One more sample on each side, as in a build.
    SVT_TRY(cropped, volume::croppedVolume(*selected, volume::samplesAround(selected->columns)));
    volume = std::move(*cropped);
    return {};
}

int runBuild(const BuildArguments& arguments) {
    pipeline::BuildOptions options = arguments.build;
    if (!arguments.gridOf.empty()) {
        auto grid = gridOfVolume(arguments.gridOf, arguments.build);
        if (!grid) return fail(grid.error());
        options.grid = *grid;
    }
    Diagnostics diagnostics;
    const auto start = std::chrono::steady_clock::now();
    std::optional<TerminalProgress> progress(std::in_place);
    options.progress = progress->get();
    Result<pipeline::BuildOutput> built = builtOf(arguments, options, diagnostics);
    printDiagnostics(diagnostics, arguments.verbose);
    if (!built) return fail(built.error());
    if (auto taken = takePart(arguments, built->volume); !taken) return fail(taken.error());
    const auto writeStart = std::chrono::steady_clock::now();
    if (Progress::isCancelled(progress->get())) return fail(Error(Code::Cancelled, "stopped before writing"));
    Progress::tell(progress->get(), "write", 0);
    const auto bytes = volume::writeSvt(built->volume, arguments.output);
    progress.reset();
    if (!bytes) return fail(bytes.error());
    const auto end = std::chrono::steady_clock::now();
    pipeline::BuildReport& report = built->report;
    report.seconds.write = std::chrono::duration<double>(end - writeStart).count();
    report.seconds.total = std::chrono::duration<double>(end - start).count();
    if (arguments.json) {
        Json json;
        json["objects"] = report.objects;
        json["triangles"] = report.triangles;
        json["open"] = report.open;
        json["tJunctions"] = report.tJunctions;
        for (std::size_t c = 0; c < report.closingMethods.size(); ++c)
            json["closingMethods"][std::string(mesh::closingMethodName(mesh::ClosingMethod(c)))] =
                report.closingMethods[c];
        json["closures"] = json["closingMethods"];  // deprecated
        json["uncertainVoxels"] = report.uncertainVoxels;
        json["seconds"] = {{"read", report.seconds.read},         {"mesh", report.seconds.mesh},
                           {"voxelize", report.seconds.voxelize}, {"pack", report.seconds.pack},
                           {"write", report.seconds.write},       {"total", report.seconds.total}};
        json["bytes"] = {{"memory", built->volume.columns.sizeBytes()}, {"file", *bytes}};
        json["dimension"] = toJson(built->volume.grid.dimension());
        json["spacing"] = toJson(built->volume.grid.spacing());
        json["chosenSpacing"] = chosenSpacingJson(report.spacing);
        json["overlaps"] = overlapsJson(built->volume.labels);
        if (Json products = productsJson(built->volume.labels, diagnostics); !products.is_null())
            json["products"] = std::move(products);
        json["warnings"] = diagnostics.count(Severity::Warning) + diagnostics.count(Severity::Error);
        print(json);
    } else {
        printSummary(*built, *bytes, arguments);
        noteLost(built->volume.labels);
    }
    const bool isFlawed = diagnostics.count(Severity::Warning) + diagnostics.count(Severity::Error) != 0;
    if (arguments.strict && isFlawed) {
        note("the model has defects (--strict)");
        return kInvalid;
    }
    return kDone;
}

// The stored vector parts, as a list of names.
struct VectorNames : record::PlainCodec<VectorNames, pipeline::VectorChoice> {
    static void read(record::Faults&, const Json& json, const std::string&, const Option&, pipeline::VectorChoice& to) {
        const auto has = [&](const char* kind) { return std::ranges::find(json, kind) != json.end(); };
        to = {.edges = has("edges"), .meshes = has("meshes") || !has("none")};
    }
    static Json write(const Option&, const pipeline::VectorChoice&) { return {}; }
};

Members<BuildArguments> membersOf(const BuildArguments*) noexcept {
    using All = BuildArguments;
    static constexpr Member<All> kMembers[] = {
        member<&All::inputs>("input",
                             "model files: CityGML 1.0 to 3.0, CityJSON 1.0 to 2.0, CityJSONSeq, IFC 2x3 to 4.3, "
                             "IndoorGML; or one label volume: NRRD, VTI, NIfTI, TIFF, a folder of Zarr, CityGML with a "
                             "volume in it",
                             {.value = "FILE", .isRequired = true, .file = FileUse::Model}),
        member<&All::output>("-o,--output", "the volume to write",
                             {.value = "F.svt", .isRequired = true, .file = FileUse::Output, .formats = "svt"}),
        part<&All::build>("build", "Grid"),
        member<&All::only>("--only", "keep only the voxels that the query selects, in the box around them",
                           {.value = "QUERY", .group = "Part"}),
        worldBox<&All::box>("keep only the samples in this box of world coordinates", "Part"),
        member<&All::labels>("--labels", "for a label volume: a table (JSON) with the label of each value",
                             {.value = "FILE",
                              .otherwise = "the labels in the file, else one label per value",
                              .file = FileUse::OtherInput}),
        member<&All::gridOf>("--grid-of", "use the grid of this volume, so that both can be compared voxel by voxel",
                             {.value = "F.svt", .group = "Grid", .file = FileUse::OtherInput}),
        part<&All::build>("build", "Model|Style|Voxels"),
        memberAs<VectorNames, &All::build, &pipeline::BuildOptions::vectors>(
            "--vectors",
            "edges: store feature edges in addition to the meshes, to draw them inside the volume; none: store no "
            "meshes, so that sections are cut from voxels",
            {.choices = "edges|meshes|none",
             .byDefault = "meshes",
             .group = "Output",
             .count = 2,
             .isForProjects = true}),
        jsonOption<&All::json>("print figures as JSON on stdout"),
        member<&All::strict>("--strict", "exit 4 if the model has defects; the volume is written nevertheless",
                             {.group = "Output"}),
        quietOption<All>(),
        verboseOption<&All::verbose>(),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kBuildCommand =
    commandOf<BuildArguments, runBuild>("build", "Make a volume (.svt) of one or more model files");

}  // namespace svt::cli
