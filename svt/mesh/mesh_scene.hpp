#pragma once
/// \file
/// Triangle meshes of all objects of a model, each with how it was closed. Made once from the
/// semantic tree, independent of any grid.

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

/// z = slopeX * x + slopeY * y + offset in local space. One plane stands for all triangles of the scene that
/// lie on it, whichever object they belong to and however they were cut: two solids that share a face
/// get the same heights from it, bit for bit.
struct Plane {
    double slopeX = 0;
    double slopeY = 0;
    double offset = 0;
};

struct Triangle {
    std::array<std::uint32_t, 3> corners{};  ///< into ObjectMesh::vertices; counter-clockwise from outside
    std::uint32_t plane = kNoPlane;          ///< into MeshScene::planes; kNoPlane where (nearly) vertical
    float thickness = 0;  ///< metres of the object's material behind the centre of this face; +inf: unknown or a sheet
};

/// How an object came to be a solid, or why it is none.
enum class Closure : std::uint8_t {
    Closed,        ///< every edge is used equally often in both directions
    TJunctions,    ///< the same once edges are cut at the points that lie on them
    Complemented,  ///< closed by faces of adjoining features
    Capped,        ///< closed by planar caps
    Open,          ///< solid meaning, still open: to be filled by generalized winding number
    Surface        ///< no solid meaning and not closed: a sheet
};
[[nodiscard]] std::string_view closureName(Closure closure) noexcept;

/// A cap that closes a planar hole; the model's tree gets a ClosureSurface for it.
struct Cap {
    double area = 0;          ///< m2
    Vec3d center{};           ///< local space
    std::vector<Vec3d> ring;  ///< local space
};

/// An edge without partner. Local space.
struct OpenEdge {
    std::uint32_t from = 0, to = 0;  ///< into ObjectMesh::vertices
};

/// Mesh of one feature. Local space: world minus MeshScene::origin, metres.
struct ObjectMesh {
    model::FeatureIndex feature = model::kNoFeature;
    double lod = -1;
    std::vector<Vec3d> vertices;
    std::vector<Triangle> triangles;  ///< with caps and complements
    Closure closure = Closure::Surface;
    std::vector<OpenEdge> openEdges;  ///< what is open at the end (Closure::Open, Surface)
    std::vector<Vec3d> leaks;  ///< points where the shell leaked as read (edge centres, at most 100), local space
    std::uint32_t unmatchedEdges = 0;  ///< edges without partner as read, T-junctions counted
    std::uint32_t leakCount = 0;       ///< edges without partner once edges are cut at T-junctions: real leaks
    std::uint32_t tJunctionCount = 0;  ///< edges that had to be cut at points of others
    std::uint32_t flippedFaces = 0;    ///< triangles turned to make the orientation consistent
    std::uint32_t complementedFaces = 0;
    std::vector<Cap> caps;
    double volume = 0;         ///< m3 by the closed mesh; 0 where open
    double area = 0;           ///< m2
    bool isAssembled = false;  ///< made from the feature's boundary surfaces, for want of a solid of its own
    Box3d bounds;              ///< local space

    /// True where inside and outside are told by the mesh alone.
    [[nodiscard]] bool isSolid() const noexcept { return closure <= Closure::Capped; }
};

/// All meshes of a model, in tree order of their features.
struct MeshScene {
    Vec3d origin{};  ///< world space, whole metres
    std::vector<ObjectMesh> objects;
    std::vector<Plane> planes;
    Box3d bounds;  ///< of all objects, local space
    [[nodiscard]] std::size_t triangleCount() const noexcept;
};

struct MeshOptions {
    model::LodChoice lod;             ///< which level of detail of a feature to mesh
    double weldDistance = 5e-6;       ///< points closer than this along each axis are one, metres
    double tJunctionDistance = 1e-4;  ///< a point this near to an edge lies on it, metres
    double capDeviation = 0.05;       ///< a hole is capped where its boundary is this near to a plane, metres
    int threads = 0;
    const Progress* progress = nullptr;
};

/// Makes the meshes of all features that have geometry in the chosen level of detail, and of
/// spaces without a solid whose boundary surfaces (with their openings) stand for one.
///
/// Polygons are triangulated, points welded, doubled faces removed, faces turned until
/// neighbours agree and shells face outwards; then every object takes the closing test (paper, section 4.1).
/// An open one with solid meaning is completed by faces of adjoining features, then by planar caps, else left
/// Open. Nothing is dropped without a diagnostic.
///
/// \param log  gets findings with the feature's id and world coordinates, in tree order; may be null
/// \return the scene, or EmptyModel where no feature has geometry, or Cancelled
/// Cost: O(n log n) in the count of points. The result does not depend on `threads`.
[[nodiscard]] Result<MeshScene> buildMeshes(const model::BuildingModel& model, const MeshOptions& options = {},
                                            Diagnostics* log = nullptr);

/// Six times the signed volume is the sum over triangles; positive where they face outwards. m3.
[[nodiscard]] double signedVolume(const std::vector<Vec3d>& vertices, const std::vector<Triangle>& triangles) noexcept;

}  // namespace svt::mesh
