#pragma once
/// \file
/// Coarse levels of a label volume. A cell of level L covers a block of 2^L samples per axis and stores the labels in
/// it with their coverage. So thin parts are not lost: a wall one voxel thick has coverage 1/8 in a cell of 8. Colours
/// are not stored: they come from the current styles when a mixture is drawn.
/// After Al-Thelaya, Agus, Schneider: The Mixture Graph, IEEE TVCG 2020.

#include <svt/core/result.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/volume/grid.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::volume {

/// A label of a cell and the fraction of the cell that it fills, in 1/255; at least 1.
struct MixturePart {
    Scalar scalar = 0;
    std::uint8_t coverage = 0;
    friend bool operator==(const MixturePart&, const MixturePart&) = default;
};

/// The content of a cell: its most frequent labels except background, at most four, most frequent first (ties: the
/// smaller scalar first). Background covers the rest. The share of further labels is distributed among the first four
/// in proportion.
struct Mixture {
    static constexpr std::size_t kMaxParts = 4;
    std::array<MixturePart, kMaxParts> parts{};
    std::uint8_t partCount = 0;

    [[nodiscard]] std::span<const MixturePart> labels() const noexcept { return {parts.data(), partCount}; }
    /// Total coverage of all labels except background, in 1/255.
    [[nodiscard]] int coverage() const noexcept;
    friend bool operator==(const Mixture&, const Mixture&) = default;
};

/// One coarse level. `columns` and `bricks` hold mixture numbers instead of scalars; mixture 0 is pure background.
struct LodLevel {
    int level = 0;                  ///< a cell spans 2^level samples per axis
    Grid grid;                      ///< cell centres; spacing is 2^level times the volume's
    std::vector<Mixture> mixtures;  ///< distinct, in order of first use
    ColumnVolume columns;
    BrickVolume bricks;
};

/// Levels 1, 2, ... of `columns`, each with half the resolution of the previous one; no levels for a very small volume.
///
/// A level has ceil(n / 2^L) cells per axis. If 2^L does not divide n, the coverage of the last cell refers to the
/// samples that exist. The levels end at `coarsest`, or before a dimension would fall below 2.
/// \param grid      grid of `columns`
/// \param coarsest  last level, 1..6
/// \param threads   0: all cores; the result does not depend on it
/// \param progress  receives the progress of the stage "prepare"; may be null
/// \return the levels, finest first, or BadArgument if `coarsest` is out of range or the dimension of `grid` differs
///         from that of `columns`
/// Cost: O(columns + runs of the distinct blocks of columns) per level.
[[nodiscard]] Result<std::vector<LodLevel>> buildLodPyramid(const ColumnVolume& columns, const Grid& grid,
                                                            int coarsest = 6, int threads = 0,
                                                            const Progress* progress = nullptr);

/// Number of levels that buildLodPyramid() makes from a volume of this dimension, 0 to 6.
[[nodiscard]] int lodLevelCount(Vec3i dimension) noexcept;

/// One level, equal to the same level of buildLodPyramid(), since each is made from `columns`, not from the previous
/// one.
/// \param level  1 to lodLevelCount(columns.dimension())
/// \return the level, or BadArgument if there is no such level or the dimension of `grid` differs from that of
///         `columns`
/// Cost: O(columns + runs of the distinct blocks of columns).
[[nodiscard]] Result<LodLevel> buildLodLevel(const ColumnVolume& columns, const Grid& grid, int level, int threads = 0);

/// Mixture of a block with these voxel counts.
/// \param counts  scalar and number of voxels (> 0), each scalar once, any order; background may be among them
/// \param total   voxels of the block, the sum of all counts
[[nodiscard]] Mixture makeMixture(std::span<const std::pair<Scalar, std::uint64_t>> counts, std::uint64_t total);

}  // namespace svt::volume
