#pragma once
/// \file
/// Feature edges of a mesh: the lines by which a person would draw it. Creases and borders, not triangulation.

#include <svt/mesh/mesh_scene.hpp>

#include <vector>

namespace svt::mesh {

struct FeatureEdgeOptions {
    /// Faces that meet at a larger angle than this make a crease, degrees, 0 = coplanar. Above the 15 degrees of a
    /// round column of 24 sides, whose facets are not meant to be seen.
    double creaseAngleDegrees = 20;
    double tolerance = 1e-4;  ///< points this near to a line lie on it, metres
};

/// A straight line between two points of the mesh.
struct FeatureEdge {
    std::uint32_t from = 0, to = 0;  ///< into ObjectMesh::vertices (local space)
    friend bool operator==(const FeatureEdge&, const FeatureEdge&) = default;
};

/// Where two faces meet at an angle, where a face ends, and where more than two faces meet that do not lie in one
/// plane. Edges between triangles of one plane are left out, also where one side of them is cut at other points than
/// the other (T-junctions); collinear pieces are joined. The winding of the triangles does not matter.
///
/// \return the edges, longest first, equal lengths by vertex numbers
/// Cost: O(triangles log triangles), and what cutAtTJunctions() takes where the mesh is open.
[[nodiscard]] std::vector<FeatureEdge> findFeatureEdges(const ObjectMesh& mesh, const FeatureEdgeOptions& options = {});

}  // namespace svt::mesh
