#pragma once
/// \file
/// One tile of 64 x 64 columns seen from above: which faces lie over which columns. Rows whose plan is that of
/// the row before are told apart from those that must be laid out again.

#include <svt/voxelize/lattice/faces.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::voxelize {

/// Samples [firstRow, endRow) along y, [begin, end) along x, [low, high) along z, claimed as a whole (sheets, thin
/// parts, winding fills).
struct ClaimedBox {
    std::int32_t firstRow = 0, endRow = 0, begin = 0, end = 0, low = 0, high = 0;
    std::uint32_t claim = 0;
};

/// What one object brings.
struct ObjectParts {
    FaceList faces;
    std::vector<ClaimedBox> boxes;
};

/// A triangle or a box of an object.
struct PartNumber {
    std::uint32_t object = 0, number = 0;
};

/// What lies over a tile.
struct TileInput {
    std::int32_t firstColumn = 0, firstRow = 0, width = 0, height = 0, depth = 0;  ///< samples; width, height <= 64
    std::span<const ObjectParts> objects;
    std::span<const PartNumber> triangles, boxes;  ///< those that touch the tile, by objects, then ascending
};

/// A stretch of a row under the same boundaries.
struct PlanCell {
    std::int32_t begin = 0, end = 0;  ///< columns of the tile
    std::uint32_t firstMember = 0, memberCount = 0;
    std::uint64_t hash = 0;  ///< of its boundaries, in any order
};

/// Cells of a row, west to east, without gap.
struct PlanRow {
    std::span<const PlanCell> cells;
    bool keepsBoundaries = false;  ///< cell by cell the boundaries of the row laid out before; only stretches are new
};

/// Keeps its buffers between tiles.
class TilePlan {
public:
    /// Takes in what lies over a tile. Cost: O(triangles + rows of slanted edges).
    void build(const TileInput& input);

    /// Bit y: the plan of row y may differ from that of the row before. Bit 0 is set.
    [[nodiscard]] std::uint64_t newRows() const noexcept { return newRows_; }

    /// Row y, which is one of newRows(). Valid until the next call.
    [[nodiscard]] PlanRow layOut(std::int32_t y);
    /// Boundaries of a cell of the last layOut(), unless its row kept them: packed, in the order of faces, then boxes,
    /// in all tiles.
    [[nodiscard]] std::span<const std::uint64_t> boundariesOf(const PlanCell& cell) const noexcept {
        return std::span(members_).subspan(cell.firstMember, cell.memberCount);
    }

private:
    static constexpr std::size_t kTile = 64;

    // Where a boundary is: in each row over one stretch of columns. Concave faces have several.
    struct Cover {
        std::uint64_t rows = 0;  // bit y: [begin[y], end[y]) is covered; may be empty
        std::uint64_t boundary = 0;
        std::uint8_t begin[kTile], end[kTile];
    };
    struct Member {
        std::uint64_t boundary, hash;
    };
    struct Span {
        std::uint32_t cover;
        std::uint8_t begin, end;  // columns
    };
    // The same in cells instead of columns.
    struct CellSpan {
        std::uint32_t cover;
        std::uint8_t begin, end;
        friend bool operator==(const CellSpan&, const CellSpan&) = default;
    };
    // The cover of one face while its edges come. Passing an edge to the east adds its winding to the cover.
    struct Outline {
        Cover cover = {};
        std::uint64_t westIn = 0, westOut = 0;  // rows with winding 1 and -1 to the west of the tile
        std::uint64_t begun = 0, ended = 0;     // rows with an edge of winding 1 and -1 within the tile
        std::uint64_t turns = 0;                // rows in which one of these begins, ends or moves
        bool isSimple = true;                   // no row has two of either
    };

    // An edge as far as it matters to the tile: over rows [firstRow, endRow) of it, between columns first and last.
    struct PlacedEdge {
        std::int32_t firstRow, endRow, first, last;
        std::int32_t x0, y0, x1, y1;  // quanta, to the north
        bool isEntry;                 // winding 1, else -1
    };
    struct Crossing {
        std::uint8_t row, column;
        std::int8_t winding;
    };

    void addFace(const TileInput& input, std::span<const PartNumber> triangles);
    static bool placeEdge(const TileInput& input, const FaceTriangle& triangle, int edge, bool looksDown,
                          PlacedEdge& out) noexcept;
    void addWest(std::uint64_t rows, bool isEntry);
    void addToOutline(const TileInput& input, const PlacedEdge& edge);
    void addConcaveFace(const TileInput& input, std::span<const PartNumber> triangles, Boundary face);
    void addBox(const TileInput& input, const ClaimedBox& box);

    std::int32_t width_ = 0;
    std::uint64_t newRows_ = 0;
    Outline outline_;
    std::vector<Cover> covers_;
    std::vector<Member> coverMembers_;  // per cover
    std::vector<Crossing> crossings_;
    std::vector<std::uint8_t> begins_;
    std::vector<Span> rows_[kTile];
    PlanCell cells_[kTile];  // of the row laid out last, the first cellCount_
    std::size_t cellCount_ = 0;
    std::vector<CellSpan> cellSpans_, previousSpans_;  // of the rows laid out last
    std::vector<std::uint64_t> members_;
};

}  // namespace svt::voxelize
