#pragma once
/// \file
/// Parts of a volume as volumes: a box of its samples, some of its labels, a coarse level. They stay columns of runs,
/// so a part of a volume that would be 50 GB dense takes no more memory than the columns. Labels keep their numbers,
/// scalars, names and tree; a label without voxels in the part stays in the table.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::volume {

/// Samples [begin, end) along each axis.
struct IndexBox {
    Vec3i begin{}, end{};
    friend bool operator==(const IndexBox&, const IndexBox&) = default;
};

/// The samples of `grid` whose positions lie in `world` (metres, bounds included). In a rotated grid: the samples in
/// the bounding box of `world` along the grid's axes. An axis with a single sample gets a second one, since a grid has
/// at least two.
/// \return the samples, or NothingSelected if there are none
[[nodiscard]] Result<IndexBox> samplesIn(const Grid& grid, const Box3d& world);

/// The box around all samples with a scalar of `first` to `last`, one sample wider on each side within the grid.
/// \return the box; IndexBox() if there is no such sample. Cost: O(runs of all columns)
[[nodiscard]] IndexBox samplesAround(const ColumnVolume& columns, Scalar first = 1, Scalar last = kMaxScalarCount - 1);

/// `columns` with scalar s replaced by newOf[s], in canonical form.
/// \param newOf  one entry for each scalar in `columns`
/// Cost: O(runs of the distinct columns + distinct rows).
[[nodiscard]] ColumnVolume replaceScalars(const ColumnVolume& columns, std::span<const Scalar> newOf);

/// The part of the volume in `box`; sample (0, 0, 0) of the result is box.begin. Voxels are counted again, and a label
/// that lost voxels gets the volume of its voxels. Overlaps with the voxels of labels in the part are kept; if such a label
/// lost voxels, its overlaps shrink in proportion. Vector parts are left out.
/// \param box  inside the grid, at least two samples along each axis
/// \return the part, or BadArgument for another box
[[nodiscard]] Result<SemanticVolume> croppedVolume(const SemanticVolume& volume, const IndexBox& box);

/// The part in a box of world coordinates, metres: croppedVolume() of samplesIn().
/// \return the part, or an error of these functions
[[nodiscard]] Result<SemanticVolume> volumeIn(const SemanticVolume& volume, const Box3d& world);

/// The volume with background in place of all labels except `kept` (indices, any order). Counts as for croppedVolume().
/// \return the part, or BadArgument if there is no such label
[[nodiscard]] Result<SemanticVolume> selectedVolume(const SemanticVolume& volume, std::span<const std::uint32_t> kept);

/// Level `level` of the volume: cells of 2^level samples along each axis, at the centre of their samples. A cell gets
/// the label that fills most of it, or background if it fills more (see LodLevel). So parts thinner than half a cell
/// may vanish. Level 0 is the volume itself. Planes and vector parts are left out.
/// \param level  0..6
/// \return the level, or BadArgument if it is out of range or the volume too small for it
[[nodiscard]] Result<SemanticVolume> coarseVolume(const SemanticVolume& volume, int level, int threads = 0);

/// Levels 1, 2, ... up to `coarsest`, as by coarseVolume(); fewer for a small volume.
/// \param coarsest  1..6
[[nodiscard]] Result<std::vector<SemanticVolume>> coarseVolumes(const SemanticVolume& volume, int coarsest,
                                                                int threads = 0);

}  // namespace svt::volume
