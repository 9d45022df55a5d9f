#pragma once
/// \file
/// Faces of open shells that their filling leaves out: a counter that leaks, a pane whose two faces point the same way.
/// Their winding number is below 1/2 on both sides, so no voxel shows them.

#include <svt/voxelize/lattice/index_mesh.hpp>
#include <svt/voxelize/rewrite/rewrite.hpp>
#include <svt/voxelize/voxelize.hpp>

#include <span>
#include <vector>

namespace svt::voxelize {

/// Largest share of its surface that the filling of an open shell may leave out.
inline constexpr double kLostShare = 0.001;

/// The faces that are left out of one open shell.
struct LostFaces {
    double share = 0;               ///< of its surface; 0 if it is at most kLostShare
    std::vector<VoxelEdit> voxels;  ///< voxels that draw these faces
};

/// Finds faces farther than a voxel from all voxels of the object, between two samples that no object of the same or a
/// finer rank owns, and a sheet of voxels for them, as addThinSheet(). The sheet reaches up to the object. Triangles
/// between sample lines get the voxels along their longest edge.
/// \param columns  the finished columns
/// \param ranks    per scalar; the background has 255
/// Cost: O(voxels of the surface). For a large surface it is smaller if the filling leaves out little.
[[nodiscard]] LostFaces findLostFaces(const IndexMesh& mesh, const volume::ColumnVolume& columns,
                                      std::span<const std::uint8_t> ranks, volume::Scalar scalar);

}  // namespace svt::voxelize
