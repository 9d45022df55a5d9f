#pragma once
/// \file
/// Label surfaces as triangles: the faces of voxels, merged into rectangles. Exact and closed.
///
///     strips along z or x     rectangles across       triangles: two, or, if vertices of other rectangles
///     +-+ +-+                 +---+                   lie on the border, a fan from the center, so that every
///     | | | |  ->             |   |  ->               edge is matched
///     +-+ +-+                 +---+

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/column_volume.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::writers {

/// The surface of one label.
struct LabelSurface {
    std::uint32_t label = 0;
    /// Twice the position in voxels from the volume's lower corner: the corner (i, j, k) of voxel (i, j, k) is at
    /// (2 i, 2 j, 2 k), its center at (2 i + 1, ...).
    std::vector<Vec3i> vertices;
    std::uint32_t cornerCount = 0;  ///< number of voxel corners, which come first; the others are centers of fans
    std::vector<std::array<std::uint32_t, 4>> middles;  ///< of each fan center: the corners of its rectangle
    /// Counter-clockwise from outside.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct SurfaceOptions {
    std::uint64_t maxTriangles = std::uint64_t{1} << 27;  ///< upper limit; more give GridTooLarge
    int threads = 0;                                      ///< maximum; 0: all cores
    const Progress* progress = nullptr;                   ///< stage "surface"
};

/// The surface between each label and everything outside it, ascending by label; labels without voxels have no surface.
/// Every edge of a label's surface is used equally often in both directions: twice in total, or four times where voxels
/// of the label touch only along an edge. There is one vertex per position, except for fan centers.
/// \param labelOfScalar  entry s owns scalar s, volume::kNoLabel for none
/// \return the surfaces, the same for any number of threads; or GridTooLarge for more than `maxTriangles`,
///         Cancelled
/// Cost: O(runs of all columns that differ from their neighbours + faces * log faces). Memory: about 150 bytes per
/// rectangle.
[[nodiscard]] Result<std::vector<LabelSurface>> labelSurfaces(const volume::ColumnVolume& columns,
                                                              std::span<const std::uint32_t> labelOfScalar,
                                                              const SurfaceOptions& options = {});

}  // namespace svt::writers
