#pragma once
/// \file
/// Closing an open shell with faces of adjoining features (paper, section 4.1). gaps.hpp and holes.hpp close the rest.

#include <svt/mesh/mesh_set.hpp>
#include <svt/mesh/polygons/local_polygons.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace svt::mesh {

/// Marks a vertex of a mesh that is not a welded point of the polygons.
inline constexpr std::uint32_t kNoPoint = 0xFFFFFFFFu;

/// An index of polygons by their edges. Built once for all open objects.
class FaceFinder {
public:
    /// Indexes all polygons that have triangles. Cost: O(points log points).
    explicit FaceFinder(const LocalPolygons& polygons, const model::BuildingModel& model);
    ~FaceFinder();
    FaceFinder(const FaceFinder&) = delete;
    FaceFinder& operator=(const FaceFinder&) = delete;

    /// Adds faces of other features whose edges are the missing partners of `mesh.openEdges`, for example the face of a
    /// wall that is shared by two solids but listed by only one of them. A face is added if it closes more edges than
    /// it opens. Updates `mesh.openEdges`.
    /// \param pointIds  per vertex of the mesh: its welded point in the polygons, or kNoPoint; new vertices are added
    /// \param own       polygons that the mesh has already, ascending
    /// \return number of added faces
    /// Cost: O(n log n) in the open edges and in the edges of the faces that share a rare edge with them. Faces
    ///       with the same edges count once.
    std::uint32_t complement(ObjectMesh& mesh, std::vector<std::uint32_t>& pointIds,
                             const std::vector<model::PolygonIndex>& own) const;

private:
    struct Edges;
    class Chooser;
    const LocalPolygons& polygons_;
    std::unique_ptr<Edges> edges_;
};

}  // namespace svt::mesh
