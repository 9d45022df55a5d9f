#pragma once
/// \file
/// The plan of a tile: which faces and boxes lie over which of its columns (64 x 64 at most), seen from above.
///
///     y   +-----------------------+         one row of the tile, columns from west (0) to east (width):
///     ^   |      ,-------.        |
///     |   |   ,--+---.  2 \       |         covers   1  [3 ......... 10)
///     |  >|---|--|-1--\----\------|<                 2       [6 ............. 15)
///     |   |   `--+-----`   /      |       intervals  |     |   |        |      |       |
///     |   |      `--------'       |                  0     3   6        10     15      width
///     |   +-----------------------+         members   {}    {1}  {1, 2}   {2}    {}
///     +--------> x
///
/// - A cover is a boundary (of a face or a box) with one span of columns in each row. The spans come from scan
///   conversion of the outline of the face; edges between its triangles are skipped. An edge with winding +1 begins the
///   span of a row, one with -1 ends it. For edges west of the tile, only the sum of windings matters.
/// - Faces with several spans in a row (concave in x) fall back to the textbook scanline polygon fill. All crossings of
///   a row are sorted and paired by winding. The n-th span of each row goes to the n-th cover.
/// - Sets of rows are 64-bit masks, one bit per row. newRows() has the rows where some cover begins, ends or moves:
///   only these are laid out again (row coherence, as in scanline rendering).
/// - A row is cut into intervals at all ends of spans. The intervals of a row often have the same members as those of
///   the row laid out before, with other ends: such a row has the same boundaries, and its members are not collected
///   again.
/// - The members of an interval have an order-independent hash (a sum), by which the stacks of tile_columns.hpp are
///   found.

#include <svt/voxelize/lattice/faces.hpp>

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::voxelize {

/// A box of samples that one claim takes as a whole (from sheets, thin parts, winding fills): [firstRow, endRow) along
/// y, [begin, end) along x, [low, high) along z. It adds one to the winding number of the claim.
struct ClaimedBox {
    std::int32_t firstRow = 0, endRow = 0, begin = 0, end = 0, low = 0, high = 0;
    std::uint32_t claim = 0;
    bool countsAgainst = false;  ///< takes one from the winding number instead
    friend auto operator<=>(const ClaimedBox&, const ClaimedBox&) = default;
};

/// The faces and boxes of one object.
struct ObjectParts {
    FaceList faces;
    std::vector<ClaimedBox> boxes;
};

/// Reference to a triangle or a box of an object.
struct PartRef {
    std::uint32_t object = 0, number = 0;
};

/// A tile and the parts that touch it.
struct TileInput {
    std::int32_t firstColumn = 0, firstRow = 0, width = 0, height = 0, depth = 0;  ///< samples; width, height <= 64
    std::span<const ObjectParts> objects;
    std::span<const PartRef> triangles, boxes;  ///< those that touch the tile, by object, then by number
};

/// An interval of a row in which all columns have the same boundaries.
struct PlanInterval {
    std::int32_t begin = 0, end = 0;  ///< columns of the tile
    std::uint32_t firstMember = 0, memberCount = 0;
    std::uint64_t hash = 0;  ///< of its boundaries, independent of their order
};

/// Intervals of a row, west to east, without gaps.
struct PlanRowIntervals {
    std::span<const PlanInterval> intervals;
    /// Each interval has the boundaries of the same interval of the row laid out before.
    bool hasSameBoundaries = false;
};

/// Builds the plans of tiles, one after the other; keeps its buffers between them.
class TilePlan {
public:
    /// Starts a new tile and makes its covers. Cost: O(triangles + rows of slanted edges).
    void build(const TileInput& input);

    /// Bit y is set if the plan of row y may differ from that of row y - 1. Bit 0 is always set.
    [[nodiscard]] std::uint64_t newRows() const noexcept { return newRows_; }

    /// Intervals of row y, which must be one of newRows(). Valid until the next call.
    [[nodiscard]] PlanRowIntervals layOut(std::int32_t y);
    /// Packed boundaries of an interval of the last layOut(), unless its row has the same boundaries as that before.
    /// Their order, faces before boxes, each by object and number, is the same in all tiles.
    [[nodiscard]] std::span<const std::uint64_t> boundariesOf(const PlanInterval& interval) const noexcept {
        return std::span(members_).subspan(interval.firstMember, interval.memberCount);
    }

private:
    static constexpr std::size_t kTile = 64;

    // A boundary and one span of columns per row. Faces that are concave in x have several covers.
    struct Cover {
        std::uint64_t rows = 0;  // bit y: row y is covered over [begin[y], end[y]), which may be empty
        std::uint64_t boundary = 0;
        std::uint8_t begin[kTile], end[kTile];
    };
    // The cover of a box, with the same columns in all rows. Open surfaces have very many.
    struct BoxCover {
        std::uint64_t rows, boundary;
        std::uint8_t begin, end;
    };
    struct Member {
        std::uint64_t boundary, hash;
    };
    struct Span {
        std::uint32_t cover;
        std::uint8_t begin, end;  // columns
    };
    // The same with intervals [begin, end) instead of columns.
    struct IntervalSpan {
        std::uint32_t cover;
        std::uint8_t begin, end;
        friend bool operator==(const IntervalSpan&, const IntervalSpan&) = default;
    };
    // The cover of one face while its edges are added. Passing an edge eastwards changes the winding by +1 or -1.
    struct Outline {
        Cover cover = {};
        std::uint64_t westIn = 0, westOut = 0;  // rows with winding +1 and -1 from edges west of the tile
        std::uint64_t begun = 0, ended = 0;     // rows with an edge of winding +1 and -1 inside the tile
        std::uint64_t turns = 0;                // rows in which one of these edges begins, ends or moves
        bool isSimple = true;                   // no row has two edges of one sign
    };

    // An edge clipped to the rows [firstRow, endRow) of the tile; `first` and `last` bound its columns.
    struct PlacedEdge {
        std::int32_t firstRow, endRow, first, last;
        std::int32_t x0, y0, x1, y1;  // ends in quanta, y0 < y1
        bool isEntry;                 // winding +1, else -1
    };
    struct Crossing {
        std::uint8_t row, column;
        std::int8_t winding;
    };

    void addFace(const TileInput& input, std::span<const PartRef> triangles);
    static bool placeEdge(const TileInput& input, const FaceTriangle& triangle, int edge, bool facesDown,
                          PlacedEdge& out) noexcept;
    void addWest(std::uint64_t rows, bool isEntry);
    void addToOutline(const TileInput& input, const PlacedEdge& edge);
    void addConcaveFace(const TileInput& input, std::span<const PartRef> triangles, Boundary face);
    void addBox(const TileInput& input, const ClaimedBox& box);

    std::int32_t width_ = 0;
    std::uint64_t newRows_ = 0;
    Outline outline_;
    std::vector<Cover> covers_;
    std::vector<BoxCover> boxCovers_;   // numbered after covers_
    std::vector<Member> coverMembers_;  // per cover
    std::vector<Crossing> crossings_;
    std::vector<std::uint8_t> begins_;
    std::vector<Span> rows_[kTile];
    PlanInterval intervals_[kTile];  // intervals of the row laid out last, the first intervalCount_ are valid
    std::size_t intervalCount_ = 0;
    std::vector<IntervalSpan> intervalSpans_, previousSpans_;  // of the two rows laid out last
    std::vector<std::uint64_t> members_;
};

}  // namespace svt::voxelize
