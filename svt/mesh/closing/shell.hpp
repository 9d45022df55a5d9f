#pragma once
/// \file
/// One shell on its way to a mesh: gathered, tested for being closed, closed by what it has itself.

#include <svt/mesh/closing/sources.hpp>
#include <svt/mesh/mesh_set.hpp>
#include <svt/mesh/polygons/local_polygons.hpp>

#include <cstdint>
#include <vector>

namespace svt::mesh {

inline constexpr std::size_t kMaxLeaks = 100;

struct Shell {
    ObjectMesh mesh;
    std::vector<std::uint32_t> pointIds;        ///< per vertex: its welded point, see FaceFinder
    std::vector<model::PolygonIndex> polygons;  ///< ascending
    std::uint32_t duplicateFaces = 0;
    bool hasUncutJunctions = false;  ///< points are left on edges of others
};

/// What all shells of a model share.
struct ShellInput {
    const model::BuildingModel& model;
    const LocalPolygons& polygons;
    const MeshOptions& options;
    std::vector<model::FeatureIndex> surfaceOf;  ///< of findSurfacesOfPolygons()
};

/// The triangles of a source on welded points. A face that is used twice in the same direction is a duplicate and
/// dropped; two uses in opposite directions are kept (they cancel). Shells of voids are turned inwards.
[[nodiscard]] Shell gatherShell(const MeshSource& source, const ShellInput& input);

/// The closing test, and the repairs of faces that are there: doubled ones, T-junctions, ones that look the wrong way.
/// \param usesRays  faces are turned by meaning and by rays, too, if the shell is open
void testClosing(Shell& shell, const ShellInput& input, bool usesRays);

/// Closes an open shell by joining gaps, bridges and caps. Where there is nothing to fill it becomes a Surface.
/// \pre the shell is open
void closeByItself(ObjectMesh& mesh, const MeshOptions& options);

/// Joins the meshes of the solids of one object. The closure is the worst of theirs; a part that is a mere sheet gets a
/// back, so that it encloses nothing and yet is closed, unless all parts are sheets.
[[nodiscard]] Shell joinShells(std::vector<Shell> parts);

}  // namespace svt::mesh
