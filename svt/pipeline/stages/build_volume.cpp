#include <svt/pipeline/build_volume.hpp>

#include <svt/analyze/solid_overlaps.hpp>
#include <svt/core/machine.hpp>
#include <svt/mesh/thickness.hpp>
#include <svt/model/classes.hpp>
#include <svt/model/phases.hpp>
#include <svt/pipeline/stages/build_checks.hpp>
#include <svt/readers/model_joiner.hpp>
#include <svt/voxelize/bodies.hpp>
#include <svt/voxelize/face_planes.hpp>

#include <algorithm>
#include <chrono>
#include <tuple>

namespace svt::pipeline {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Buildings in which only boundary surfaces can get the material between hull and rooms.
std::vector<voxelize::BodyGroup> findBodyGroups(const mesh::MeshSet& meshes, const LabelledObjects& labelled) {
    std::vector<std::uint32_t> objectOf(labelled.table.labels.size(), volume::kNoLabel);
    for (std::uint32_t o = 0; o < meshes.objects.size(); ++o) objectOf[labelled.labelOfObject[o]] = o;
    std::vector<voxelize::BodyGroup> groups;
    for (std::uint32_t o = 0; o < meshes.objects.size(); ++o) {
        const std::uint32_t l = labelled.labelOfObject[o];
        const volume::Label& building = labelled.table.labels[l];
        if (model::classRank(building.className) != model::ClassRank::Building ||
            meshes.objects[o].closingMethod == mesh::ClosingMethod::Surface)
            continue;
        voxelize::BodyGroup group;
        group.from = building.first;
        bool hasRooms = false;
        for (std::uint32_t below = l + 1; below < building.subtreeEnd; ++below) {
            if (objectOf[below] == volume::kNoLabel) continue;
            const volume::Label& label = labelled.table.labels[below];
            hasRooms = hasRooms || model::classRank(label.className) == model::ClassRank::Room;
            if (!model::isBoundarySurface(label.className)) continue;
            group.surfaces.push_back(objectOf[below]);
            group.scalars.push_back(label.first);
        }
        if (hasRooms && !group.surfaces.empty()) groups.push_back(std::move(group));
    }
    return groups;
}

void fillOverlaps(const LabelledObjects& labelled, const std::vector<voxelize::ClaimPair>& pairs,
                  volume::LabelTable& table) {
    for (const voxelize::ClaimPair& pair : pairs) {
        const std::uint32_t a = labelled.labelOfObject[pair.a], b = labelled.labelOfObject[pair.b];
        table.overlaps.push_back({a, b, pair.voxels, analyze::areNested(table, a, b)});
    }
    std::sort(table.overlaps.begin(), table.overlaps.end(), [](const volume::Overlap& p, const volume::Overlap& q) {
        return std::tie(p.a, p.b) < std::tie(q.a, q.b);
    });
}

Result<Prepared> prepare(model::BuildingModel& model, const BuildOptions& options, Diagnostics* log) {
    mesh::MeshOptions meshOptions;
    meshOptions.lod = options.lod;
    meshOptions.measuresThickness = false;  // measured below: only parts thinner than a voxel matter
    meshOptions.threads = options.threads;
    meshOptions.progress = options.progress;
    model::splitPhases(model);
    SVT_TRY(meshes, mesh::buildMeshes(model, meshOptions, log));
    std::optional<SpacingChoice> choice;
    SVT_TRY(grid, chooseGrid(*meshes, options, &choice));
    if (options.grid) SVT_DO(checkGivenGrid(model, *meshes, *grid, log));
    if (choice && log != nullptr) reportCutObjects(model, *meshes, *grid, *choice, *log);
    const Vec3d spacing = grid->spacing();
    constexpr double kRounding = 1 + 1e-6;  // thickness has single precision
    mesh::measureThickness(*meshes, std::max({spacing.x, spacing.y, spacing.z}) * kRounding, options.threads);
    addCapFeatures(model, *meshes);
    std::vector<const StyleSheet*> sheets{&defaultStyle(options.usePatterns)};
    if (options.style != nullptr) sheets.push_back(options.style);
    SVT_TRY(labelled, makeLabels(model, *meshes, sheets, std::max({spacing.x, spacing.y, spacing.z})));
    for (voxelize::PatternedObject& object : labelled->patterns) voxelize::fitPattern(object, grid->spacing());
    return Prepared{std::move(*meshes), *grid, std::move(choice), std::move(*labelled)};
}

// Voxelizes all objects, then thematic bodies, then patterns.
Result<voxelize::VoxelizeResult> makeVoxels(const Prepared& prepared, const std::vector<voxelize::BodyGroup>& groups,
                                            const BuildOptions& options) {
    voxelize::VoxelizeOptions voxelizeOptions;
    voxelizeOptions.sheets = options.sheets;
    voxelizeOptions.keepThinParts = options.keepThinParts;
    voxelizeOptions.threads = options.threads;
    voxelizeOptions.progress = options.progress;
    const auto& [meshes, grid, choice, labelled] = prepared;
    SVT_TRY(voxels, voxelize::voxelize(meshes, grid, labelled.claims, voxelizeOptions));
    if (!groups.empty())
        voxels->columns =
            voxelize::assignThematicBodies(voxels->columns, grid, meshes, groups, options.threads, options.progress);
    Progress::tell(options.progress, "patterns", 0);
    if (!labelled.patterns.empty())
        voxels->columns =
            voxelize::layPatterns(voxels->columns, grid, meshes.origin, labelled.patterns, options.threads);
    return voxels;
}

// Enters the areas of meshes whose voxels decide a volume: they bound its error.
void fillAreas(Prepared& prepared) {
    std::vector<volume::Label>& labels = prepared.labelled.table.labels;
    std::vector<char> isCounted(labels.size(), 0);
    for (const volume::Overlap& overlap : prepared.labelled.table.overlaps)
        isCounted[overlap.a] = isCounted[overlap.b] = 1;
    for (std::size_t o = 0; o < prepared.meshes.objects.size(); ++o) {
        const std::uint32_t l = prepared.labelled.labelOfObject[o];
        const volume::Filling filling = labels[l].filling;
        if (isCounted[l] != 0 || filling == volume::Filling::Winding || filling == volume::Filling::Body ||
            !prepared.meshes.objects[o].isVolumeKnown)
            labels[l].area = prepared.meshes.objects[o].area;
    }
}

// Enters the figures of the voxels into the label table.
void fillLabels(const voxelize::VoxelizeResult& voxels, const std::vector<voxelize::BodyGroup>& groups,
                Prepared& prepared) {
    LabelledObjects& labelled = prepared.labelled;
    volume::LabelTable& table = labelled.table;
    fillOverlaps(labelled, voxels.overlaps, table);
    const std::vector<std::uint64_t> counts = voxels.columns.countVoxels(table.scalarCount());
    for (volume::Label& label : table.labels)
        for (volume::Scalar s = 0; s < label.count; ++s) label.voxels += counts[label.first + s];
    for (std::size_t o = 0; o < prepared.meshes.objects.size(); ++o) {
        volume::Label& label = table.labels[labelled.labelOfObject[o]];
        label.thinVoxels = voxels.thinVoxels[o];
        label.uncertainVoxels = voxels.uncertainVoxels[o];
    }
    for (const voxelize::BodyGroup& group : groups)
        for (const std::uint32_t surface : group.surfaces) {
            volume::Label& label = table.labels[labelled.labelOfObject[surface]];
            label.filling = volume::Filling::Body;
            label.volume = double(label.voxels) * prepared.grid.voxelVolume();
        }
    fillAreas(prepared);
}

void countObjects(const mesh::MeshSet& meshes, BuildReport& report) {
    report.objects = meshes.objects.size();
    report.triangles = meshes.triangleCount();
    for (const mesh::ObjectMesh& object : meshes.objects) {
        if (object.closingMethod != mesh::ClosingMethod::Surface && object.leakCount != 0) ++report.open;
        if (object.closingMethod == mesh::ClosingMethod::TJunctions) ++report.tJunctions;
        ++report.closingMethods[std::size_t(object.closingMethod)];
    }
}

// Frees the content that was converted to meshes and labels. Ids, lines in the file and polylines stay.
void dropContent(model::BuildingModel& model) {
    model.polygons = {};
    for (model::Feature& feature : model.features) {
        feature.geometries = {};
        feature.attributes = {};
        feature.children = {};
    }
    returnFreeMemory();
}

// \param keepsContent  false: the model loses the content that was converted to meshes and labels
Result<BuildOutput> buildFrom(model::BuildingModel& model, const BuildOptions& options, bool keepsContent,
                              Diagnostics* log) {
    BuildOutput output;
    BuildReport& report = output.report;
    auto start = Clock::now();
    SVT_TRY(prepared, prepare(model, options, log));
    if (!keepsContent) dropContent(model);
    const auto& [meshes, grid, choice, labelled] = *prepared;
    report.seconds.mesh = secondsSince(start);

    start = Clock::now();
    std::vector<voxelize::BodyGroup> groups;
    if (options.assignThematicBodies) groups = findBodyGroups(meshes, labelled);
    SVT_TRY(voxels, makeVoxels(*prepared, groups, options));
    report.seconds.voxelize = secondsSince(start);

    start = Clock::now();
    Progress::tell(options.progress, "pack", 0);
    fillLabels(*voxels, groups, *prepared);
    Progress::tell(options.progress, "pack", 0.3);
    if (log != nullptr) {
        checkVolumes(model, *prepared, *voxels, *log);
        reportBounds(model, meshes, *voxels, *log);
    }
    countObjects(meshes, report);
    report.spacing = choice;
    for (const std::uint64_t count : voxels->uncertainVoxels) report.uncertainVoxels += count;
    Progress::tell(options.progress, "pack", 0.5);
    SVT_TRY(vectors, makeVectorParts(meshes, labelled.labelOfObject, grid, options.vectors,
                                     {model.lines, labelled.labelOfLine}, options.threads));
    output.volume.vectors = std::move(*vectors);
    Progress::tell(options.progress, "pack", 0.7);
    output.volume.planes = voxelize::findFacePlanes(meshes, grid);
    Progress::tell(options.progress, "pack", 1);
    output.volume.grid = grid;
    output.volume.labels = std::move(prepared->labelled.table);
    output.volume.columns = std::move(voxels->columns);
    output.volume.crsName = model.crs.name;
    output.volume.modelName = model.name;
    output.volume.source = std::filesystem::path(model.source).filename().string();
    report.seconds.pack = secondsSince(start);
    return output;
}

// Reads the style file of the options into `sheet`.
Result<BuildOptions> withStyle(BuildOptions options, StyleSheet& sheet) {
    if (options.style != nullptr || options.styleFile.empty()) return options;
    SVT_TRY(read, readStyleSheet(options.styleFile));
    sheet = std::move(*read);
    options.style = &sheet;
    return options;
}

}  // namespace

Result<BuildOutput> buildVolume(model::BuildingModel& model, const BuildOptions& given, Diagnostics* log) {
    StyleSheet sheet;
    SVT_TRY(options, withStyle(given, sheet));
    return buildFrom(model, *options, true, log);
}

Result<BuildOutput> buildVolume(std::span<const std::filesystem::path> files, const BuildOptions& given,
                                Diagnostics* log) {
    const auto start = Clock::now();
    StyleSheet sheet;
    SVT_TRY(options, withStyle(given, sheet));
    readers::ReadOptions reading = options->read;
    reading.threads = options->threads;
    reading.progress = options->progress;
    SVT_TRY(model, readers::readModels(files, reading, log));
    const double readSeconds = secondsSince(start);
    SVT_TRY(output, buildFrom(*model, *options, false, log));
    output->report.seconds.read = readSeconds;
    output->report.seconds.total = secondsSince(start);
    return output;
}

}  // namespace svt::pipeline
