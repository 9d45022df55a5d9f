#pragma once
/// \file
/// Triangle meshes of all objects of a model, each with its closing method. Built once from the semantic tree,
/// independent of any grid.

#include <svt/core/diagnostics.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/model/building_model.hpp>

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace svt::mesh {

inline constexpr std::uint32_t kNoPlane = 0xFFFFFFFFu;
inline constexpr model::PolygonIndex kNoPolygon = 0xFFFFFFFFu;

/// The plane z = slopeX * x + slopeY * y + offset in local space. It is shared by all coplanar triangles of the meshes,
/// in all objects and for any triangulation, so that two solids that share a face get the same heights, bit for bit.
struct Plane {
    double slopeX = 0;
    double slopeY = 0;
    double offset = 0;
};

struct Triangle {
    std::array<std::uint32_t, 3> corners{};  ///< indices in ObjectMesh::vertices; counter-clockwise from outside
    std::uint32_t plane = kNoPlane;          ///< index in MeshSet::planes; kNoPlane if (nearly) vertical
    float thickness = 0;  ///< metres of the object's material behind the centre of this face; +inf: unknown or a sheet
    model::PolygonIndex polygon = kNoPolygon;  ///< the polygon of the model; kNoPolygon: added, for example by a cap
};

/// How an object became a solid, or why it is not a solid.
enum class ClosingMethod : std::uint8_t {
    Closed,        ///< every edge is used equally often in both directions
    TJunctions,    ///< the same, after edges were split at points that lie on them
    Complemented,  ///< closed by faces of adjoining features
    Capped,        ///< closed by planar caps, by joining edges over gaps, or by bridges between loops
    Open,          ///< solid meaning, but still open: will be filled by generalized winding number
    Surface        ///< no solid meaning and not closed: a sheet
};
[[nodiscard]] std::string_view closingMethodName(ClosingMethod closingMethod) noexcept;

/// A cap that closes a planar hole; a ClosureSurface is added to the tree of the model for it.
struct Cap {
    double area = 0;          ///< m2
    Vec3d center{};           ///< local space
    std::vector<Vec3d> ring;  ///< local space
};

/// An edge without a partner, in the direction of its triangle. Local space.
struct OpenEdge {
    std::uint32_t from = 0, to = 0;  ///< indices in ObjectMesh::vertices
};

/// Mesh of one feature. Local space: world minus MeshSet::origin, metres.
struct ObjectMesh {
    model::FeatureIndex feature = model::kNoFeature;
    double lod = -1;
    std::vector<Vec3d> vertices;
    std::vector<Triangle> triangles;  ///< including caps and complements
    ClosingMethod closingMethod = ClosingMethod::Surface;
    std::vector<OpenEdge> openEdges;   ///< edges still open at the end (ClosingMethod::Open, Surface)
    std::vector<Vec3d> leaks;          ///< edge centres where the shell leaked as read, at most 100, local space
    std::uint32_t unmatchedEdges = 0;  ///< edges without a partner as read, including T-junctions
    std::uint32_t leakCount = 0;       ///< edges without a partner after splitting at T-junctions: real leaks
    std::uint32_t tJunctionCount = 0;  ///< edges that had to be split at points of others
    std::uint32_t flippedFaces = 0;    ///< triangles reversed to make the orientation consistent
    std::uint32_t complementedFaces = 0;
    std::uint32_t joinedEdges = 0;   ///< edges that had no partner and were joined over gaps of up to 25 cm
    std::uint32_t bridgedLoops = 0;  ///< pairs of loops of open edges with a strip of faces between them
    std::vector<Cap> caps;
    double volume = 0;          ///< m3, of the closed mesh; 0: open or unknown; common space of its solids counts once
    bool isVolumeKnown = true;  ///< false: three of its solids overlap each other
    double enclosedVolume = 0;  ///< m3: volume, and of an Open mesh an estimate, its holes closed by fans
    double area = 0;            ///< m2
    bool isAssembled = false;   ///< built from the boundary surfaces of the feature, because it has no solid of its own
    Box3d bounds;               ///< local space

    /// True if the mesh is closed, so that it defines inside and outside.
    [[nodiscard]] bool isSolid() const noexcept { return closingMethod <= ClosingMethod::Capped; }
};

/// All meshes of a model, in tree order of their features.
struct MeshSet {
    Vec3d origin{};  ///< world space, whole metres
    std::vector<ObjectMesh> objects;
    std::vector<Plane> planes;
    Box3d bounds;  ///< of all objects, local space
    [[nodiscard]] std::size_t triangleCount() const noexcept;
};

struct MeshOptions {
    model::LodChoice lod;             ///< level of detail to mesh of each feature
    double weldDistance = 5e-6;       ///< points closer than this along each axis are merged, metres
    double tJunctionDistance = 1e-4;  ///< a point within this distance of an edge lies on it, metres
    double capDeviation = 0.05;       ///< a hole is capped if its boundary is within this distance of a plane, metres
    bool measuresThickness = true;    ///< false: Triangle::thickness stays +inf, see measureThickness()
    int threads = 0;
    const Progress* progress = nullptr;
};

/// Makes the meshes of all features with geometry in the chosen level of detail, and of spaces without a solid whose
/// boundary surfaces (with their openings) form one.
///
/// Polygons are triangulated, points welded, duplicate faces removed, edges split at T-junctions, and faces oriented
/// consistently and outwards. The closing test (paper, section 4.1) runs on every object. For an open object with solid
/// meaning, the faces are oriented by their class and by rays. Then faces of adjoining features, joined edges over
/// gaps, bridges and planar caps complete the object. If it still is not closed, it stays Open, or becomes a Surface if
/// it encloses nothing. Every dropped part is reported as a diagnostic.
///
/// \param log  receives findings with feature id and world coordinates, in tree order; may be null
/// \return the meshes, or EmptyModel if no feature has geometry, or Cancelled
/// Cost: O(n log n) in the number of points. The result does not depend on `threads`.
[[nodiscard]] Result<MeshSet> buildMeshes(const model::BuildingModel& model, const MeshOptions& options = {},
                                          Diagnostics* log = nullptr);

/// Signed volume of a closed mesh, m3: a sixth of the sum of the triple products of its triangles. Positive if they
/// face outwards.
[[nodiscard]] double signedVolume(const std::vector<Vec3d>& vertices, const std::vector<Triangle>& triangles) noexcept;

}  // namespace svt::mesh
