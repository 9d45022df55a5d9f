#pragma once
/// \file
/// One tile of 64 x 64 columns: from faces over its plan to columns of labelled runs. Cells of the plan
/// have stacks of faces, stacks have an order and with it a profile; a column is that profile at its heights.

#include <svt/volume/column_volume.hpp>
#include <svt/voxelize/profiles.hpp>
#include <svt/voxelize/tile_plan.hpp>

#include <cstdint>
#include <span>
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
    // The faces over a cell, and in which order the last column met them. Cells with the same faces share one.
    struct Stack {
        std::uint64_t hash = 0;
        std::uint32_t first = 0, count = 0;  // of members_ and order_
        std::uint32_t profile = 0;
        bool isOrdered = false, slopesX = false, slopesY = false;
    };
    struct Cell {
        std::int32_t begin = 0, end = 0;
        std::uint32_t stack = 0;
    };

    void layOutRow(std::int32_t y);
    std::uint32_t findStack(const PlanCell& cell);
    void makeCell(const Cell& cell, std::int32_t y, std::uint64_t rows);
    void makeSlopedCell(const Cell& cell, std::int32_t y, std::uint64_t rows);
    [[nodiscard]] std::uint16_t makeColumn(Stack& stack, std::uint64_t columns);
    [[nodiscard]] bool sortHeights(const Stack& stack) noexcept;
    void orderStack(Stack& stack);

    Profiles profiles_;
    TilePlan plan_;
    volume::ColumnTileBuilder builder_;
    std::int32_t depth_ = 0;
    std::vector<Stack> stacks_;
    std::vector<std::uint32_t> stackTable_;  // open addressing: stack + 1, 0 = free
    std::vector<std::uint32_t> members_;     // faces of all stacks, ascending
    std::vector<std::uint32_t> order_;       // of all stacks: numbers of members, bottom up
    std::vector<Cell> cells_;                // of the current row
    std::vector<std::uint16_t> row_;
    // Of one cell:
    std::vector<std::int32_t> heights_;         // per member: first sample above
    std::vector<std::int32_t> sortedHeights_;   // per crossing, bottom up; the grid's depth at the end
    std::vector<std::uint32_t> codes_;          // per crossing
    std::vector<std::uint32_t> slopedMembers_;  // that slope along x
    std::vector<std::int32_t> slopedHeights_;   // 64 each
    std::vector<volume::Run> runs_;
};

}  // namespace svt::voxelize
