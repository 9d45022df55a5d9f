#include <svt/mesh/closing/shell.hpp>

#include <svt/mesh/closing/gaps.hpp>
#include <svt/mesh/closing/holes.hpp>
#include <svt/mesh/closing/orient_faces.hpp>
#include <svt/mesh/polygons/edges.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace svt::mesh {
namespace {

using model::BuildingModel;
using model::FeatureIndex;
using model::SurfaceUse;

// Turns the faces of closed void shells inwards, because the file declares them as voids. Faces of a void that run
// against the others are turned as well. Returns the count of reversed triangles.
std::uint32_t turnVoidsInwards(const MeshSource& source, const LocalPolygons& polygons, std::vector<SurfaceUse>& uses) {
    std::uint32_t turned = 0;
    for (const auto& [begin, end] : source.voids) {
        std::vector<Triangle> shell;
        std::vector<double> parts;       // six times the signed volume of each triangle and the first corner
        std::vector<std::size_t> useOf;  // by triangle
        Vec3d base{};
        for (std::size_t u = begin; u < end; ++u)
            for (const auto& corners : polygons.trianglesOf(uses[u].polygon)) {
                if (shell.empty()) base = polygons.points[corners[0]];
                const double part = dot(polygons.points[corners[0]] - base,
                                        cross(polygons.points[corners[1]] - base, polygons.points[corners[2]] - base));
                parts.push_back(uses[u].isReversed ? -part : part);
                useOf.push_back(u);
                Triangle triangle;
                for (std::size_t c = 0; c < 3; ++c) triangle.corners[c] = polygons.pointIds[corners[c]];
                if (uses[u].isReversed) std::swap(triangle.corners[1], triangle.corners[2]);
                shell.push_back(triangle);
            }
        const std::vector<Triangle> given = shell;
        orientConsistently(shell);
        if (!findOpenEdges(shell).empty()) continue;
        const auto isAgainst = [&](std::size_t t) { return shell[t].corners != given[t].corners; };
        double volume = 0;
        for (std::size_t t = 0; t < shell.size(); ++t) volume += isAgainst(t) ? -parts[t] : parts[t];
        std::vector<char> isTurned(end - begin, 0);
        for (std::size_t t = 0; t < shell.size(); ++t)
            if (isAgainst(t) != (volume > 0)) {
                isTurned[useOf[t] - begin] = 1;
                ++turned;
            }
        for (std::size_t u = begin; u < end; ++u)
            if (isTurned[u - begin] != 0) uses[u].isReversed = !uses[u].isReversed;
    }
    return turned;
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

// Expected orientation per triangle, by the boundary surface that it belongs to.
std::vector<model::Orientation> orientationsOf(const ShellInput& input, const ObjectMesh& mesh) {
    const BuildingModel& model = input.model;
    const bool isSpace = model::isSpace(model.features[mesh.feature].className);
    std::vector<model::Orientation> orientations(mesh.triangles.size(), model::Orientation::Any);
    for (std::size_t t = 0; t < orientations.size(); ++t) {
        if (mesh.triangles[t].polygon == kNoPolygon) continue;
        const FeatureIndex surface = input.surfaceOf[mesh.triangles[t].polygon];
        FeatureIndex above = surface;
        while (above != model::kNoFeature && above != mesh.feature) above = model.features[above].parent;
        if (above != model::kNoFeature)
            orientations[t] = model::orientationOf(model.features[surface].className, isSpace);
    }
    return orientations;
}

// Gives a sheet a back: closed, but without a volume.
void addBack(ObjectMesh& mesh) {
    const std::size_t count = mesh.triangles.size();
    for (std::size_t t = 0; t < count; ++t) {
        Triangle back = mesh.triangles[t];
        std::swap(back.corners[1], back.corners[2]);
        mesh.triangles.push_back(back);
    }
    mesh.openEdges.clear();
    mesh.closingMethod = ClosingMethod::Capped;
}

}  // namespace

Shell gatherShell(const MeshSource& source, const ShellInput& input) {
    const LocalPolygons& polygons = input.polygons;
    Shell shell;
    ObjectMesh& mesh = shell.mesh;
    mesh.feature = source.feature;
    mesh.lod = source.lod;
    mesh.isAssembled = source.isAssembled;
    std::vector<SurfaceUse> uses = source.uses;
    mesh.flippedFaces = turnVoidsInwards(source, polygons, uses);
    std::set<std::pair<model::PolygonIndex, bool>> seen;
    for (const SurfaceUse& use : uses) {
        if (!seen.insert({use.polygon, use.isReversed}).second) {
            ++shell.duplicateFaces;
            continue;
        }
        shell.polygons.push_back(use.polygon);
        for (const auto& corners : polygons.trianglesOf(use.polygon)) {
            Triangle triangle;
            triangle.corners = {corners[0], corners[1], corners[2]};
            triangle.polygon = use.polygon;
            if (use.isReversed) std::swap(triangle.corners[1], triangle.corners[2]);
            mesh.triangles.push_back(triangle);
        }
    }
    std::sort(shell.polygons.begin(), shell.polygons.end());

    // Corners are still indices of polygon points: renumber them to the welded points in use.
    std::vector<std::uint32_t> used;
    used.reserve(mesh.triangles.size() * 3);
    for (const Triangle& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle.corners) used.push_back(polygons.pointIds[corner]);
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    mesh.vertices.resize(used.size());
    shell.pointIds = used;
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
    return shell;
}

void testClosing(Shell& shell, const ShellInput& input, bool usesRays) {
    ObjectMesh& mesh = shell.mesh;
    mesh.openEdges = findOpenEdges(mesh.triangles);
    mesh.unmatchedEdges = static_cast<std::uint32_t>(mesh.openEdges.size());
    if (!mesh.openEdges.empty()) {
        shell.duplicateFaces += removeDoubledTriangles(mesh.triangles);
        mesh.tJunctionCount =
            cutAtTJunctions(mesh.vertices, mesh.triangles, input.options.tJunctionDistance, &shell.hasUncutJunctions);
        mesh.openEdges = findOpenEdges(mesh.triangles);
    }
    if (!mesh.openEdges.empty()) {
        // The tessellator adds points where rings touch, which may be twins of corners up to its precision.
        weldLooseEnds(mesh, input.options.tJunctionDistance);
        mesh.openEdges = findOpenEdges(mesh.triangles);
    }
    if (!mesh.openEdges.empty()) {
        std::vector<Triangle> single = mesh.triangles;
        if (const std::uint32_t removed = removeDoubledFaces(mesh.vertices, single);
            removed != 0 && findOpenEdges(single).empty()) {
            mesh.triangles = std::move(single);
            mesh.openEdges.clear();
            shell.duplicateFaces += removed;
        }
    }
    if (!mesh.openEdges.empty()) {
        // Two uses of an edge in the same direction are not a leak, but inconsistently oriented faces.
        const std::uint32_t turned = orientConsistently(mesh.triangles);
        mesh.flippedFaces += turned;
        if (turned != 0) mesh.openEdges = findOpenEdges(mesh.triangles);
    }
    if (!mesh.openEdges.empty() && usesRays) {
        const std::uint32_t turned = orientFaces(mesh, orientationsOf(input, mesh));
        mesh.flippedFaces += turned;
        if (turned != 0) mesh.openEdges = findOpenEdges(mesh.triangles);
    }
    mesh.leakCount = static_cast<std::uint32_t>(mesh.openEdges.size());
    for (const OpenEdge& edge : mesh.openEdges) {
        if (mesh.leaks.size() == kMaxLeaks) break;
        mesh.leaks.push_back((mesh.vertices[edge.from] + mesh.vertices[edge.to]) * 0.5);
    }
    if (mesh.openEdges.empty())
        mesh.closingMethod = mesh.tJunctionCount != 0 ? ClosingMethod::TJunctions : ClosingMethod::Closed;
}

bool isFlat(const ObjectMesh& mesh) {
    if (!mesh.isSolid()) return false;
    double area = 0;
    for (const Triangle& triangle : mesh.triangles) {
        const Vec3d a = mesh.vertices[triangle.corners[0]];
        area += length(cross(mesh.vertices[triangle.corners[1]] - a, mesh.vertices[triangle.corners[2]] - a)) / 2;
    }
    return std::abs(signedVolume(mesh.vertices, mesh.triangles)) < 1e-6 * area * std::sqrt(area);
}

void closeByItself(ObjectMesh& mesh, const MeshOptions& options) {
    const std::vector<Vec3d> vertices = mesh.vertices;
    const std::vector<Triangle> triangles = mesh.triangles;
    capHoles(mesh, options.capDeviation);
    mesh.closingMethod = ClosingMethod::Capped;
    if (mesh.openEdges.empty() && !isFlat(mesh)) return;
    // Caps are not enough to close it.
    mesh.vertices = vertices;
    mesh.triangles = triangles;
    mesh.caps.clear();
    mesh.openEdges = findOpenEdges(mesh.triangles);
    mesh.joinedEdges = joinGaps(mesh);
    mesh.bridgedLoops = bridgeLoops(mesh);
    capHoles(mesh, options.capDeviation);
    mesh.closingMethod = mesh.openEdges.empty() ? ClosingMethod::Capped : ClosingMethod::Open;
    if (!isFlat(mesh) && (mesh.isSolid() || enclosesVolume(mesh))) return;
    // A footprint, a single face or loose sheets: there is no volume to fill.
    mesh.vertices = vertices;
    mesh.triangles = triangles;
    mesh.caps.clear();
    mesh.joinedEdges = mesh.bridgedLoops = 0;
    mesh.openEdges = findOpenEdges(mesh.triangles);
    mesh.closingMethod = ClosingMethod::Surface;
}

Shell joinShells(std::vector<Shell> parts) {
    const bool areSheets = std::all_of(parts.begin(), parts.end(), [](const Shell& part) {
        return part.mesh.closingMethod == ClosingMethod::Surface;
    });
    Shell all = std::move(parts.front());
    if (!areSheets && all.mesh.closingMethod == ClosingMethod::Surface) addBack(all.mesh);
    for (std::size_t p = 1; p < parts.size(); ++p) {
        ObjectMesh &mesh = all.mesh, &part = parts[p].mesh;
        if (!areSheets && part.closingMethod == ClosingMethod::Surface) addBack(part);
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
        for (Triangle triangle : part.triangles) {
            for (std::uint32_t& corner : triangle.corners) corner += first;
            mesh.triangles.push_back(triangle);
        }
        for (const OpenEdge& edge : part.openEdges) mesh.openEdges.push_back({edge.from + first, edge.to + first});
        for (const Vec3d& leak : part.leaks)
            if (mesh.leaks.size() < kMaxLeaks) mesh.leaks.push_back(leak);
        mesh.caps.insert(mesh.caps.end(), part.caps.begin(), part.caps.end());
        mesh.closingMethod = std::max(mesh.closingMethod, part.closingMethod);
        mesh.unmatchedEdges += part.unmatchedEdges;
        mesh.leakCount += part.leakCount;
        mesh.tJunctionCount += part.tJunctionCount;
        mesh.flippedFaces += part.flippedFaces;
        mesh.complementedFaces += part.complementedFaces;
        mesh.joinedEdges += part.joinedEdges;
        mesh.bridgedLoops += part.bridgedLoops;
        all.duplicateFaces += parts[p].duplicateFaces;
        all.hasUncutJunctions = all.hasUncutJunctions || parts[p].hasUncutJunctions;
    }
    return all;
}

}  // namespace svt::mesh
