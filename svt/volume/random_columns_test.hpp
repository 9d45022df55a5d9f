#pragma once
/// \file
/// Columns with content that is hard to code: slopes, oblique walls, noise, repeated rows.

#include <svt/volume/column_volume.hpp>

#include <random>
#include <vector>

namespace svt::volume::test {

inline constexpr Scalar kRandomScalars = 40;

/// A volume of half-spaces, boxes and speckles that depend on `seed` alone; scalars below kRandomScalars.
inline ColumnVolume randomColumns(Vec3i dimension, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::uint32_t count) { return static_cast<std::int32_t>(random() % count); };
    const auto nx = std::size_t(dimension.x), ny = std::size_t(dimension.y), nz = std::size_t(dimension.z);
    std::vector<Scalar> dense(nx * ny * nz, 0);
    const auto paint = [&](const auto& isInside, Scalar scalar) {
        for (std::size_t k = 0; k < nz; ++k)
            for (std::size_t j = 0; j < ny; ++j)
                for (std::size_t i = 0; i < nx; ++i)
                    if (isInside(std::int32_t(i), std::int32_t(j), std::int32_t(k)))
                        dense[i + nx * (j + ny * k)] = scalar;
    };
    const std::int32_t shapes = 2 + below(10);
    for (std::int32_t shape = 0; shape < shapes; ++shape) {
        const auto scalar = static_cast<Scalar>(below(kRandomScalars));
        if (below(2) == 0) {
            const std::int32_t a = below(21) - 10, b = below(21) - 10, c = below(21) - 10;
            const std::int32_t d = a * below(std::uint32_t(dimension.x)) + b * below(std::uint32_t(dimension.y)) +
                                   c * below(std::uint32_t(dimension.z));
            const std::int32_t thickness = 1 + below(200);
            paint(
                [&](std::int32_t i, std::int32_t j, std::int32_t k) {
                    const std::int32_t at = a * i + b * j + c * k - d;
                    return at >= 0 && at < thickness;
                },
                scalar);
        } else {
            const Vec3i from{below(std::uint32_t(dimension.x)), below(std::uint32_t(dimension.y)),
                             below(std::uint32_t(dimension.z))};
            const Vec3i size{1 + below(100), 1 + below(100), 1 + below(100)};
            paint(
                [&](std::int32_t i, std::int32_t j, std::int32_t k) {
                    return i >= from.x && j >= from.y && k >= from.z && i < from.x + size.x && j < from.y + size.y &&
                           k < from.z + size.z;
                },
                scalar);
        }
    }
    for (std::int32_t speckle = below(3) * below(2000); speckle > 0; --speckle)
        dense[random() % dense.size()] = static_cast<Scalar>(below(kRandomScalars));
    return ColumnVolume::fromDense(dimension, dense);
}

/// Whether `tile` is valid for column() and scalarAt(), and holds nothing unused.
inline bool isCanonical(const ColumnTileData& tile, std::size_t width, std::size_t height, std::uint32_t nz,
                        Scalar scalarCount) {
    if (tile.rowOf.size() != height || tile.rowColumns.size() % width != 0 || tile.columnStart.empty() ||
        tile.columnStart.front() != 0 || tile.columnStart.back() != tile.runs.size())
        return false;
    std::size_t rows = 0, columns = 0;
    for (const std::uint8_t row : tile.rowOf) {
        if (row > rows) return false;
        rows += row == rows ? 1 : 0;
    }
    for (const std::uint16_t column : tile.rowColumns) {
        if (column > columns) return false;
        columns += column == columns ? 1 : 0;
    }
    if (rows * width != tile.rowColumns.size() || columns + 1 != tile.columnStart.size()) return false;
    for (std::size_t c = 0; c < columns; ++c) {
        std::uint32_t top = 0;
        for (std::uint32_t r = tile.columnStart[c]; r < tile.columnStart[c + 1]; ++r) {
            const Run& run = tile.runs[r];
            if (run.end <= top || run.scalar >= scalarCount) return false;
            if (r > tile.columnStart[c] && run.scalar == tile.runs[r - 1].scalar) return false;
            top = run.end;
        }
        if (top != nz) return false;
    }
    return true;
}

}  // namespace svt::volume::test
