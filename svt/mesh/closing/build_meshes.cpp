#include <svt/core/parallel.hpp>
#include <svt/mesh/closing/closing.hpp>
#include <svt/mesh/closing/shared_volume.hpp>
#include <svt/mesh/closing/shell.hpp>
#include <svt/mesh/mesh_set.hpp>
#include <svt/mesh/planes.hpp>
#include <svt/mesh/polygons/edges.hpp>
#include <svt/mesh/polygons/local_polygons.hpp>
#include <svt/mesh/thickness.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>

namespace svt::mesh {
namespace {

using model::BuildingModel;
using model::Feature;
using model::FeatureIndex;
using model::SurfaceUse;

// One object: its shell, or the shells of its solids separately if they are not closed together.
struct Work {
    Shell shell;
    std::vector<Shell> parts;
    SharedVolume shared;  // of the solids
};

// Where solids touch, wrongly oriented faces of both can cancel each other, so that the shells are closed only
// together. Then the shells of the solids are used separately, if turning faces closes them.
void checkSolidsAlone(const std::vector<MeshSource>& solids, const ShellInput& input, Shell& together) {
    std::vector<Shell> parts;
    bool isWrong = false;
    for (const MeshSource& solid : solids) {
        parts.push_back(gatherShell(solid, input));
        isWrong = isWrong || !findOpenEdges(parts.back().mesh.triangles).empty();
    }
    if (!isWrong) return;
    for (Shell& part : parts) {
        testClosing(part, input, false);
        if (!part.mesh.openEdges.empty()) return;
    }
    together = joinShells(std::move(parts));
}

// The shells of all sources, each with its closing test.
void gatherShells(const std::vector<MeshSource>& sources, const ShellInput& input, std::vector<Work>& work) {
    parallelFor(sources.size(), 1, input.options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::vector<MeshSource> parts = splitIntoSolids(sources[i]);
            work[i].shell = gatherShell(sources[i], input);
            testClosing(work[i].shell, input, sources[i].hasSolidMeaning && parts.empty());
            if (work[i].shell.mesh.openEdges.empty()) {
                checkSolidsAlone(parts, input, work[i].shell);
                work[i].shared = findSharedVolume(parts, input);
                continue;
            }
            // Surfaces around something that need not be a body, and enclose nothing: they stand for themselves.
            if (!sources[i].hasSolidMeaning && sources[i].isAssembled) work[i].shell = {};
            if (!sources[i].hasSolidMeaning) continue;
            for (const MeshSource& part : parts) {
                work[i].parts.push_back(gatherShell(part, input));
                testClosing(work[i].parts.back(), input, true);
            }
        }
    });
}

double areaOfTriangles(const ObjectMesh& mesh) {
    double area = 0;
    for (const Triangle& triangle : mesh.triangles) {
        const Vec3d a = mesh.vertices[triangle.corners[0]];
        area += length(cross(mesh.vertices[triangle.corners[1]] - a, mesh.vertices[triangle.corners[2]] - a)) / 2;
    }
    return area;
}

// True if a shell with caps of its own encloses the volume of one with borrowed faces, by less area. A borrowed floor of a
// court, and a cap below it, are a sheet that encloses nothing.
bool enclosesTheSameByLess(const ObjectMesh& own, const ObjectMesh& borrowed) {
    constexpr double kSame = 1e-6;
    if (own.closingMethod != ClosingMethod::Capped || own.joinedEdges != 0 || own.bridgedLoops != 0) return false;
    const double volume = signedVolume(borrowed.vertices, borrowed.triangles);
    return std::abs(signedVolume(own.vertices, own.triangles) - volume) <= kSame * std::abs(volume) &&
           areaOfTriangles(own) < (1 - kSame) * areaOfTriangles(borrowed);
}

// Closes the open objects with solid meaning, where they can be: by faces of adjoining features, then by their own.
Result<void> closeShells(const ShellInput& input, const std::vector<MeshSource>& sources, std::vector<Work>& work) {
    std::optional<FaceFinder> finder;  // made for the first open object
    const auto close = [&](Shell& shell) {
        ObjectMesh& mesh = shell.mesh;
        if (mesh.openEdges.empty()) return;
        if (!finder) finder.emplace(input.polygons, input.model);
        shell.pointIds.resize(mesh.vertices.size(), kNoPoint);
        const auto vertexCount = static_cast<std::ptrdiff_t>(mesh.vertices.size());
        const auto triangleCount = static_cast<std::ptrdiff_t>(mesh.triangles.size());
        ObjectMesh asRead = mesh;
        mesh.complementedFaces = finder->complement(mesh, shell.pointIds, shell.polygons);
        if (mesh.openEdges.empty()) {
            mesh.closingMethod = ClosingMethod::Complemented;
            if (!isFlat(mesh)) return;
        }
        closeByItself(mesh, input.options);
        if (mesh.complementedFaces == 0) return;
        if (mesh.closingMethod == ClosingMethod::Capped) {
            closeByItself(asRead, input.options);
            if (!enclosesTheSameByLess(asRead, mesh)) return;
            mesh = std::move(asRead);
            shell.pointIds.resize(mesh.vertices.size(), kNoPoint);
            return;
        }
        if (mesh.closingMethod != ClosingMethod::Surface) return;
        // A sheet, such as a footprint, does not include the sheets beside it.
        mesh.vertices.erase(mesh.vertices.begin() + vertexCount, mesh.vertices.end());
        mesh.triangles.erase(mesh.triangles.begin() + triangleCount, mesh.triangles.end());
        shell.pointIds.resize(mesh.vertices.size());
        mesh.openEdges = findOpenEdges(mesh.triangles);
        mesh.complementedFaces = 0;
    };
    for (std::size_t i = 0; i < work.size(); ++i) {
        if (work[i].shell.mesh.openEdges.empty() || !sources[i].hasSolidMeaning) continue;
        if (Progress::isCancelled(input.options.progress))
            return Error(Code::Cancelled, "stopped while closing shells");
        for (Shell& part : work[i].parts) close(part);
        if (work[i].parts.empty())
            close(work[i].shell);
        else
            work[i].shell = joinShells(std::move(work[i].parts));
    }
    return {};
}

// Volume of an open shell if each loop of open edges were closed by a fan around the middle of its corners.
double volumeWithFans(const ObjectMesh& mesh) {
    std::vector<Vec3d> vertices = mesh.vertices;
    std::vector<Triangle> triangles = mesh.triangles;
    for (const auto& loop : findBoundaryLoops(mesh.openEdges)) {
        Vec3d middle{};
        for (const std::uint32_t corner : loop) middle = middle + mesh.vertices[corner] / double(loop.size());
        const auto center = static_cast<std::uint32_t>(vertices.size());
        vertices.push_back(middle);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            Triangle fan;
            fan.corners = {loop[i], loop[(i + 1) % loop.size()], center};
            triangles.push_back(fan);
        }
    }
    return signedVolume(vertices, triangles);
}

void finish(ObjectMesh& mesh, const SharedVolume& shared, bool measuresThickness) {
    if (mesh.isSolid()) {
        mesh.flippedFaces += orientOutwards(mesh.vertices, mesh.triangles);
        mesh.volume = shared.isAny() ? shared.unionVolume().value_or(0) : signedVolume(mesh.vertices, mesh.triangles);
        mesh.isVolumeKnown = shared.isKnown;
    }
    for (Triangle& triangle : mesh.triangles) triangle.thickness = std::numeric_limits<float>::infinity();
    if (mesh.isSolid() && measuresThickness) measureThickness(mesh);
    mesh.enclosedVolume = mesh.isSolid()                              ? mesh.volume
                          : mesh.closingMethod == ClosingMethod::Open ? volumeWithFans(mesh)
                                                                      : 0;
    for (const Triangle& triangle : mesh.triangles) {
        const Vec3d a = mesh.vertices[triangle.corners[0]];
        mesh.area += length(cross(mesh.vertices[triangle.corners[1]] - a, mesh.vertices[triangle.corners[2]] - a)) / 2;
        for (const std::uint32_t corner : triangle.corners) mesh.bounds.add(mesh.vertices[corner]);
    }
}

// Polygons whose faces a shell turned: 1 those that the source uses forwards, 2 those that it uses reversed, 0 the
// others, and those that it uses both ways.
void markTurnedPolygons(const MeshSource& source, const LocalPolygons& polygons, const ObjectMesh& mesh,
                        std::vector<std::uint8_t>& turned) {
    std::map<model::PolygonIndex, Vec3d> asRead;  // area vectors, as the source uses the polygon
    std::map<model::PolygonIndex, bool> isReversed;
    std::set<model::PolygonIndex> isAmbiguous;
    for (const SurfaceUse& use : source.uses) {
        if (!isReversed.emplace(use.polygon, use.isReversed).second) isAmbiguous.insert(use.polygon);
        Vec3d& sum = asRead[use.polygon];
        for (const auto& c : polygons.trianglesOf(use.polygon)) {
            const Vec3d a = polygons.points[c[0]];
            const Vec3d normal = cross(polygons.points[c[1]] - a, polygons.points[c[2]] - a);
            sum = use.isReversed ? sum - normal : sum + normal;
        }
    }
    std::map<model::PolygonIndex, double> agreement;
    for (const Triangle& t : mesh.triangles) {
        if (t.polygon == kNoPolygon) continue;
        const Vec3d a = mesh.vertices[t.corners[0]];
        agreement[t.polygon] +=
            dot(asRead[t.polygon], cross(mesh.vertices[t.corners[1]] - a, mesh.vertices[t.corners[2]] - a));
    }
    for (const auto& [polygon, value] : agreement)
        if (value < 0 && isAmbiguous.count(polygon) == 0) turned[polygon] |= isReversed[polygon] ? 2 : 1;
}

// Boundary surfaces are flipped together with the shells that they bound, because a sheet lies behind its face. The
// finding of the shell covers them.
void turnSheets(const std::vector<MeshSource>& sources, const LocalPolygons& polygons, MeshSet& meshes) {
    std::vector<std::uint8_t> turned(polygons.firstPoint.size(), 0);
    bool hasTurned = false;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const ObjectMesh& mesh = meshes.objects[i];
        if (mesh.closingMethod == ClosingMethod::Surface || mesh.flippedFaces == 0) continue;
        markTurnedPolygons(sources[i], polygons, mesh, turned);
        hasTurned = true;
    }
    for (std::size_t i = 0; hasTurned && i < sources.size(); ++i) {
        ObjectMesh& mesh = meshes.objects[i];
        if (mesh.closingMethod != ClosingMethod::Surface || sources[i].hasSolidMeaning) continue;
        std::map<model::PolygonIndex, bool> isReversed;
        for (const SurfaceUse& use : sources[i].uses) isReversed.emplace(use.polygon, use.isReversed);
        for (Triangle& t : mesh.triangles)
            if (t.polygon != kNoPolygon && (turned[t.polygon] & (isReversed[t.polygon] ? 2 : 1)) != 0) {
                std::swap(t.corners[1], t.corners[2]);
            }
        mesh.openEdges = findOpenEdges(mesh.triangles);
    }
}

std::string leakText(const ObjectMesh& mesh, Vec3d origin) {
    std::string text;
    for (std::size_t i = 0; i < std::min<std::size_t>(mesh.leaks.size(), 3); ++i) {
        const Vec3d at = mesh.leaks[i] + origin;
        text += fmt::format("{}({:.3f}, {:.3f}, {:.3f})", i == 0 ? "" : ", ", at.x, at.y, at.z);
    }
    return text + (mesh.leakCount > 3 ? ", ..." : "");
}

// Text about closing methods of a shell besides caps.
std::string joinedText(const ObjectMesh& mesh) {
    std::string text;
    if (mesh.joinedEdges != 0) text += fmt::format(", {} edges joined over gaps of up to 25 cm", mesh.joinedEdges);
    if (mesh.bridgedLoops != 0) text += fmt::format(", {} pairs of loops bridged", mesh.bridgedLoops);
    return text;
}

void report(const BuildingModel& model, const Shell& shell, const SharedVolume& shared, const ObjectMesh& mesh,
            const MeshOptions& options, Vec3d origin, Diagnostics& log) {
    const Place place = model.placeOf(mesh.feature);
    const std::string leaks = leakText(mesh, origin);
    if (shell.duplicateFaces != 0)
        log.add(Severity::Warning, Code::DuplicateFace,
                fmt::format("{} faces or triangles occur twice in the shell; each is used once", shell.duplicateFaces),
                place);
    if (shell.hasUncutJunctions)
        log.add(Severity::Warning, Code::TJunction,
                fmt::format("cutting edges at points of others was stopped after {} cuts, and points still lie on "
                            "edges; faces probably overlap, or edges lie within {:g} m of each other",
                            mesh.tJunctionCount, options.tJunctionDistance),
                place);
    switch (mesh.closingMethod) {
        case ClosingMethod::Closed:
        case ClosingMethod::Surface: break;
        case ClosingMethod::TJunctions:
            log.add(Severity::Note, Code::TJunction,
                    fmt::format("{} edges match only where they are cut at points of others; the shell is tight",
                                mesh.tJunctionCount),
                    place);
            break;
        case ClosingMethod::Complemented:
            log.add(Severity::Warning, Code::FacesComplemented,
                    fmt::format("{} edges have no partner; {} leak even where edges are cut at points of others, such "
                                "as {}; closed with {} faces of adjoining features",
                                mesh.unmatchedEdges, mesh.leakCount, leaks, mesh.complementedFaces),
                    place);
            break;
        case ClosingMethod::Capped:
            log.add(Severity::Warning, Code::ShellCapped,
                    fmt::format("{} edges have no partner; {} leak even where edges are cut at points of others, such "
                                "as {}; closed with {} planar caps{}{}",
                                mesh.unmatchedEdges, mesh.leakCount, leaks, mesh.caps.size(), joinedText(mesh),
                                mesh.complementedFaces == 0
                                    ? ""
                                    : fmt::format(" and {} faces of adjoining features", mesh.complementedFaces)),
                    place);
            break;
        case ClosingMethod::Open:
            log.add(Severity::Warning, Code::WindingFilled,
                    fmt::format("{} edges have no partner; {} leak even where edges are cut at points of others, such "
                                "as {}; {} stay open, filled by generalized winding number",
                                mesh.unmatchedEdges, mesh.leakCount, leaks, mesh.openEdges.size()),
                    place);
            break;
    }
    if (mesh.isSolid() && shared.isAny())
        log.add(shared.isKnown ? Severity::Note : Severity::Warning, Code::SolidsIntersect,
                shared.isKnown ? fmt::format("its solids overlap by {:.6g} m3, which count once", shared.shared)
                               : "at least three of its solids overlap each other, so its volume is that of its voxels",
                place);
    if (mesh.flippedFaces != 0)
        log.add(Severity::Warning, Code::FaceFlipped,
                fmt::format("{} triangles faced the wrong way and were turned", mesh.flippedFaces), place);
}

}  // namespace

std::string_view closingMethodName(ClosingMethod closingMethod) noexcept {
    switch (closingMethod) {
        case ClosingMethod::Closed: return "closed";
        case ClosingMethod::TJunctions: return "t-junctions";
        case ClosingMethod::Complemented: return "complemented";
        case ClosingMethod::Capped: return "capped";
        case ClosingMethod::Open: return "open";
        case ClosingMethod::Surface: return "surface";
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
    const std::vector<MeshSource> sources = collectSources(model, options.lod, log);
    std::vector<std::uint8_t> isUsed(model.polygons.size(), 0);
    for (const MeshSource& source : sources)
        for (const SurfaceUse& use : source.uses) isUsed[use.polygon] = 1;
    const LocalPolygons polygons = prepareLocalPolygons(model, isUsed, options, log);
    if (Progress::isCancelled(options.progress)) return Error(Code::Cancelled, "stopped while meshing");
    Progress::tell(options.progress, "mesh", 0.4);

    const ShellInput input{model, polygons, options, findSurfacesOfPolygons(model)};
    std::vector<Work> work(sources.size());
    gatherShells(sources, input, work);
    SVT_DO(closeShells(input, sources, work));
    Progress::tell(options.progress, "mesh", 0.7);

    MeshSet meshes;
    meshes.origin = polygons.origin;
    for (Work& object : work) meshes.objects.push_back(std::move(object.shell.mesh));
    parallelFor(meshes.objects.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            finish(meshes.objects[i], work[i].shared, options.measuresThickness);
            meshes.objects[i].vertices.shrink_to_fit();  // lists that grew may have reserved twice their size
            meshes.objects[i].triangles.shrink_to_fit();
        }
    });
    turnSheets(sources, polygons, meshes);
    for (std::size_t i = 0; i < meshes.objects.size(); ++i) {
        meshes.bounds.add(meshes.objects[i].bounds);
        if (log != nullptr)
            report(model, work[i].shell, work[i].shared, meshes.objects[i], options, meshes.origin, *log);
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
