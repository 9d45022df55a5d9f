#include <svt/core/parallel.hpp>
#include <svt/mesh/closing/closing.hpp>
#include <svt/mesh/closing/gaps.hpp>
#include <svt/mesh/closing/holes.hpp>
#include <svt/mesh/closing/orient_faces.hpp>
#include <svt/mesh/mesh_set.hpp>
#include <svt/mesh/planes.hpp>
#include <svt/mesh/polygons/edges.hpp>
#include <svt/mesh/polygons/local_polygons.hpp>
#include <svt/mesh/thickness.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace svt::mesh {
namespace {

using model::BuildingModel;
using model::Feature;
using model::FeatureIndex;
using model::SurfaceUse;

constexpr std::size_t kMaxLeaks = 100;

// The source of one mesh: a feature and the faces of its geometry.
struct Source {
    FeatureIndex feature = model::kNoFeature;
    double lod = -1;
    bool isAssembled = false;
    bool hasSolidMeaning = false;  // if so, an open shell will be closed
    std::vector<SurfaceUse> uses;
    std::vector<std::pair<std::size_t, std::size_t>> voids;  // ranges of `uses` that are shells of voids
};

void appendUses(const model::Geometry& geometry, Source& source) {
    auto& uses = source.uses;
    uses.insert(uses.end(), geometry.surfaces.begin(), geometry.surfaces.end());
    for (const model::Solid& solid : geometry.solids) {
        uses.insert(uses.end(), solid.exterior.begin(), solid.exterior.end());
        for (const auto& interior : solid.interiors) {
            source.voids.emplace_back(uses.size(), uses.size() + interior.size());
            uses.insert(uses.end(), interior.begin(), interior.end());
        }
    }
}

// Appends the faces of the boundary surfaces of a space, with their openings.
void appendBoundary(const BuildingModel& model, FeatureIndex space, const model::LodChoice& lod,
                    const std::vector<std::uint8_t>& isCoarser, Source& source) {
    for (const FeatureIndex child : model.features[space].children) {
        const Feature& feature = model.features[child];
        if (!model::isBoundarySurface(feature.className) && !(model::isFilling(feature.className) && child != space))
            continue;
        if (model::isFilling(feature.className) && !model::isBoundarySurface(model.features[space].className)) continue;
        if (isCoarser[child]) continue;
        if (const int chosen = lod.choose(feature); chosen >= 0) {
            const model::Geometry& geometry = feature.geometries[std::size_t(chosen)];
            source.lod = std::max(source.lod, geometry.lod);
            appendUses(geometry, source);
        }
        appendBoundary(model, child, lod, isCoarser, source);
    }
}

double chosenLod(const Feature& feature, const model::LodChoice& lod) {
    const int chosen = lod.choose(feature);
    return chosen < 0 ? -1 : feature.geometries[std::size_t(chosen)].lod;
}

// Marks boundary surfaces and openings of a coarser level of detail than others of their class in the same space: files
// with several levels of detail have separate surfaces for each.
std::vector<std::uint8_t> findCoarserSurfaces(const BuildingModel& model, const std::vector<FeatureIndex>& order,
                                              const model::LodChoice& lod) {
    const auto isSurface = [&](FeatureIndex f) {
        const std::string& name = model.features[f].className;
        return model::isBoundarySurface(name) || model::isFilling(name);
    };
    std::vector<FeatureIndex> spaceOf(model.features.size(), model::kNoFeature);
    std::map<std::pair<FeatureIndex, std::string_view>, double> finest;
    for (const FeatureIndex f : order) {
        const FeatureIndex parent = model.features[f].parent;
        if (!isSurface(f) || parent == model::kNoFeature) continue;
        spaceOf[f] = spaceOf[parent] != model::kNoFeature ? spaceOf[parent] : parent;
        double& lodOfClass = finest.try_emplace({spaceOf[f], model.features[f].className}, -1.0).first->second;
        lodOfClass = std::max(lodOfClass, chosenLod(model.features[f], lod));
    }
    std::vector<std::uint8_t> isCoarser(model.features.size(), 0);
    for (const FeatureIndex f : order)
        isCoarser[f] = spaceOf[f] != model::kNoFeature && !model.features[f].geometries.empty() &&
                       chosenLod(model.features[f], lod) < finest[{spaceOf[f], model.features[f].className}];
    return isCoarser;
}

std::vector<Source> collectSources(const BuildingModel& model, const model::LodChoice& lod, Diagnostics* log) {
    std::vector<Source> sources;
    const std::vector<FeatureIndex> order = model.treeOrder();
    const std::vector<std::uint8_t> isCoarser = findCoarserSurfaces(model, order, lod);
    if (const auto count = std::count(isCoarser.begin(), isCoarser.end(), 1); count != 0 && log != nullptr)
        log->add(Severity::Note, Code::NoGeometry,
                 fmt::format("{} boundary surfaces and openings are of a coarser level of detail than others of their "
                             "class and are left out",
                             count),
                 {model.source, 0, 0, {}});
    for (const FeatureIndex index : order) {
        if (isCoarser[index]) continue;
        const Feature& feature = model.features[index];
        Source own{index, -1, false, false, {}, {}};
        if (const int chosen = lod.choose(feature); chosen >= 0) {
            const model::Geometry& geometry = feature.geometries[std::size_t(chosen)];
            own.lod = geometry.lod;
            // Doors and windows can be bodies (CityGML 3.0) or sheets (openings of CityGML 2.0): the kind of geometry
            // decides.
            own.hasSolidMeaning = model::isFilling(feature.className) ? geometry.kind == model::GeometryKind::Solid
                                                                      : model::hasSolidMeaning(feature.className);
            appendUses(geometry, own);
        }
        if (model::hasSolidMeaning(feature.className)) {
            Source assembled{index, -1, true, true, {}, {}};
            appendBoundary(model, index, lod, isCoarser, assembled);
            if (!assembled.uses.empty() && (own.uses.empty() || assembled.lod > own.lod)) own = std::move(assembled);
        }
        if (!own.uses.empty()) sources.push_back(std::move(own));
    }
    return sources;
}

// The result of gather(). A face that is used twice in the same direction is a duplicate and dropped; two uses in
// opposite directions are kept (they cancel).
struct Gathered {
    std::vector<std::uint32_t> pointIds;        // welded point per vertex
    std::vector<model::PolygonIndex> polygons;  // ascending
    std::uint32_t duplicateFaces = 0;
};

// Reverses closed void shells that face outwards: the file declares them as voids, so they must face inwards.
// Returns the count of reversed triangles.
std::uint32_t turnVoidsInwards(const Source& source, const LocalPolygons& polygons, std::vector<SurfaceUse>& uses) {
    std::uint32_t turned = 0;
    std::vector<Triangle> shell;
    for (const auto& [begin, end] : source.voids) {
        shell.clear();
        double volume = 0;
        Vec3d base{};
        for (std::size_t u = begin; u < end; ++u)
            for (const auto& corners : polygons.trianglesOf(uses[u].polygon)) {
                if (shell.empty()) base = polygons.points[corners[0]];
                const double part = dot(polygons.points[corners[0]] - base,
                                        cross(polygons.points[corners[1]] - base, polygons.points[corners[2]] - base));
                volume += uses[u].isReversed ? -part : part;
                Triangle triangle;
                for (std::size_t c = 0; c < 3; ++c) triangle.corners[c] = polygons.pointIds[corners[c]];
                if (uses[u].isReversed) std::swap(triangle.corners[1], triangle.corners[2]);
                shell.push_back(triangle);
            }
        if (!(volume > 0) || !findOpenEdges(shell).empty()) continue;
        for (std::size_t u = begin; u < end; ++u) uses[u].isReversed = !uses[u].isReversed;
        turned += static_cast<std::uint32_t>(shell.size());
    }
    return turned;
}

Gathered gather(const Source& source, const LocalPolygons& polygons, ObjectMesh& mesh) {
    Gathered gathered;
    std::vector<SurfaceUse> uses = source.uses;
    mesh.flippedFaces = turnVoidsInwards(source, polygons, uses);
    std::set<std::pair<model::PolygonIndex, bool>> seen;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> vertexOfPoint;  // sorted later: (point, vertex)
    for (const SurfaceUse& use : uses) {
        if (!seen.insert({use.polygon, use.isReversed}).second) {
            ++gathered.duplicateFaces;
            continue;
        }
        gathered.polygons.push_back(use.polygon);
        for (const auto& corners : polygons.trianglesOf(use.polygon)) {
            Triangle triangle;
            triangle.corners = {corners[0], corners[1], corners[2]};
            triangle.polygon = use.polygon;
            if (use.isReversed) std::swap(triangle.corners[1], triangle.corners[2]);
            mesh.triangles.push_back(triangle);
        }
    }
    std::sort(gathered.polygons.begin(), gathered.polygons.end());

    // Corners are still indices of polygon points: renumber them to the welded points in use.
    std::vector<std::uint32_t> used;
    used.reserve(mesh.triangles.size() * 3);
    for (const Triangle& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle.corners) used.push_back(polygons.pointIds[corner]);
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    mesh.vertices.resize(used.size());
    gathered.pointIds = used;
    const auto vertexOf = [&](std::uint32_t corner) {
        const auto it = std::lower_bound(used.begin(), used.end(), polygons.pointIds[corner]);
        const auto vertex = static_cast<std::uint32_t>(it - used.begin());
        mesh.vertices[vertex] = polygons.points[corner];
        return vertex;
    };
    for (Triangle& triangle : mesh.triangles)
        for (std::uint32_t& corner : triangle.corners) corner = vertexOf(corner);
    std::erase_if(mesh.triangles, [](const Triangle& t) {
        return t.corners[0] == t.corners[1] || t.corners[1] == t.corners[2] || t.corners[0] == t.corners[2];
    });
    return gathered;
}

// Removes duplicate triangles with the same direction, from two polygons that are the same face.
std::uint32_t removeDoubledTriangles(std::vector<Triangle>& triangles) {
    std::set<std::array<std::uint32_t, 3>> seen;
    return static_cast<std::uint32_t>(std::erase_if(triangles, [&](const Triangle& triangle) {
        std::array<std::uint32_t, 3> key = triangle.corners;
        std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
        return !seen.insert(key).second;
    }));
}

struct Work {
    Gathered gathered;
    bool isClosedAsRead = false;
};

// Per polygon the boundary surface that lists it, or kNoFeature.
std::vector<FeatureIndex> findSurfacesOfPolygons(const BuildingModel& model) {
    std::vector<FeatureIndex> surfaceOf(model.polygons.size(), model::kNoFeature);
    for (FeatureIndex f = 0; f < model.features.size(); ++f) {
        if (!model::isBoundarySurface(model.features[f].className)) continue;
        for (const model::Geometry& geometry : model.features[f].geometries)
            for (const SurfaceUse& use : geometry.surfaces)
                if (surfaceOf[use.polygon] == model::kNoFeature) surfaceOf[use.polygon] = f;
    }
    return surfaceOf;
}

// Per triangle which way it should look by the boundary surface of the feature that it is a part of.
std::vector<model::Facing> facingsOf(const BuildingModel& model, const std::vector<FeatureIndex>& surfaceOf,
                                     const ObjectMesh& mesh) {
    const bool isSpace = model::isSpace(model.features[mesh.feature].className);
    std::vector<model::Facing> facings(mesh.triangles.size(), model::Facing::Any);
    for (std::size_t t = 0; t < facings.size(); ++t) {
        if (mesh.triangles[t].polygon == kNoPolygon) continue;
        const FeatureIndex surface = surfaceOf[mesh.triangles[t].polygon];
        FeatureIndex above = surface;
        while (above != model::kNoFeature && above != mesh.feature) above = model.features[above].parent;
        if (above != model::kNoFeature) facings[t] = model::facingOf(model.features[surface].className, isSpace);
    }
    return facings;
}

// What all closing tests share.
struct ClosingInput {
    const BuildingModel& model;
    const MeshOptions& options;
    std::vector<FeatureIndex> surfaceOf;
};

// The closing test, and the repairs that need no other features.
void testClosing(ObjectMesh& mesh, Work& work, const ClosingInput& input, bool hasSolidMeaning) {
    const MeshOptions& options = input.options;
    mesh.openEdges = findOpenEdges(mesh.triangles);
    mesh.unmatchedEdges = static_cast<std::uint32_t>(mesh.openEdges.size());
    if (!mesh.openEdges.empty()) {
        work.gathered.duplicateFaces += removeDoubledTriangles(mesh.triangles);
        mesh.tJunctionCount = cutAtTJunctions(mesh.vertices, mesh.triangles, options.tJunctionDistance);
        mesh.openEdges = findOpenEdges(mesh.triangles);
    }
    if (!mesh.openEdges.empty()) {
        std::vector<Triangle> single = mesh.triangles;
        if (const std::uint32_t removed = removeDoubledFaces(mesh.vertices, single);
            removed != 0 && findOpenEdges(single).empty()) {
            mesh.triangles = std::move(single);
            mesh.openEdges.clear();
            work.gathered.duplicateFaces += removed;
        }
    }
    if (!mesh.openEdges.empty()) {
        // Two uses of an edge in the same direction are not a leak, but inconsistently oriented faces.
        const std::uint32_t turned = orientConsistently(mesh.triangles);
        mesh.flippedFaces += turned;
        if (turned != 0) mesh.openEdges = findOpenEdges(mesh.triangles);
    }
    if (!mesh.openEdges.empty() && hasSolidMeaning) {
        const std::uint32_t turned = orientFaces(mesh, facingsOf(input.model, input.surfaceOf, mesh));
        mesh.flippedFaces += turned;
        if (turned != 0) mesh.openEdges = findOpenEdges(mesh.triangles);
    }
    mesh.leakCount = static_cast<std::uint32_t>(mesh.openEdges.size());
    for (const OpenEdge& edge : mesh.openEdges) {
        if (mesh.leaks.size() == kMaxLeaks) break;
        mesh.leaks.push_back((mesh.vertices[edge.from] + mesh.vertices[edge.to]) * 0.5);
    }
    if (mesh.openEdges.empty()) mesh.closure = mesh.tJunctionCount != 0 ? Closure::TJunctions : Closure::Closed;
}

void finish(ObjectMesh& mesh) {
    if (mesh.isSolid()) {
        mesh.flippedFaces += orientOutwards(mesh.vertices, mesh.triangles);
        mesh.volume = signedVolume(mesh.vertices, mesh.triangles);
        measureThickness(mesh);
    } else {
        for (Triangle& triangle : mesh.triangles) triangle.thickness = std::numeric_limits<float>::infinity();
    }
    for (const Triangle& triangle : mesh.triangles) {
        const Vec3d a = mesh.vertices[triangle.corners[0]];
        mesh.area += length(cross(mesh.vertices[triangle.corners[1]] - a, mesh.vertices[triangle.corners[2]] - a)) / 2;
        for (const std::uint32_t corner : triangle.corners) mesh.bounds.add(mesh.vertices[corner]);
    }
}

// True if the volume of a closed mesh is zero up to rounding errors.
bool isFlat(const ObjectMesh& mesh) {
    if (!mesh.isSolid()) return false;
    double area = 0;
    for (const Triangle& triangle : mesh.triangles) {
        const Vec3d a = mesh.vertices[triangle.corners[0]];
        area += length(cross(mesh.vertices[triangle.corners[1]] - a, mesh.vertices[triangle.corners[2]] - a)) / 2;
    }
    return std::abs(signedVolume(mesh.vertices, mesh.triangles)) < 1e-6 * area * std::sqrt(area);
}

// Meshes of all sources, each with its closing test.
MeshSet gatherMeshes(const std::vector<Source>& sources, const LocalPolygons& polygons, const ClosingInput& input,
                     std::vector<Work>& work) {
    MeshSet meshes;
    meshes.origin = polygons.origin;
    meshes.objects.resize(sources.size());
    parallelFor(sources.size(), 1, input.options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            ObjectMesh& mesh = meshes.objects[i];
            mesh.feature = sources[i].feature;
            mesh.lod = sources[i].lod;
            mesh.isAssembled = sources[i].isAssembled;
            work[i].gathered = gather(sources[i], polygons, mesh);
            testClosing(mesh, work[i], input, sources[i].hasSolidMeaning);
        }
    });
    return meshes;
}

void closeByItself(ObjectMesh& mesh, const MeshOptions& options) {
    const std::vector<Vec3d> vertices = mesh.vertices;
    const std::vector<Triangle> triangles = mesh.triangles;
    mesh.joinedEdges = joinGaps(mesh);
    mesh.bridgedLoops = bridgeLoops(mesh);
    capHoles(mesh, options.capDeviation);
    mesh.closure = mesh.openEdges.empty() ? Closure::Capped : Closure::Open;
    if (!isFlat(mesh) && (mesh.isSolid() || enclosesVolume(mesh))) return;
    // A footprint, a single face or loose sheets: there is no volume to fill.
    mesh.vertices = vertices;
    mesh.triangles = triangles;
    mesh.caps.clear();
    mesh.joinedEdges = mesh.bridgedLoops = 0;
    mesh.openEdges = findOpenEdges(mesh.triangles);
    mesh.closure = Closure::Surface;
}

// Closes the open objects with solid meaning, where they can be: by faces of adjoining features, then by their own.
Result<void> closeShells(const BuildingModel& model, const std::vector<Source>& sources, const LocalPolygons& polygons,
                         const MeshOptions& options, MeshSet& meshes, std::vector<Work>& work) {
    std::optional<FaceFinder> finder;  // made for the first open object
    for (std::size_t i = 0; i < meshes.objects.size(); ++i) {
        ObjectMesh& mesh = meshes.objects[i];
        if (mesh.openEdges.empty() || !sources[i].hasSolidMeaning) continue;
        if (Progress::isCancelled(options.progress)) return Error(Code::Cancelled, "stopped while closing shells");
        if (!finder) finder.emplace(polygons, model);
        work[i].gathered.pointIds.resize(mesh.vertices.size(), kNoPoint);
        mesh.complementedFaces = finder->complement(mesh, work[i].gathered.pointIds, work[i].gathered.polygons);
        if (mesh.openEdges.empty())
            mesh.closure = Closure::Complemented;
        else
            closeByItself(mesh, options);
    }
    return {};
}

std::string leakText(const ObjectMesh& mesh, Vec3d origin) {
    std::string text;
    for (std::size_t i = 0; i < std::min<std::size_t>(mesh.leaks.size(), 3); ++i) {
        const Vec3d at = mesh.leaks[i] + origin;
        text += fmt::format("{}({:.3f}, {:.3f}, {:.3f})", i == 0 ? "" : ", ", at.x, at.y, at.z);
    }
    return text + (mesh.leakCount > 3 ? ", ..." : "");
}

// What else than caps closed a shell.
std::string joinedText(const ObjectMesh& mesh) {
    std::string text;
    if (mesh.joinedEdges != 0) text += fmt::format(", {} edges joined over gaps of up to 25 cm", mesh.joinedEdges);
    if (mesh.bridgedLoops != 0) text += fmt::format(", {} pairs of loops bridged", mesh.bridgedLoops);
    return text;
}

void report(const BuildingModel& model, const ObjectMesh& mesh, const Work& work, Vec3d origin, Diagnostics& log) {
    const Feature& feature = model.features[mesh.feature];
    const Place place{model.source, feature.line, 0, feature.id};
    const std::string leaks = leakText(mesh, origin);
    if (work.gathered.duplicateFaces != 0)
        log.add(Severity::Warning, Code::DuplicateFace,
                fmt::format("{} faces or triangles occur twice in the shell; each is used once",
                            work.gathered.duplicateFaces),
                place);
    switch (mesh.closure) {
        case Closure::Closed:
        case Closure::Surface: break;
        case Closure::TJunctions:
            log.add(Severity::Note, Code::TJunction,
                    fmt::format("{} edges match only where they are cut at points of others; the shell is tight",
                                mesh.tJunctionCount),
                    place);
            break;
        case Closure::Complemented:
            log.add(Severity::Warning, Code::FacesComplemented,
                    fmt::format("{} edges have no partner; {} leak even where edges are cut at points of others, such "
                                "as {}; closed with {} faces of adjoining features",
                                mesh.unmatchedEdges, mesh.leakCount, leaks, mesh.complementedFaces),
                    place);
            break;
        case Closure::Capped:
            log.add(Severity::Warning, Code::ShellCapped,
                    fmt::format("{} edges have no partner; {} leak even where edges are cut at points of others, such "
                                "as {}; closed with {} planar caps{}",
                                mesh.unmatchedEdges, mesh.leakCount, leaks, mesh.caps.size(), joinedText(mesh)),
                    place);
            break;
        case Closure::Open:
            log.add(Severity::Warning, Code::WindingFilled,
                    fmt::format("{} edges have no partner; {} leak even where edges are cut at points of others, such "
                                "as {}; {} stay open, filled by generalized winding number",
                                mesh.unmatchedEdges, mesh.leakCount, leaks, mesh.openEdges.size()),
                    place);
            break;
    }
    if (mesh.flippedFaces != 0)
        log.add(Severity::Warning, Code::FaceFlipped,
                fmt::format("{} triangles faced the wrong way and were turned", mesh.flippedFaces), place);
}

}  // namespace

std::string_view closureName(Closure closure) noexcept {
    switch (closure) {
        case Closure::Closed: return "closed";
        case Closure::TJunctions: return "t-junctions";
        case Closure::Complemented: return "complemented";
        case Closure::Capped: return "capped";
        case Closure::Open: return "open";
        case Closure::Surface: return "surface";
    }
    return "surface";
}

std::size_t MeshSet::triangleCount() const noexcept {
    std::size_t count = 0;
    for (const ObjectMesh& object : objects) count += object.triangles.size();
    return count;
}

Result<MeshSet> buildMeshes(const BuildingModel& model, const MeshOptions& options, Diagnostics* log) {
    Progress::tell(options.progress, "mesh", 0);
    const std::vector<Source> sources = collectSources(model, options.lod, log);
    std::vector<std::uint8_t> isUsed(model.polygons.size(), 0);
    for (const Source& source : sources)
        for (const SurfaceUse& use : source.uses) isUsed[use.polygon] = 1;
    const LocalPolygons polygons = prepareLocalPolygons(model, isUsed, options, log);
    if (Progress::isCancelled(options.progress)) return Error(Code::Cancelled, "stopped while meshing");
    Progress::tell(options.progress, "mesh", 0.4);

    std::vector<Work> work(sources.size());
    MeshSet meshes = gatherMeshes(sources, polygons, {model, options, findSurfacesOfPolygons(model)}, work);
    if (const auto closed = closeShells(model, sources, polygons, options, meshes, work); !closed)
        return closed.error();
    Progress::tell(options.progress, "mesh", 0.7);

    parallelFor(meshes.objects.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) finish(meshes.objects[i]);
    });
    for (std::size_t i = 0; i < meshes.objects.size(); ++i) {
        meshes.bounds.add(meshes.objects[i].bounds);
        if (log != nullptr) report(model, meshes.objects[i], work[i], meshes.origin, *log);
    }
    std::erase_if(meshes.objects, [](const ObjectMesh& mesh) { return mesh.triangles.empty(); });
    if (meshes.objects.empty())
        return Error(Code::EmptyModel, "no feature of the model has geometry that can be voxelized",
                     {model.source, 0, 0, {}});
    assignPlanes(meshes, options.weldDistance * 4);
    Progress::tell(options.progress, "mesh", 1);
    return meshes;
}

}  // namespace svt::mesh
