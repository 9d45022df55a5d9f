#pragma once
/// \file
/// Hierarchical shell extraction (the paper's section 5 and figure 17). Keeps only the hull of each group of
/// components, so that the faces between its members vanish. Each step from component to building keeps less, down to
/// the outer hull. A hull is a context for the visible objects, and reduces data.
///
///     component              room                   building
///     +--+ +--+  two rooms   +-------+ +--+         +--------------+
///     |  | |  |  with wall   |       | |  |         |              |
///     +--+ +--+  and slab    |       | |  |         |              |
///     +-------+              +-------+ +--+         +--------------+
///
/// - A shell is a group minus its erosion by a box of +-r voxels. Here for r = 1, with . for new background:
///
///         A A A A A A B          A A A A A A B       group A is hollowed; its voxels next to B, to background or to
///         A A A A A A B    ->    A . . . . A B       the grid's border are kept
///         A A A A A A B          A A A A A A B
///
/// - The erosion is separable. Along z, the runs of a column are shortened by r at both ends. Along x, then y, the
///   columns of a window are intersected, by blocks with running results from both ends (van Herk 1992). So a window
///   costs three intersections for any r.
/// - Columns are sets of runs, each stored once, and intersections of two sets are memoized. Walls repeat, so most
///   steps are look-ups (ours; shell/run_sets.hpp).
/// - Cavities that only one group encloses are found by union-find over background runs. They count as part of the
///   group before the erosion (ours; shell/enclosed_air.hpp).

#include <svt/core/names.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/illustrate/shell_groups.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::illustrate {

/// The scalars of a shell's voxels.
enum class ShellLabels : std::uint8_t {
    Components,  ///< scalars of the components: roof and wall keep their colours
    Groups       ///< one per group: the scalar of the label that represents it
};
constexpr auto namesOf(ShellLabels) {
    return std::to_array<Name<ShellLabels>>({{ShellLabels::Components, "components"}, {ShellLabels::Groups, "groups"}});
}

struct ShellOptions {
    double thickness = 0;           ///< metres, rounded up to voxels along each axis; 0: two voxels, see extractShell
    std::vector<std::uint32_t> of;  ///< labels; only groups with one of them are kept; empty: all groups
    ShellLabels labels = ShellLabels::Components;
    int threads = 0;                     ///< maximum; 0: all cores; the result does not depend on it
    const Progress* progress = nullptr;  ///< stage "shell"
};

/// The shells of groups of labels. A voxel of a group is kept if the box of +-r voxels around it contains anything
/// outside its group: another group, a label without group, background, or space beyond the grid. Along each axis, r =
/// thickness / spacing, rounded up. All other voxels become background. So a shell has no holes, not even where voxels
/// share only an edge, and all voxels of a group next to another one are kept. With a thickness of one voxel, the two
/// sides of an oblique face are often too close for the bricks' planes, and voxel steps are visible in pictures; two
/// voxels are enough.
///
/// Background that only one group encloses (it touches no other group and does not reach the volume's border) counts as
/// part of the group, so the walls of its cavities vanish as well.
///
/// The grid is unchanged. Only the voxel counts of labels change, so styles and queries work as before. With
/// ShellLabels::Groups, only the labels that represent groups have scalars, one each, in tree order.
///
/// \param groupOf  entry per label: the label that represents its group, or kNoLabel for none; see groupLabels
/// \return the shell, or
///         - BadArgument      a thickness that is negative or not finite; `groupOf` or `of` that do not match the
///                            labels; a scalar that belongs to no label.
///         - NothingSelected  no voxel is left: the groups of `of` have no voxels.
///         - Cancelled
/// Cost: O(distinct rows of columns * (64 + 2 r) / 64) operations on sets of runs, most of them memoized; about 0.1 s
/// for a house at 800 x 700 x 400. Memory: that of the result, and one tile per thread.
[[nodiscard]] Result<volume::SemanticVolume> extractShell(const volume::SemanticVolume& volume,
                                                          std::span<const std::uint32_t> groupOf,
                                                          const ShellOptions& options = {});

/// The shells of the groups of a level. Also returns errors of groupLabels().
[[nodiscard]] Result<volume::SemanticVolume> extractShell(const volume::SemanticVolume& volume, ShellLevel level,
                                                          const ShellOptions& options = {});

}  // namespace svt::illustrate
