#pragma once
/// \file
/// Hierarchical shell extraction (the paper's section 5 and figure 17): of each group of components only the hull
/// stays, and the faces between its members vanish. Step by step from the component to the building this leaves less
/// and less, down to the outer hull: the surroundings of what is to be seen, and a reduction of data.
///
///     component              room                   building
///     +--+ +--+  two rooms   +-------+ +--+         +--------------+
///     |  | |  |  with wall   |       | |  |         |              |
///     +--+ +--+  and slab    |       | |  |         |              |
///     +-------+              +-------+ +--+         +--------------+

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/illustrate/shell_groups.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::illustrate {

/// Whose scalars the voxels of a shell have.
enum class ShellLabels : std::uint8_t {
    Components,  ///< that of the component whose voxel it was: roof and wall keep their colours
    Groups       ///< one per group, that of the label which stands for it
};

struct ShellOptions {
    double thickness = 0;           ///< metres; rounded up to voxels along each axis. 0: two voxels, see extractShell
    std::vector<std::uint32_t> of;  ///< labels; only the groups that have one of them are kept. Empty: all groups
    ShellLabels labels = ShellLabels::Components;
    int threads = 0;                     ///< at most this many; 0: all cores. The result does not depend on it
    const Progress* progress = nullptr;  ///< stage "shell"
};

/// The hulls of groups of labels. A voxel of a group stays where the box of +-r voxels around it, r = thickness /
/// spacing along each axis, rounded up, reaches something that is not its group: another group, a label without group,
/// background, or what lies beyond the grid. All else becomes background. So a hull has no holes, not even where voxels
/// meet by an edge alone, and all voxels of a group that see another one stay. Of a hull of one voxel the two sides of
/// an oblique face are often too near for the bricks' planes, and its steps show in pictures; two voxels are enough.
///
/// Background that a group alone encloses (it touches nothing else and does not reach the volume's border) counts as
/// part of the group, so the walls of its cavities vanish as well.
///
/// The grid stays. The labels stay, with new counts of voxels, so styles and queries work as before; with
/// ShellLabels::Groups only the labels that stand for groups have scalars, one each, in tree order.
///
/// \param groupOf  entry per label: the label that stands for its group, or kNoLabel for none; see groupLabels
/// \return the shell, or
///         - BadArgument      a thickness that is negative or not finite; `groupOf` or `of` that do not fit the labels;
///                            a scalar that belongs to no label
///         - NothingSelected  no voxel is left: the groups of `of` have none
///         - Cancelled
/// Cost: O(distinct rows of columns * (64 + 2 r) / 64) steps on sets of runs that are looked up, not computed, where
/// they are the same; about 0.1 s for a house at 800 x 700 x 400. Memory: that of the result, and one tile per thread.
[[nodiscard]] Result<volume::SemanticVolume> extractShell(const volume::SemanticVolume& volume,
                                                          std::span<const std::uint32_t> groupOf,
                                                          const ShellOptions& options = {});

/// The hulls of the groups of a level. Errors also as groupLabels.
[[nodiscard]] Result<volume::SemanticVolume> extractShell(const volume::SemanticVolume& volume, ShellLevel level,
                                                          const ShellOptions& options = {});

}  // namespace svt::illustrate
