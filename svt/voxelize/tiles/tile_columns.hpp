#pragma once
/// \file
/// Makes the columns of a tile (64 x 64 at most) from the boundaries over its plan.
///
///     z                    _.-|               section along one row of the tile: a room below a sloped attic
///     ^                _.-'   |  roof
///     |            _.-'       |
///     |            |  attic   |
///     |            |----------|  ceiling
///     |            |   room   |
///     |            |----------|  floor
///     +------------+----------+--------> x
///     |     A      |    B     |     C         intervals of the row, see tile_plan.hpp; A and C have no boundaries
///
///     stack of B   floor {room entry}, ceiling {room exit, attic entry}, roof {attic exit}
///     order        floor, ceiling, roof       slots of the height planes, sorted by height
///     profile      0 | room | attic | 0       scalars below, between and above the height planes in this order
///
///     step n              0  1  2  3  4  5    one line along x over B.
///     height of the roof  5  5  6  6  7  7    first sample above it; floor and ceiling are flat, at 2 and 4.
///     break               1  0  1  0  1  0    some height differs from the previous step.
///     column              a  a  b  b  c  c    a = {end 2, 0} {end 4, room} {end 5, attic} {end nz, 0}
///                                             b = the same with {end 6, attic}, c with {end 7, attic}
///
/// The ideas; all are ours, except for coherence, which is that of scanline rendering:
/// - A column is a profile at heights. Priority between claims is resolved once per profile (profiles.hpp).
/// - Intervals with equal boundaries share one stack, in all tiles; it is found by hash.
/// - Coherence: a stack keeps its height planes in the order of its last column. Moving to the next one updates only
///   the heights of sloped height planes; height planes are sorted again only if they no longer ascend.
/// - Heights are computed for whole lines by SIMD (line_heights.hpp), and columns are made only at breaks. An interval
///   without slopes has one column per tile. An interval that slopes only along y has one column per break along y. An
///   interval that slopes only along x is made only for the first of the rows with one plan. Unchanged rows are
///   repeated as a whole.
/// - On slopes the same heights recur from row to row: a direct-mapped cache, indexed by a hash of stack and heights,
///   finds columns made before. Its entries also count voxels shared by solids, so a hit costs one addition.
///
/// Glossary:
///   | Boundary           | a face of a claim, or an end of one of its boxes, at a height plane: entry or exit
///   | stack              | all boundaries over an interval, grouped by height plane
///   | slot               | the index of a height plane in a stack
///   | line, step         | up to 64 samples along x or y over an interval; step n is its sample n
///   | computeHeights     | computes all heights of a stack at one column and sorts them (first use of the stack)
///   | setSlopedHeights   | sets the heights of the sloped height planes to those of a step
///   | computeLineHeights | computes the heights of the sloped height planes at all steps of a line, and the breaks
///   | columnAtStep       | number of the column at a step: looks it up in the cache, calls cacheColumn() on a miss
///   | cacheColumn        | moves the stack to the step, makes the column and replaces the cache entry
///   | ColumnCacheEntry   | an entry of the cache

#include <svt/core/hash_index.hpp>
#include <svt/volume/column_volume.hpp>
#include <svt/voxelize/lattice/line_heights.hpp>
#include <svt/voxelize/tiles/profiles.hpp>
#include <svt/voxelize/tiles/tile_plan.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace svt::voxelize {

/// Makes the columns of tiles, one tile after the other; keeps stacks, profiles and buffers between them. One instance
/// per thread.
class TileColumns {
public:
    TileColumns(std::span<const PrioritizedClaim> claims, const HeightPlanes& heightPlanes);

    /// The finished tile, in canonical form.
    [[nodiscard]] volume::ColumnTileData make(const TileInput& input);

    /// Voxels claimed by two solids, in all tiles made since the last call.
    [[nodiscard]] OverlapCounts takeCounts();
    /// Entry s is 1 if some voxel of the tiles made so far has scalar s. Ends at the largest scalar of the claims.
    [[nodiscard]] std::span<const std::uint8_t> usedScalars() const noexcept { return usedScalars_; }

private:
    static constexpr std::size_t kTile = kLineSamples;

    // The boundaries over an interval, grouped by height plane, and the order of the height planes in the last column.
    // Intervals with equal boundaries share a stack, in all tiles.
    struct BoundaryStack {
        std::uint64_t hash = 0;
        std::uint32_t firstMember = 0, memberCount = 0;            // range of members_
        std::uint32_t firstHeightPlane = 0, heightPlaneCount = 0;  // range of stackHeightPlanes_ and order_
        std::uint32_t firstSloped = 0, slopedCount = 0;            // range of sloped_
        std::uint32_t firstHeight = 0;  // in heights_: 0, the heights of the height planes bottom up, depth
        std::uint32_t profile = 0;
        std::uint32_t tile = 0;    // stack without slopes: the tile for which `column` is valid
        std::uint16_t column = 0;  // its column in that tile
        bool isOrdered = false, slopesX = false, slopesY = false;
    };
    struct StackHeightPlane {
        std::uint32_t heightPlane, firstCode, codeCount;  // codes: range of stackCodes_
    };
    struct SlopedHeightPlane {
        std::uint32_t heightPlane, slot, height;  // slot: index within the stack; height: its index in heights_
    };
    struct Interval {
        std::int32_t begin = 0, end = 0;
        std::uint32_t stack = 0;
        std::uint32_t line = 0;    // index in lines_ of its line: along y if it slopes only along y, else along x
        std::uint64_t breaks = 0;  // line along y, bit i: row i differs from row i - 1
    };
    // `count` samples from (i, j) on, along x or along y; samples of the grid.
    struct Line {
        std::int32_t i, j, count;
        bool isAlongX;
    };

    // Cache entry: a recent column with its key (stack, heights of the sloped height planes), and the voxels that
    // solids share in it, per group.
    struct alignas(64) ColumnCacheEntry {
        static constexpr std::size_t kMaxSloped = 6, kMaxShared = 3;
        std::uint32_t stack = kNoStack, tile = 0;
        std::int32_t heights[kMaxSloped] = {};
        std::uint32_t columns = 0;  // uses not counted yet, at most the columns of a tile
        std::uint16_t column = 0;
        std::uint8_t sharedCount = 0;
        struct Shared {
            std::uint32_t group, length;
        } shared[kMaxShared] = {};
    };
    static constexpr std::uint32_t kNoStack = 0xFFFFFFFFu;

    std::uint32_t findStack(const PlanInterval& interval);
    std::uint32_t addStack(const PlanInterval& interval, std::span<const std::uint64_t> members);
    void computeHeights(BoundaryStack& stack, std::int32_t i, std::int32_t j);
    void sortHeightPlanes(BoundaryStack& stack);
    void setSlopedHeights(BoundaryStack& stack, const std::int32_t* heights);
    void countShared(const BoundaryStack& stack, std::uint64_t columns);
    bool cacheShared(const BoundaryStack& stack, ColumnCacheEntry& known) const;
    void flushSharedCounts(ColumnCacheEntry& known);
    void clearCaches();

    void makeRows(std::int32_t firstRow, std::int32_t endRow);
    void makeInterval(const Interval& interval, std::int32_t y, std::int32_t firstRow, std::int32_t endRow);
    std::uint64_t computeLineHeights(const Interval& interval, const Line& line, std::uint32_t place);
    std::uint16_t columnAtStep(std::uint32_t number, std::uint32_t line, std::size_t step, std::uint64_t columns);
    std::uint16_t cacheColumn(std::uint32_t number, const std::int32_t* heights, ColumnCacheEntry& known,
                              std::uint64_t columns);
    std::uint16_t makeColumn(const BoundaryStack& stack);

    const HeightPlanes& heightPlanes_;
    Profiles profiles_;
    TilePlan plan_;
    volume::ColumnTileBuilder builder_;
    std::int32_t firstColumn_ = 0, firstRow_ = 0;
    std::uint32_t tile_ = 0;  // number of the current tile
    OverlapCounts counts_;
    std::vector<std::uint8_t> usedScalars_;

    std::vector<BoundaryStack> stacks_;
    HashIndex stackIndex_;
    std::vector<std::uint64_t> members_;
    std::vector<std::uint64_t> ascending_;  // sorted members of the stack being added
    std::vector<StackHeightPlane> stackHeightPlanes_;
    std::vector<std::uint32_t> stackCodes_;  // profile codes of the boundaries, by height plane
    std::vector<std::uint32_t> order_;       // slots of a stack, bottom up
    std::vector<SlopedHeightPlane> sloped_;
    std::vector<std::int32_t> heights_;
    std::vector<std::pair<std::int32_t, std::uint32_t>> sorted_;  // scratch: (height, slot) of one stack
    std::vector<std::uint32_t> codes_, places_;                   // scratch: codes bottom up; heights_ index by slot

    std::vector<Interval> intervals_;  // of the current row
    std::vector<std::uint16_t> row_;
    std::vector<std::int32_t> lines_;  // output of heightsAlong(), per line (sloped height planes + 1) * kTile numbers
    std::vector<LineHeightPlane> lineHeightPlanes_;
    std::vector<ColumnCacheEntry> columnCache_;
};

}  // namespace svt::voxelize
