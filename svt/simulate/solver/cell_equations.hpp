#pragma once
/// \file
/// The linear equations of heat conduction between cells of a grid, stored by columns and runs of cells.
///
///     column    cells of one (i, j), bottom up; columns with i fastest
///     run       cells on top of each other without a gap
///     cell      1 .. count, in the order of columns; 0 and count + 1 are cells without conductance, so that loops need no
///               branches at borders

#include <svt/core/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::simulate {

/// Cells `first` to `first + count - 1` at heights k, k + 1, ...
struct CellRun {
    std::uint32_t first = 0, count = 0;
    std::int32_t k = 0;
};

/// Sum over neighbours v of g (x_u - x_v) + toZones x_u = b_u for each cell u. The matrix is symmetric and positive
/// semi-definite.
struct CellEquations {
    std::int32_t columnsX = 0, columnsY = 0;
    std::uint32_t count = 0;               ///< of cells
    std::vector<std::size_t> columnStart;  ///< of each column: its first run; one more at the end
    std::vector<CellRun> runs;             ///< ascending k in each column; runs of a column do not touch
    std::array<std::vector<std::uint32_t>, 2> next,
        previous;                         ///< neighbours along x and y; those along z are u + 1, u - 1
    std::array<std::vector<float>, 3> g;  ///< W/K between a cell and its next neighbour per axis; 0: none
    std::vector<float> toZones;           ///< W/K between a cell and air of given temperature

    /// Sizes all arrays for `count` cells without neighbours.
    void allocate();
    [[nodiscard]] std::size_t columns() const noexcept {
        return static_cast<std::size_t>(columnsX) * static_cast<std::size_t>(columnsY);
    }
    void link(int axis, std::uint32_t from, std::uint32_t to, float conductance) noexcept {
        const auto a = static_cast<std::size_t>(axis);
        g[a][from] += conductance;
        if (axis == 2) return;
        next[a][from] = to;
        previous[a][to] = from;
    }
};

/// y = A x in double precision. Both have count + 2 entries, x[0] and x[count + 1] are 0.
void applyEquations(const CellEquations& equations, std::span<const double> x, std::span<double> y, int threads);

}  // namespace svt::simulate
