#pragma once
/// \file
/// One tile of 64 x 64 columns seen from above: which faces lie over which columns. Rows whose plan is that of
/// the row before are told apart from those that must be laid out again.

#include <svt/voxelize/faces.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace svt::voxelize {

/// Samples [firstRow, endRow) along y, [begin, end) along x, [low, high) along z, claimed as a whole (sheets, thin
/// parts, winding fills).
struct ClaimedBox {
    std::int32_t firstRow = 0, endRow = 0, begin = 0, end = 0, low = 0, high = 0;
    std::uint32_t claim = 0;
};

/// What lies over a tile.
struct TileInput {
    std::int32_t firstColumn = 0, firstRow = 0, width = 0, height = 0, depth = 0;  ///< samples; width, height <= 64
    std::span<const ScanFace> faces;
    std::span<const FaceTriangle> triangles;
    std::span<const std::uint32_t> triangleIndices;  ///< those that touch the tile, ascending
    std::span<const ClaimedBox> boxes;
    std::span<const std::uint32_t> boxIndices;  ///< those that touch the tile
};

/// The crossings of one claim's boundary: which one, and in which direction.
struct BoundaryCode {
    std::uint32_t claim = 0;
    bool isEntry = false;
    [[nodiscard]] std::uint32_t packed() const noexcept { return claim << 1 | std::uint32_t(isEntry); }
    [[nodiscard]] static BoundaryCode unpack(std::uint32_t code) noexcept { return {code >> 1, (code & 1) != 0}; }
};

/// A face over the columns of a tile.
struct TileFace {
    static constexpr int kBits = Height::kBits + kQuantaBits;
    std::int64_t base, slopeX, slopeY;  ///< first sample above (x, y) of the tile: base + slopeX x + slopeY y >> kBits,
    std::int32_t lowest, highest;       ///< clamped to these, which lie within [0, depth]
    std::uint32_t code;                 ///< a packed BoundaryCode

    /// First sample above the face, 0 to depth.
    [[nodiscard]] std::int32_t sampleAbove(std::int32_t x, std::int32_t y) const noexcept {
        return clamped(base + slopeX * x + slopeY * y);
    }
    [[nodiscard]] std::int32_t clamped(std::int64_t height) const noexcept {
        const std::int64_t k = height >> kBits;
        return static_cast<std::int32_t>(k < lowest ? lowest : k > highest ? highest : k);
    }
};

/// A stretch of a row under the same faces.
struct PlanCell {
    std::int32_t begin = 0, end = 0;  ///< columns of the tile
    std::uint32_t firstMember = 0, faceCount = 0;
    std::uint64_t hash = 0;  ///< of its faces
};

/// Keeps its buffers between tiles.
class TilePlan {
public:
    /// Takes in what lies over a tile. Cost: O(triangles + rows of slanted edges).
    void build(const TileInput& input);

    [[nodiscard]] std::span<const TileFace> faces() const noexcept { return faces_; }
    /// Bit y: the plan of row y may differ from that of the row before. Bit 0 is set.
    [[nodiscard]] std::uint64_t newRows() const noexcept { return newRows_; }
    /// Bit y: a face over row y slopes along y.
    [[nodiscard]] std::uint64_t slopedRows() const noexcept { return slopedRows_; }

    /// Cells of row y, which is one of newRows(); west to east, without gap. Valid until the next call.
    [[nodiscard]] std::span<const PlanCell> layOut(std::int32_t y);
    /// Faces of a cell of the last layOut(), ascending numbers.
    [[nodiscard]] std::span<const std::uint32_t> facesOf(const PlanCell& cell) const noexcept {
        return std::span(members_).subspan(cell.firstMember, cell.faceCount);
    }

private:
    static constexpr std::size_t kTile = 64;

    // What a face covers: in each row one stretch of columns. Concave ones have several.
    struct Cover {
        std::uint64_t rows = 0;  // bit y: [begin[y], end[y]) is covered; may be empty
        std::uint32_t face = 0;
        std::uint8_t faceCount = 1;  // 2: the next face lies over the same columns (top of a box)
        std::uint8_t begin[kTile], end[kTile];
    };
    struct Span {
        std::uint32_t face;
        std::uint8_t begin, end, faceCount;
    };
    // The cover of one face while its edges come. Passing an edge to the east adds its winding to the cover.
    struct Outline {
        Cover cover;
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

    void addFace(const TileInput& input, std::span<const std::uint32_t> triangles);
    static bool placeEdge(const TileInput& input, const FaceTriangle& triangle, int edge, bool looksDown,
                          PlacedEdge& out) noexcept;
    static std::pair<std::int32_t, std::int32_t> rowsWithin(const TileInput& input, const PlacedEdge& edge) noexcept;
    void addWest(std::uint64_t rows, bool isEntry);
    void addToOutline(const TileInput& input, const PlacedEdge& edge);
    void addConcaveFace(const TileInput& input, std::span<const std::uint32_t> triangles, bool looksDown);
    void addBox(const TileInput& input, const ClaimedBox& box);

    std::int32_t width_ = 0;
    std::uint64_t newRows_ = 0, slopedRows_ = 0;
    std::vector<TileFace> faces_;
    std::vector<std::uint64_t> faceHashes_;
    Outline outline_;
    std::vector<Cover> covers_;  // ascending by face
    std::vector<Crossing> crossings_;
    std::vector<std::uint8_t> begins_;
    std::vector<Span> rows_[kTile];
    std::vector<PlanCell> cells_;
    std::vector<std::uint32_t> members_;
};

}  // namespace svt::voxelize
