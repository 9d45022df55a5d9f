#pragma once
/// \file
/// Coarse levels of a label volume. A cell of level L stands for a block of 2^L samples per axis and keeps
/// which labels are in it, with how much coverage, so nothing thin is lost: a wall one voxel thick in a cell of 8 is
/// there with coverage 1/8. Nothing is coloured here; a mixture gets its look from the styles at hand when it is drawn.
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

/// A label of a cell and the share of the cell it fills, in 1/255; never 0 for a label that is there.
struct MixturePart {
    Scalar scalar = 0;
    std::uint8_t coverage = 0;
    friend bool operator==(const MixturePart&, const MixturePart&) = default;
};

/// What a cell holds: its up to four most frequent labels but background, most frequent first (then the smaller
/// scalar). Background covers the rest. A fifth and further label's share goes to the first four in proportion.
struct Mixture {
    static constexpr std::size_t kMaxParts = 4;
    std::array<MixturePart, kMaxParts> parts{};
    std::uint8_t partCount = 0;

    [[nodiscard]] std::span<const MixturePart> labels() const noexcept { return {parts.data(), partCount}; }
    /// Share of all labels but background, in 1/255.
    [[nodiscard]] int coverage() const noexcept;
    friend bool operator==(const Mixture&, const Mixture&) = default;
};

/// One coarse level. `columns` and `bricks` hold mixture numbers in place of scalars; mixture 0 is background alone.
struct LodLevel {
    int level = 0;                  ///< a cell spans 2^level samples per axis
    Grid grid;                      ///< cell centres; spacing is 2^level times the volume's
    std::vector<Mixture> mixtures;  ///< distinct, in order of first use
    ColumnVolume columns;
    BrickVolume bricks;
};

/// Levels 1, 2, ... of `columns`, coarser and coarser; may be none for a small volume.
///
/// A level has ceil(n / 2^L) cells per axis; where n does not divide, the last cell's coverage is of the samples that
/// are there. The levels end at `coarsest` or before a dimension would fall below 2, and at 6 at the latest.
/// \param grid      grid of `columns`
/// \param coarsest  last level wanted, 1..6
/// \param threads   0: all cores; the result does not depend on it
/// \return the levels, finest first; BadArgument where `coarsest` is out of range or the grid's dimension is not the
///         volume's
/// Cost: O(columns + runs of the distinct blocks of columns) per level.
[[nodiscard]] Result<std::vector<LodLevel>> buildLodPyramid(const ColumnVolume& columns, const Grid& grid,
                                                            int coarsest = 6, int threads = 0);

/// Mixture of a block with these voxel counts.
/// \param counts  scalar and number of voxels (> 0), each scalar once, any order; background may be among them
/// \param total   voxels of the block, the sum of all counts
[[nodiscard]] Mixture mixtureOf(std::span<const std::pair<Scalar, std::uint64_t>> counts, std::uint64_t total);

}  // namespace svt::volume
