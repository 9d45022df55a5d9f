#include <svt/analyze/solid_overlaps.hpp>
#include <svt/core/machine.hpp>
#include <svt/mesh/thickness.hpp>
#include <svt/pipeline/build_volume.hpp>

#include <svt/model/classes.hpp>
#include <svt/pipeline/labels.hpp>
#include <svt/readers/model_joiner.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/voxelize/bodies.hpp>
#include <svt/voxelize/face_planes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace svt::pipeline {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Buildings in which only boundary surfaces can own the material between hull and rooms.
std::vector<voxelize::BodyGroup> findBodyGroups(const mesh::MeshSet& meshes, const LabelledObjects& labelled) {
    std::vector<std::uint32_t> objectOf(labelled.table.labels.size(), volume::kNoLabel);
    for (std::uint32_t o = 0; o < meshes.objects.size(); ++o) objectOf[labelled.labelOfObject[o]] = o;
    std::vector<voxelize::BodyGroup> groups;
    for (std::uint32_t o = 0; o < meshes.objects.size(); ++o) {
        const std::uint32_t l = labelled.labelOfObject[o];
        const volume::Label& building = labelled.table.labels[l];
        if (model::classRank(building.className) != model::ClassRank::Building ||
            meshes.objects[o].closure == mesh::Closure::Surface)
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

// Whether the bounding box of an object, along the grid's axes, intersects the grid.
bool meetsGrid(const mesh::ObjectMesh& object, const mesh::MeshSet& meshes, const volume::Grid& grid) {
    Box3d box;
    for (const Vec3d& vertex : object.vertices) box.add(grid.indexFromWorld(vertex + meshes.origin));
    const Vec3i n = grid.dimension();
    return box.overlaps({{-0.5, -0.5, -0.5}, {n.x - 0.5, n.y - 0.5, n.z - 0.5}});
}

// Whether an object lies in the grid as a whole.
bool liesInGrid(const mesh::ObjectMesh& object, const mesh::MeshSet& meshes, const volume::Grid& grid) {
    const Vec3i n = grid.dimension();
    const Box3d box{{-0.5, -0.5, -0.5}, {n.x - 0.5, n.y - 0.5, n.z - 0.5}};
    return std::all_of(object.vertices.begin(), object.vertices.end(),
                       [&](const Vec3d& vertex) { return box.contains(grid.indexFromWorld(vertex + meshes.origin)); });
}

// Reports objects outside a grid that was made for another model; an error if all are outside.
Result<void> checkGivenGrid(const model::BuildingModel& model, const mesh::MeshSet& meshes, const volume::Grid& grid,
                            Diagnostics* log) {
    std::size_t outside = 0;
    for (const mesh::ObjectMesh& object : meshes.objects) {
        if (meetsGrid(object, meshes, grid)) continue;
        ++outside;
        const model::Feature& feature = model.features[object.feature];
        if (log != nullptr)
            log->add(Severity::Warning, Code::NoGeometry, "no part of it lies in the given grid",
                     {model.source, feature.line, 0, feature.id});
    }
    if (outside < meshes.objects.size()) return {};
    const Vec3d low = meshes.bounds.min + meshes.origin, high = meshes.bounds.max + meshes.origin;
    return Error(
        Code::EmptyModel,
        fmt::format("no part of the model lies in the given grid: the model reaches from ({:.3f}, {:.3f}, "
                    "{:.3f}) to ({:.3f}, {:.3f}, {:.3f}), the grid begins at ({:.3f}, {:.3f}, {:.3f}); both "
                    "must be of one place and CRS",
                    low.x, low.y, low.z, high.x, high.y, high.z, grid.origin().x, grid.origin().y, grid.origin().z));
}

// What there is of a model before its voxels.
struct Prepared {
    mesh::MeshSet meshes;
    volume::Grid grid;
    std::optional<SpacingChoice> choice;  // of its spacing, where none was asked for
    LabelledObjects labelled;
};

Result<Prepared> prepare(model::BuildingModel& model, const BuildOptions& options, Diagnostics* log) {
    mesh::MeshOptions meshOptions;
    meshOptions.lod = options.lod;
    meshOptions.measuresThickness = false;  // below: only what is thinner than a voxel matters
    meshOptions.threads = options.threads;
    meshOptions.progress = options.progress;
    SVT_TRY(meshes, mesh::buildMeshes(model, meshOptions, log));
    std::optional<SpacingChoice> choice;
    SVT_TRY(grid, chooseGrid(*meshes, options, &choice));
    if (options.grid)
        if (const auto checked = checkGivenGrid(model, *meshes, *grid, log); !checked) return checked.error();
    const Vec3d spacing = grid->spacing();
    constexpr double kRounding = 1 + 1e-6;  // thickness is of single precision
    mesh::measureThickness(*meshes, std::max({spacing.x, spacing.y, spacing.z}) * kRounding, options.threads);
    addCapFeatures(model, *meshes);
    std::vector<const StyleSheet*> sheets{&defaultStyle(options.usePatterns)};
    if (options.style != nullptr) sheets.push_back(options.style);
    SVT_TRY(labelled, makeLabels(model, *meshes, sheets));
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
    auto voxels = voxelize::voxelize(meshes, grid, labelled.claims, voxelizeOptions);
    if (!voxels) return voxels;
    if (!groups.empty())
        voxels->columns =
            voxelize::assignThematicBodies(voxels->columns, grid, meshes, groups, options.threads, options.progress);
    Progress::tell(options.progress, "patterns", 0);
    if (!labelled.patterns.empty())
        voxels->columns =
            voxelize::layPatterns(voxels->columns, grid, meshes.origin, labelled.patterns, options.threads);
    return voxels;
}

// Enters into the label table what only the voxels tell.
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
}

// Voxels of a label, and those that others took which can stand in it: finer solids that claim the same voxels, the
// surfaces, bodies and open shells below it, whose overlaps are not counted, and all that is below an open shell. An upper
// bound: what three claim is counted twice.
std::uint64_t mostVoxels(const volume::LabelTable& table, std::uint32_t label, std::uint64_t lostByPriority) {
    const bool isOpen = table.labels[label].filling == volume::Filling::Winding;
    std::uint64_t sum = table.labels[label].voxels + lostByPriority;
    for (std::uint32_t below = label + 1; below < table.labels[label].subtreeEnd; ++below) {
        const volume::Filling filling = table.labels[below].filling;
        if (isOpen || filling == volume::Filling::Surface || filling == volume::Filling::Body ||
            filling == volume::Filling::Winding)
            sum += table.labels[below].voxels;
    }
    return sum;
}

// Warns of objects whose voxels are too many or too few for what their shells enclose. A face that is up to half a voxel
// off shifts the volume by half a voxel times its area, so area * spacing / 2 is allowed beside 2 %, and the one voxel that
// every object gets; small objects need no rule of their own by that.
void checkVolumes(const model::BuildingModel& model, const Prepared& prepared, const voxelize::VoxelizeResult& voxels,
                  Diagnostics& log) {
    constexpr double kPart = 0.02;
    const auto& [meshes, grid, choice, labelled] = prepared;
    const Vec3d spacing = grid.spacing();
    const double halfVoxel = std::max({spacing.x, spacing.y, spacing.z}) / 2;
    std::vector<std::uint64_t> lost(meshes.objects.size(), 0);
    for (const voxelize::ClaimPair& pair : voxels.overlaps) lost[pair.b] += pair.voxels;
    for (std::uint32_t o = 0; o < meshes.objects.size(); ++o) {
        const mesh::ObjectMesh& object = meshes.objects[o];
        if (object.closure == mesh::Closure::Surface || !liesInGrid(object, meshes, grid)) continue;
        const std::uint32_t l = labelled.labelOfObject[o];
        const volume::Label& label = labelled.table.labels[l];
        const double allowed = kPart * std::abs(object.enclosedVolume) + object.area * halfVoxel + grid.voxelVolume();
        const double most = double(mostVoxels(labelled.table, l, lost[o])) * grid.voxelVolume();
        const double least = double(label.voxels - std::min(label.voxels, label.thinVoxels)) * grid.voxelVolume();
        if (most >= object.enclosedVolume - allowed && least <= object.enclosedVolume + allowed) continue;
        const model::Feature& feature = model.features[object.feature];
        log.add(
            Severity::Warning, Code::VolumeDiffers,
            fmt::format("its voxels are {:.1f} m3, its shell encloses {:.1f} m3{}; expected at most {:.1f} m3 between "
                        "them; look at the object and correct its faces",
                        most < object.enclosedVolume ? most : least, object.enclosedVolume,
                        object.isSolid() ? "" : " if its holes are closed straight", allowed),
            {model.source, feature.line, 0, feature.id});
    }
}

// Where a bound on work made the answer coarser than it is elsewhere.
void tellBounds(const model::BuildingModel& model, const mesh::MeshSet& meshes, const voxelize::VoxelizeResult& voxels,
                Diagnostics& log) {
    for (const std::uint32_t o : voxels.unfilled) {
        const model::Feature& feature = model.features[meshes.objects[o].feature];
        log.add(
            Severity::Warning, Code::WindingFilled,
            fmt::format("its {} open edges are too many for winding numbers; it is kept as a surface without inside",
                        meshes.objects[o].openEdges.size()),
            {model.source, feature.line, 0, feature.id});
    }
    if (voxels.crowdedVoxels != 0)
        log.add(Severity::Warning, Code::Overlap,
                fmt::format("{} voxels are claimed by more than 16 solids each; of these only overlaps with the first "
                            "16 are counted",
                            voxels.crowdedVoxels),
                {model.source, 0, 0, {}});
}

void countObjects(const mesh::MeshSet& meshes, BuildReport& report) {
    report.objects = meshes.objects.size();
    report.triangles = meshes.triangleCount();
    for (const mesh::ObjectMesh& object : meshes.objects) {
        if (object.closure != mesh::Closure::Surface && object.leakCount != 0) ++report.open;
        if (object.closure == mesh::Closure::TJunctions) ++report.tJunctions;
        ++report.closures[std::size_t(object.closure)];
    }
}

}  // namespace

Result<model::BuildingModel> readModels(std::span<const std::filesystem::path> files, readers::ReadOptions options,
                                        Diagnostics* log) {
    if (files.empty()) return Error(Code::BadArgument, "no input file");
    readers::ModelJoiner joiner(log);
    for (const std::filesystem::path& file : files) {
        SVT_TRY(model, readers::readModel(file, options, log));
        joiner.add(std::move(*model));
        options.likelyCrs = joiner.joined().crs.epsg;
    }
    return std::move(joiner.joined());
}

Result<volume::Grid> chooseGrid(const mesh::MeshSet& meshes, const BuildOptions& options,
                                std::optional<SpacingChoice>* choice) {
    if (options.grid) return *options.grid;
    Box3d box;
    std::array<Vec3d, 3> axes{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
    if (options.axes == AxesKind::Building) {
        // All objects together, to find their dominant direction.
        mesh::ObjectMesh all;
        for (const mesh::ObjectMesh& object : meshes.objects) {
            const auto first = static_cast<std::uint32_t>(all.vertices.size());
            all.vertices.insert(all.vertices.end(), object.vertices.begin(), object.vertices.end());
            for (mesh::Triangle triangle : object.triangles) {
                for (std::uint32_t& corner : triangle.corners) corner += first;
                all.triangles.push_back(triangle);
            }
        }
        axes = voxelize::dominantAxes(all).directions;
        for (const Vec3d& vertex : all.vertices)
            box.add(Vec3d{dot(vertex, axes[0]), dot(vertex, axes[1]), dot(vertex, axes[2])});
    } else {
        box.min = meshes.bounds.min + meshes.origin;
        box.max = meshes.bounds.max + meshes.origin;
    }
    Vec3d spacing = options.spacing.value_or(Vec3d{});
    if (!options.dimension && !options.spacing) {
        double area = 0;
        for (const mesh::ObjectMesh& object : meshes.objects) area += object.area;
        SpacingChoice chosen = chooseSpacing(box.size(), area, options.memoryBytes);
        spacing = {chosen.spacing, chosen.spacing, chosen.spacing};
        if (choice != nullptr) *choice = std::move(chosen);
    }
    auto grid = options.dimension ? volume::Grid::fromDimension(box, *options.dimension)
                                  : volume::Grid::fromSpacing(box, spacing);
    if (grid && options.axes == AxesKind::Building) return grid->turned(axes, meshes.origin);
    return grid;
}

namespace {

// What only meshes and labels are made of. Ids, lines in the file and polylines stay.
void dropContent(model::BuildingModel& model) {
    model.polygons = {};
    for (model::Feature& feature : model.features) {
        feature.geometries = {};
        feature.attributes = {};
        feature.children = {};
    }
    returnFreeMemory();
}

// \param keepsContent  false: the model loses what has become meshes and labels
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
        tellBounds(model, meshes, *voxels, *log);
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
    SVT_TRY(model, readModels(files, reading, log));
    const double readSeconds = secondsSince(start);
    SVT_TRY(output, buildFrom(*model, *options, false, log));
    output->report.seconds.read = readSeconds;
    output->report.seconds.total = secondsSince(start);
    return output;
}

}  // namespace svt::pipeline
