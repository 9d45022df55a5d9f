#pragma once
/// \file
/// One tile of 64 x 64 columns: from faces over its plan to columns of labelled runs. Cells of the plan
/// have stacks of faces, stacks have an order and with it a profile; a column is that profile at its heights.

#include <svt/volume/column_volume.hpp>
#include <svt/voxelize/profiles.hpp>
#include <svt/voxelize/tile_plan.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace svt::voxelize {

/// Makes the columns of tiles; keeps its buffers between them. One per thread.
class TileColumns {
public:
    explicit TileColumns(std::span<const OrderedClaim> claims) : profiles_(claims), builder_(1) {}

    [[nodiscard]] volume::ColumnTileData make(const TileInput& input);

    /// Appends the voxels that two solids share in all tiles made so far (unordered, pairs may repeat).
    void takeCounts(std::vector<SharedCount>& counts);

private:
    // The faces over a cell, in the order in which the last column met them. Cells with the same faces share one.
    struct Stack {
        std::uint64_t hash = 0;
        std::uint32_t first = 0, count = 0;              // of members_ and order_
        std::uint32_t firstHeight = 0;                   // of heights_: 0, those of the faces bottom up, depth
        std::uint32_t firstSloped = 0, slopedCount = 0;  // of sloped_
        std::uint32_t profile = 0;
        std::uint16_t column = 0;  // the last one made
        bool isMade = false, slopesX = false, slopesY = false;
    };
    struct SlopedFace {
        std::uint32_t face, member, height;  // height: its place in heights_
    };
    struct Cell {
        std::int32_t begin = 0, end = 0;
        std::uint32_t stack = 0;
    };

    void layOutRow(std::int32_t y);
    std::uint32_t findStack(const PlanCell& cell);
    std::uint32_t addStack(const PlanCell& cell, std::span<const std::uint32_t> faces);
    void makeCell(const Cell& cell, std::int32_t y, std::uint64_t rows);
    void makeSlopedCell(const Cell& cell, std::int32_t y, std::uint64_t rows);
    void makeColumn(Stack& stack, bool isMoved, std::uint64_t columns);
    void beginStack(Stack& stack, std::int32_t x, std::int32_t y);
    void orderStack(Stack& stack);

    Profiles profiles_;
    TilePlan plan_;
    volume::ColumnTileBuilder builder_;
    std::int32_t depth_ = 0;
    std::vector<Stack> stacks_;
    std::vector<std::uint32_t> stackTable_;  // open addressing: stack + 1, 0 = free
    std::vector<std::uint32_t> members_;     // of all stacks: faces, ascending
    std::vector<std::uint32_t> order_;       // of all stacks: numbers of members, bottom up
    std::vector<std::int32_t> heights_;      // of all stacks
    std::vector<SlopedFace> sloped_;         // of all stacks
    std::vector<Cell> cells_;                // of the current row
    std::vector<std::uint16_t> row_;
    std::vector<std::pair<std::int32_t, std::uint32_t>> pairs_;  // of one stack: height and member
    std::vector<std::uint32_t> codes_, places_;                  // of one stack, per crossing and per member
    std::vector<std::int32_t> slopedHeights_;                    // of one cell, 64 for each face that slopes
    std::vector<volume::Run> runs_;
};

}  // namespace svt::voxelize
