#pragma once
/// \file
/// One tile of 64 x 64 columns: from boundaries over its plan to columns of labelled runs. A cell of the plan has a
/// stack of boundaries; their levels have an order and with it a profile; a column is that profile at its heights.

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

/// Makes the columns of tiles; keeps its buffers between them. One per thread.
class TileColumns {
public:
    TileColumns(std::span<const OrderedClaim> claims, const LevelTable& levels);

    [[nodiscard]] volume::ColumnTileData make(const TileInput& input);

    /// Voxels that two solids share in all tiles made since the last call.
    [[nodiscard]] SharedCounts takeCounts();
    /// Per scalar, 1: some voxel of the tiles made so far has it. Scalars that no claim has are not told.
    [[nodiscard]] std::span<const std::uint8_t> isPresent() const noexcept { return isPresent_; }

private:
    static constexpr std::size_t kTile = kLineSamples;

    // The boundaries over a cell, by levels, in the order in which the last column met them. Cells with the same
    // boundaries share one, in all tiles.
    struct Stack {
        std::uint64_t hash = 0;
        std::uint32_t firstMember = 0, memberCount = 0;  // of members_
        std::uint32_t firstLevel = 0, levelCount = 0;    // of stackLevels_ and order_
        std::uint32_t firstSloped = 0, slopedCount = 0;  // of sloped_
        std::uint32_t firstHeight = 0;                   // of heights_: 0, those of the levels bottom up, depth
        std::uint32_t profile = 0;
        std::uint32_t tile = 0;    // whose column is known:
        std::uint16_t column = 0;  // of a stack without slopes
        bool isOrdered = false, slopesX = false, slopesY = false;
    };
    struct StackLevel {
        std::uint32_t level, firstCode, codeCount;  // of stackCodes_
    };
    struct SlopedLevel {
        std::uint32_t level, slot, height;  // slot: number within the stack; height: its place in heights_
    };
    struct Cell {
        std::int32_t begin = 0, end = 0;
        std::uint32_t stack = 0;
        std::uint32_t line = 0;    // of lines_: along y, where it slopes that way alone
        std::uint64_t breaks = 0;  // bit i: row i of the line differs from the one before
    };
    // Columns side by side along x, or rows along y; samples of the grid.
    struct Line {
        std::int32_t i, j, count;
        bool isAlongX;
    };

    // Columns made lately, by their stack and the heights of its sloped levels, with what solids share in each.
    struct alignas(64) KnownColumn {
        static constexpr std::size_t kMostSloped = 6, kMostShared = 3;
        std::uint32_t stack = kNoStack, tile = 0;
        std::int32_t heights[kMostSloped] = {};
        std::uint32_t columns = 0;  // found again and not counted yet, at most a tile's
        std::uint16_t column = 0;
        std::uint8_t sharedCount = 0;
        struct Shared {
            std::uint32_t group, length;
        } shared[kMostShared] = {};
    };
    static constexpr std::uint32_t kNoStack = 0xFFFFFFFFu;

    std::uint32_t findStack(const PlanCell& cell);
    std::uint32_t addStack(const PlanCell& cell, std::span<const std::uint64_t> members);
    void beginStack(Stack& stack, std::int32_t i, std::int32_t j);
    void orderStack(Stack& stack);
    void moveStack(Stack& stack, const std::int32_t* heights);
    void countShared(const Stack& stack, std::uint64_t columns);
    bool measureShared(const Stack& stack, KnownColumn& known) const;
    void countKnown(KnownColumn& known);
    void forget();

    void makeRows(std::int32_t firstRow, std::int32_t endRow);
    void makeCell(const Cell& cell, std::int32_t y, std::int32_t firstRow, std::int32_t endRow);
    std::uint64_t measureLine(const Cell& cell, const Line& line, std::uint32_t place);
    std::uint16_t findStep(std::uint32_t number, std::uint32_t line, std::size_t step, std::uint64_t columns);
    std::uint16_t makeStep(std::uint32_t number, const std::int32_t* heights, KnownColumn& known,
                           std::uint64_t columns);
    std::uint16_t makeColumn(const Stack& stack);

    const LevelTable& levels_;
    Profiles profiles_;
    TilePlan plan_;
    volume::ColumnTileBuilder builder_;
    std::int32_t firstColumn_ = 0, firstRow_ = 0;
    std::uint32_t tile_ = 0;  // counts the tiles
    SharedCounts counts_;
    std::vector<std::uint8_t> isPresent_;

    std::vector<Stack> stacks_;
    HashIndex stackIndex_;
    std::vector<std::uint64_t> members_;
    std::vector<std::uint64_t> ascending_;  // members of a stack that is added
    std::vector<StackLevel> stackLevels_;
    std::vector<std::uint32_t> stackCodes_;  // of the boundaries, level by level
    std::vector<std::uint32_t> order_;       // slots, bottom up
    std::vector<SlopedLevel> sloped_;
    std::vector<std::int32_t> heights_;
    std::vector<std::pair<std::int32_t, std::uint32_t>> sorted_;  // of one stack: height and slot
    std::vector<std::uint32_t> codes_, places_;                   // of one stack: codes bottom up; per slot

    std::vector<Cell> cells_;  // of the current row
    std::vector<std::uint16_t> row_;
    std::vector<std::int32_t> lines_;  // as heightsAlong() makes them, kTile numbers for each level and one more
    std::vector<LineLevel> lineLevels_;
    std::vector<KnownColumn> known_;
};

}  // namespace svt::voxelize
