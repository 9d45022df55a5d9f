#pragma once
/// \file
/// Feature edges of a mesh, as in a line drawing: creases and borders, without the edges of the triangulation.

#include <svt/mesh/mesh_set.hpp>

#include <vector>

namespace svt::mesh {

struct FeatureEdgeOptions {
    /// Minimum angle between two faces for a crease, degrees; 0 = coplanar. The default is above the 15 degrees of a
    /// round column of 24 sides, whose facets should not be visible.
    double creaseAngleDegrees = 20;
    double tolerance = 1e-4;  ///< points within this distance of a line lie on it, metres
};

/// A straight line between two points of the mesh.
struct FeatureEdge {
    std::uint32_t from = 0, to = 0;  ///< indices in ObjectMesh::vertices (local space)
    friend bool operator==(const FeatureEdge&, const FeatureEdge&) = default;
};

/// Finds edges where two faces meet at an angle, where a face ends, and where more than two faces meet that are not all
/// coplanar. Edges between coplanar triangles are left out, also at T-junctions, where the two sides are divided at
/// different points. Collinear pieces are joined. The orientation of the triangles does not matter.
///
/// \return the edges, longest first, ties by vertex index
/// Cost: O(triangles log triangles), plus that of cutAtTJunctions() if the mesh is open.
[[nodiscard]] std::vector<FeatureEdge> findFeatureEdges(const ObjectMesh& mesh, const FeatureEdgeOptions& options = {});

}  // namespace svt::mesh
