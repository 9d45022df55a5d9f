#pragma once
/// \file
/// The faces of surfaces that bound a body, such as the roof of a building with a solid, where the body has them.
///
/// Closing an open shell can move its corners by up to 25 cm. The surfaces keep their faces as in the model. A sheet along
/// those would lie in the body, or in front of it, and the outside of the body would show through. So each polygon of a
/// surface takes the triangles that the body has of it, with the orientation of the surface.

#include <svt/mesh/mesh_set.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <span>
#include <vector>

namespace svt::voxelize {

/// A body and the surfaces that bound it.
struct BoundedBody {
    std::uint32_t body = 0;               ///< object index
    std::vector<std::uint32_t> surfaces;  ///< object indices, ascending
};

/// The bodies with surfaces, by object index. Surfaces that are solids themselves are left out.
[[nodiscard]] std::vector<BoundedBody> findBoundedBodies(const mesh::MeshSet& meshes,
                                                         std::span<const ObjectClaim> claims);

/// The mesh of each surface of `bodies`, at its object index; the other meshes are empty. Polygons without a face of
/// the body keep their own triangles.
/// Cost: O(n log n) in the triangles of the bodies and surfaces.
[[nodiscard]] std::vector<mesh::ObjectMesh> makeBodyFaces(const mesh::MeshSet& meshes,
                                                          std::span<const BoundedBody> bodies, int threads);

}  // namespace svt::voxelize
