#include <svt/simulate/solver/cell_equations.hpp>

#include <svt/simulate/solver/cell_sums.hpp>

namespace svt::simulate {

void CellEquations::allocate() {
    const std::size_t size = std::size_t{count} + 2;
    for (std::size_t a = 0; a < 2; ++a) {
        next[a].assign(size, count + 1);
        previous[a].assign(size, 0);
    }
    for (std::vector<float>& conductances : g) conductances.assign(size, 0.0f);
    toZones.assign(size, 0.0f);
}

void applyEquations(const CellEquations& equations, std::span<const double> x, std::span<double> y, int threads) {
    const float *gx = equations.g[0].data(), *gy = equations.g[1].data(), *gz = equations.g[2].data();
    const std::uint32_t *nextX = equations.next[0].data(), *nextY = equations.next[1].data();
    const std::uint32_t *previousX = equations.previous[0].data(), *previousY = equations.previous[1].data();
    forCells(equations.count, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t u = begin; u < end; ++u) {
            // Differences, so that a constant gives exactly toZones times the constant.
            const double own = x[u];
            double sum = double{equations.toZones[u]} * own;
            sum += double{gz[u]} * (own - x[u + 1]) + double{gz[u - 1]} * (own - x[u - 1]);
            sum += double{gx[u]} * (own - x[nextX[u]]) + double{gx[previousX[u]]} * (own - x[previousX[u]]);
            sum += double{gy[u]} * (own - x[nextY[u]]) + double{gy[previousY[u]]} * (own - x[previousY[u]]);
            y[u] = sum;
        }
    });
}

}  // namespace svt::simulate
