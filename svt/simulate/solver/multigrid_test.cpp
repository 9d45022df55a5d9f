// The solver against elimination in double precision.
#include <svt/simulate/solver/multigrid.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace svt::simulate {
namespace {

// Cells of a grid with holes, and random conductances over four orders of magnitude.
CellEquations randomEquations(Vec3i size, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto number = [&] { return double(random()) / 4294967296.0; };
    CellEquations equations;
    equations.columnsX = size.x;
    equations.columnsY = size.y;
    std::vector<std::uint32_t> cellOf;
    for (std::int32_t c = 0; c < size.x * size.y; ++c) {
        equations.columnStart.push_back(equations.runs.size());
        bool isJoined = false;
        for (std::int32_t k = 0; k < size.z; ++k) {
            const bool isCell = number() < 0.8;
            cellOf.push_back(isCell ? ++equations.count : 0);
            if (isCell && isJoined)
                ++equations.runs.back().count;
            else if (isCell)
                equations.runs.push_back({equations.count, 1, k});
            isJoined = isCell;
        }
    }
    equations.columnStart.push_back(equations.runs.size());
    equations.allocate();
    const auto at = [&](Vec3i v) {
        return v.x < size.x && v.y < size.y && v.z < size.z ? cellOf[std::size_t(v.z + size.z * (v.x + size.x * v.y))]
                                                            : 0;
    };
    for (std::int32_t j = 0; j < size.y; ++j)
        for (std::int32_t i = 0; i < size.x; ++i)
            for (std::int32_t k = 0; k < size.z; ++k) {
                const std::uint32_t own = at({i, j, k});
                if (own == 0) continue;
                equations.toZones[own] = number() < 0.3 ? float(number()) : 0;
                const std::uint32_t next[3] = {at({i + 1, j, k}), at({i, j + 1, k}), at({i, j, k + 1})};
                for (int a = 0; a < 3; ++a)
                    if (next[a] != 0) equations.link(a, own, next[a], float(std::pow(10, 4 * number() - 2)));
            }
    return equations;
}

// The matrix column by column, by the product with unit vectors; then Gauss without pivots, as the matrix is symmetric.
std::vector<double> eliminated(const CellEquations& equations, std::vector<double> b) {
    const std::size_t n = equations.count;
    std::vector<double> matrix(n * n), unit(n + 2, 0), column(n + 2, 0);
    for (std::size_t c = 0; c < n; ++c) {
        unit[c + 1] = 1;
        applyEquations(equations, unit, column, 1);
        unit[c + 1] = 0;
        for (std::size_t r = 0; r < n; ++r) matrix[r * n + c] = column[r + 1];
    }
    for (std::size_t p = 0; p < n; ++p)
        for (std::size_t r = p + 1; r < n; ++r) {
            const double factor = matrix[r * n + p] / matrix[p * n + p];
            if (factor == 0) continue;
            for (std::size_t c = p; c < n; ++c) matrix[r * n + c] -= factor * matrix[p * n + c];
            b[r + 1] -= factor * b[p + 1];
        }
    for (std::size_t p = n; p-- > 0;) {
        for (std::size_t c = p + 1; c < n; ++c) b[p + 1] -= matrix[p * n + c] * b[c + 1];
        b[p + 1] /= matrix[p * n + p];
    }
    return b;
}

TEST(Multigrid, SolvesLikeElimination) {
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const CellEquations equations = randomEquations({9, 8, 7}, seed);
        ASSERT_GT(equations.count, 300u);
        std::vector<double> b(std::size_t{equations.count} + 2, 0), x(b.size(), 0);
        for (std::uint32_t u = 1; u <= equations.count; ++u) b[u] = double{equations.toZones[u]} * (u % 7);
        const std::vector<double> exact = eliminated(equations, b);
        const SolveReport report = solveEquations(equations, b, x, 1e-12, 200, 1);
        EXPECT_TRUE(report.isConverged);
        EXPECT_LT(report.iterations, 150);
        for (std::uint32_t u = 1; u <= equations.count; ++u) {
            if (!std::isfinite(exact[u])) continue;  // a cell without neighbours and air has no equation
            EXPECT_NEAR(x[u], exact[u], 1e-8) << u;
        }
    }
}

TEST(Multigrid, StopsAtTheLimitOfIterations) {
    const CellEquations equations = randomEquations({9, 8, 7}, 1);
    std::vector<double> b(std::size_t{equations.count} + 2, 0), x(b.size(), 0);
    for (std::uint32_t u = 1; u <= equations.count; ++u) b[u] = double{equations.toZones[u]};
    const SolveReport report = solveEquations(equations, b, x, 1e-15, 2, 1);
    EXPECT_FALSE(report.isConverged);
    EXPECT_EQ(report.iterations, 2);
}

}  // namespace
}  // namespace svt::simulate
