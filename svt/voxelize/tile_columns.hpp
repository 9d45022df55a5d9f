#pragma once
/// \file
/// One tile of 64 x 64 columns from the crossings of all claims: the sweep that turns signed
/// crossings into labelled runs, settles overlaps by priority and shares equal columns and rows.

#include <svt/volume/column_volume.hpp>
#include <svt/voxelize/scan.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::voxelize {

/// A claim in order of priority: index 0 wins over all others.
struct OrderedClaim {
    volume::Scalar scalar = 0;
    std::uint32_t object = 0;
    bool isSolid = false;  ///< counts in overlaps; sheets and thin parts do not
};

/// Samples [begin, end) along x in row j, [low, high) along z, claimed as a whole (sheets, thin parts, winding fills).
struct ClaimedBox {
    std::int32_t j = 0, begin = 0, end = 0, low = 0, high = 0;
    std::uint32_t claim = 0;
};

/// Voxels that two claims share.
struct SharedCount {
    std::uint32_t first = 0, second = 0;  ///< orders, first < second
    std::uint64_t voxels = 0;
};

struct TileInput {
    std::int32_t firstColumn = 0, firstRow = 0, width = 0, height = 0, depth = 0;  ///< samples
    std::span<const ScanTriangle> triangles;
    std::span<const std::uint32_t> triangleIndices;  ///< those that touch the tile
    std::span<const ClaimedBox> boxes;  ///< those of the tile's rows, by row; may reach over the tile's sides
    std::span<const OrderedClaim> claims;
};

/// Makes the columns of one tile; keeps its buffers between tiles. One per thread.
class TileColumns {
public:
    /// Shared voxels are added to `shared` (unordered, pairs may repeat).
    [[nodiscard]] volume::ColumnTileData make(const TileInput& input, std::vector<SharedCount>& shared);

private:
    // A stretch of a row over which one claim's boundary is crossed, at one height or along one plane.
    struct Span {
        std::uint64_t key;             // claim, sign, flatK: what most spans are told apart by (see keyOf)
        std::int64_t slope, base;      // Height along the row: base + slope * column; 0 where flat
        std::int32_t lowest, highest;  // clamp of a steep face
        std::int32_t begin, end;       // columns of the tile
        [[nodiscard]] std::uint32_t claim() const noexcept { return static_cast<std::uint32_t>(key >> 33); }
        [[nodiscard]] bool isEntry() const noexcept { return (key >> 32 & 1) != 0; }
        [[nodiscard]] std::int32_t flatK() const noexcept { return static_cast<std::int32_t>(key & 0xFFFFFFFFu); }
        friend bool operator==(const Span&, const Span&) = default;
    };
    static std::uint64_t keyOf(std::uint32_t claim, bool isEntry, std::int32_t flatK) noexcept {
        return std::uint64_t(claim) << 33 | std::uint64_t(isEntry) << 32 | static_cast<std::uint32_t>(flatK);
    }

    void collectSpans(const TileInput& input);
    void mergeSpans(std::vector<Span>& spans);
    void addRow(const TileInput& input, const std::vector<Span>& spans, std::vector<SharedCount>& shared);
    void sweepColumn(const TileInput& input, std::uint64_t columns);
    void changeWinding(std::uint32_t claim, bool isEntry);

    std::vector<Span> rows_[volume::ColumnVolume::kTileSize];
    std::vector<std::int32_t> heights_;     // of the row's sloped spans, width each
    std::vector<std::uint64_t> crossings_;  // of a column: sample above, claim, entry (1 bit)
    std::vector<volume::Run> runs_;
    std::vector<std::uint16_t> row_;
    std::vector<std::uint32_t> active_;  // orders with winding > 0, ascending
    std::vector<std::int32_t> winding_;  // per order
    std::vector<SharedCount> rowShared_;
    volume::ColumnTileBuilder* builder_ = nullptr;
};

}  // namespace svt::voxelize
