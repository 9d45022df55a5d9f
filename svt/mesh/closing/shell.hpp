#pragma once
/// \file
/// Steps from a shell to a mesh: gather its faces, run the closing test, close it from its own faces.

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
    bool hasUncutJunctions = false;  ///< points still lie on edges of others
};

/// Input that all shells of a model share.
struct ShellInput {
    const model::BuildingModel& model;
    const LocalPolygons& polygons;
    const MeshOptions& options;
    std::vector<model::FeatureIndex> surfaceOf;  ///< of findSurfacesOfPolygons()
};

/// The triangles of a source on welded points. A face that is used twice in the same direction is a duplicate and
/// dropped; two uses in opposite directions are kept (they cancel). Shells of voids are turned inwards.
[[nodiscard]] Shell gatherShell(const MeshSource& source, const ShellInput& input);

/// The closing test, and repairs of the existing faces: doubled faces, T-junctions, wrong orientation.
/// \param usesRays  if the shell is open, also orients faces by class and by rays
void testClosing(Shell& shell, const ShellInput& input, bool usesRays);

/// Whether the volume of a closed mesh is zero up to rounding errors. False for an open one.
[[nodiscard]] bool isFlat(const ObjectMesh& mesh);

/// Closes an open shell by joining gaps, bridges and caps. If there is no volume to fill, it becomes a Surface.
/// \pre the shell is open, or flat
void closeByItself(ObjectMesh& mesh, const MeshOptions& options);

/// Joins the meshes of the solids of one object. The result has the worst closing method of the parts. A part that is
/// only a sheet gets a back, so that it is closed without enclosing a volume, unless all parts are sheets.
[[nodiscard]] Shell joinShells(std::vector<Shell> parts);

}  // namespace svt::mesh
