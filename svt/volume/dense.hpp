#pragma once
/// \file
/// Converts columns to dense arrays: the whole volume, or box by box if it would not fit into memory.

#include <svt/core/result.hpp>
#include <svt/volume/column_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::volume {

/// Samples i in [iBegin, iEnd), j in [jBegin, jEnd), k in [kBegin, kEnd); by default whole rows.
struct DenseBox {
    static constexpr std::int32_t kRowEnd = -1;
    std::int32_t jBegin = 0;
    std::int32_t jEnd = 0;
    std::int32_t kBegin = 0;
    std::int32_t kEnd = 0;
    std::int32_t iBegin = 0;
    std::int32_t iEnd = kRowEnd;  ///< kRowEnd: nx
};

/// The largest scalar in the volume. Cost: O(runs).
[[nodiscard]] Scalar largestScalar(const ColumnVolume& columns) noexcept;

/// Copies the scalars of `box` to `out`, x fastest: out[(i - iBegin) + ni * ((j - jBegin) + nj * (k - kBegin))] with
/// ni = iEnd - iBegin and nj = jEnd - jBegin.
/// `T` is std::uint8_t, std::uint16_t or std::uint32_t and must hold every scalar; the box must lie inside the volume
/// and `out` must have exactly its size.
/// Cost: about 0.5 ns per sample and core, pages of new memory included. Prefer boxes of several k: each call searches
/// every column once.
/// \param threads  at most this many; 0: all cores. The result does not depend on it.
template <class T>
void copyBox(const ColumnVolume& columns, const DenseBox& box, std::span<T> out, int threads = 0);

/// The whole volume as a dense array, x fastest, then y, then z (index i + nx * (j + ny * k)).
/// \param maxBytes  limit for the size of the array
/// \return the array, or BadArgument if a scalar does not fit into `T`, or GridTooLarge if it would exceed `maxBytes`
template <class T>
[[nodiscard]] Result<std::vector<T>> toDense(const ColumnVolume& columns,
                                             std::uint64_t maxBytes = std::uint64_t{8} << 30, int threads = 0);

}  // namespace svt::volume
