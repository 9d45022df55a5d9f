#pragma once
/// \file
/// Scan conversion of triangles: which sample lines along one axis cross a triangle, and at which height.
/// The code is for lines along z; for the other axes, the coordinates are permuted.

#include <svt/voxelize/lattice/index_mesh.hpp>

#include <cstdint>

namespace svt::voxelize {

/// Height over (x, y) in fixed point: z(i, j) = base + slopeX * i + slopeY * j, in units of 2^-kBits quanta, (i, j) in
/// samples.
struct Height {
    static constexpr int kBits = 20;
    std::int64_t base = 0;
    std::int64_t slopeX = 0;
    std::int64_t slopeY = 0;
    [[nodiscard]] bool isFlat() const noexcept { return slopeX == 0 && slopeY == 0; }
};

/// A triangle ready for scan conversion. Its corners are sorted by y.
struct ScanTriangle {
    std::int32_t x[3], y[3];        ///< quanta
    std::int32_t firstRow, endRow;  ///< rows (samples along y) with firstRow <= j < endRow
    std::int32_t firstColumn, endColumn;
    std::int32_t lowest, highest;  ///< first sample above its lowest and highest corner; heights are clamped to it
    Height height;
    std::int8_t sign = 0;        ///< winding change of an upward line: +1 enters (face looks down), -1 leaves
    bool isMiddleRight = false;  ///< corner 1 lies right of the edge from corner 0 to corner 2
};

/// First sample strictly above the height at (i, j).
[[nodiscard]] inline std::int32_t sampleAbove(const ScanTriangle& t, std::int64_t heightAt) noexcept {
    // Sample k is at quanta 512 k + 1.
    const std::int64_t one = std::int64_t{1} << Height::kBits;
    const std::int64_t k = ((heightAt - one) >> (Height::kBits + kQuantaBits)) + 1;
    return static_cast<std::int32_t>(k < t.lowest ? t.lowest : k > t.highest ? t.highest : k);
}

/// Maps axes of index space to the roles x (along a row), y (from row to row) and z (along the sample lines).
struct ScanAxes {
    std::size_t x = 0, y = 1, z = 2;
    bool isMirrored = false;  ///< an odd permutation
};

/// Axes for sample lines along x, y and z. For lines along x or y the rows run along z, so that vertical sheets give
/// long runs.
inline constexpr ScanAxes kScanAxes[3] = {{2, 1, 0, true}, {2, 0, 1, false}, {0, 1, 2, false}};

/// Height function of a face, and the sample range to which it is clamped.
struct FaceHeight {
    Height height;
    std::int32_t lowest = 0, highest = 0;  ///< first sample above its lowest and highest corner; unlimited for a plane
};

/// Heights over the triangle a, b, c, which must not be vertical (parallel to `axes.z`).
[[nodiscard]] FaceHeight triangleHeight(const QuantaPoint& a, const QuantaPoint& b, const QuantaPoint& c,
                                        const ScanAxes& axes) noexcept;

/// Heights over a plane in index space (quanta of z per voxel), for lines along z; not clamped.
[[nodiscard]] FaceHeight planeHeight(const mesh::Plane& plane) noexcept;

/// True if faces on `plane` take their heights from it; false if it is too steep (over 64 voxels up per voxel along).
[[nodiscard]] bool isScanPlane(const mesh::Plane& plane) noexcept;

/// Sets up the triangle with corners a, b, c for scanning.
/// \return false if the triangle crosses no sample line
[[nodiscard]] bool setUpScan(const QuantaPoint& a, const QuantaPoint& b, const QuantaPoint& c, const ScanAxes& axes,
                             ScanTriangle& out) noexcept;

/// Calls `body(j, begin, end)` for each row of `t` within [firstRow, endRow), with the samples [begin, end) that it
/// covers within [firstColumn, endColumn). Exact and half-open: two triangles with a common edge neither overlap nor
/// leave a gap.
template <class Body>
void scanRows(const ScanTriangle& t, std::int32_t firstRow, std::int32_t endRow, std::int32_t firstColumn,
              std::int32_t endColumn, Body&& body);

/// Walks along an edge from row to row and gives the first sample at or right of it. Exact: an integer DDA that carries
/// the remainder, like Bresenham's line algorithm.
class EdgeWalk {
public:
    EdgeWalk(std::int32_t x0, std::int32_t y0, std::int32_t x1, std::int32_t y1, std::int32_t row) noexcept {
        const std::int64_t dx = std::int64_t(x1) - x0, dy = std::int64_t(y1) - y0;
        denominator_ = dy * kQuanta;
        // ceil(((x - 1) * dy + (rowY - y0) * dx) / (512 dy)), rowY = 512 row + 1
        const std::int64_t numerator = (std::int64_t(x0) - 1) * dy + (std::int64_t(row) * kQuanta + 1 - y0) * dx;
        sample_ = floorDivide(numerator + denominator_ - 1, denominator_);
        remainder_ = numerator + denominator_ - 1 - sample_ * denominator_;
        step_ = floorDivide(dx * kQuanta, denominator_);
        remainderStep_ = dx * kQuanta - step_ * denominator_;
    }
    [[nodiscard]] std::int64_t sample() const noexcept { return sample_; }
    /// Remainder, 0 to denominator() - 1, in units of 1/denominator() sample. One row adds step() and remainderStep().
    [[nodiscard]] std::int64_t remainder() const noexcept { return remainder_; }
    [[nodiscard]] std::int64_t denominator() const noexcept { return denominator_; }
    [[nodiscard]] std::int64_t step() const noexcept { return step_; }
    [[nodiscard]] std::int64_t remainderStep() const noexcept { return remainderStep_; }
    void nextRow() noexcept {
        sample_ += step_;
        remainder_ += remainderStep_;
        if (remainder_ >= denominator_) {
            remainder_ -= denominator_;
            ++sample_;
        }
    }

private:
    static std::int64_t floorDivide(std::int64_t a, std::int64_t b) noexcept {
        const std::int64_t q = a / b;
        return q - ((a % b != 0) && (a < 0));
    }
    std::int64_t denominator_, sample_, remainder_, step_, remainderStep_;
};

template <class Body>
void scanRows(const ScanTriangle& t, std::int32_t firstRow, std::int32_t endRow, std::int32_t firstColumn,
              std::int32_t endColumn, Body&& body) {
    firstRow = firstRow > t.firstRow ? firstRow : t.firstRow;
    endRow = endRow < t.endRow ? endRow : t.endRow;
    if (firstRow >= endRow) return;
    // Rows below the middle corner use edge 0-1, rows above it edge 1-2; the long edge 0-2 is on the other side.
    const auto middle = static_cast<std::int32_t>(firstSampleAbove(t.y[1]));
    EdgeWalk longEdge(t.x[0], t.y[0], t.x[2], t.y[2], firstRow);
    const auto part = [&](std::int32_t begin, std::int32_t end, int from) {
        if (begin >= end) return;
        EdgeWalk shortEdge(t.x[from], t.y[from], t.x[from + 1], t.y[from + 1], begin);
        for (std::int32_t j = begin; j < end; ++j) {
            const std::int64_t left = t.isMiddleRight ? longEdge.sample() : shortEdge.sample();
            const std::int64_t right = t.isMiddleRight ? shortEdge.sample() : longEdge.sample();
            const auto low = static_cast<std::int32_t>(left > firstColumn ? left : firstColumn);
            const auto high = static_cast<std::int32_t>(right < endColumn ? right : endColumn);
            if (low < high) body(j, low, high);
            longEdge.nextRow();
            shortEdge.nextRow();
        }
    };
    part(firstRow, middle < endRow ? middle : endRow, 0);
    part(middle > firstRow ? middle : firstRow, endRow, 1);
}

}  // namespace svt::voxelize
