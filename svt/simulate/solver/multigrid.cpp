#include <svt/simulate/solver/multigrid.hpp>

#include <svt/simulate/solver/cell_sums.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace svt::simulate {
namespace {

constexpr std::uint32_t kCoarsest = 200;  // cells
constexpr std::size_t kMostLevels = 24;
constexpr int kCoarsestSweeps = 30;
constexpr std::size_t kFirstOfW = 2;  // levels from here on are visited twice a cycle
constexpr std::size_t kColumnGrain = 256;

// The runs of a coarse column: those of up to four columns, at half height.
void addCoarseRuns(const CellEquations& fine, std::int32_t columnX, std::int32_t columnY, CellEquations& coarse) {
    std::vector<std::pair<std::int32_t, std::int32_t>> intervals;  // first and last height
    for (std::int32_t j = 2 * columnY; j < std::min(2 * columnY + 2, fine.columnsY); ++j)
        for (std::int32_t i = 2 * columnX; i < std::min(2 * columnX + 2, fine.columnsX); ++i) {
            const std::size_t column =
                static_cast<std::size_t>(j) * static_cast<std::size_t>(fine.columnsX) + static_cast<std::size_t>(i);
            for (std::size_t r = fine.columnStart[column]; r < fine.columnStart[column + 1]; ++r) {
                const CellRun& run = fine.runs[r];
                intervals.emplace_back(run.k >> 1, (run.k + static_cast<std::int32_t>(run.count) - 1) >> 1);
            }
        }
    std::sort(intervals.begin(), intervals.end());
    for (std::size_t n = 0; n < intervals.size();) {
        const std::int32_t first = intervals[n].first;
        std::int32_t last = intervals[n].second;
        for (++n; n < intervals.size() && intervals[n].first <= last + 1; ++n)
            last = std::max(last, intervals[n].second);
        const auto count = static_cast<std::uint32_t>(last - first + 1);
        coarse.runs.push_back({coarse.count + 1, count, first});
        coarse.count += count;
    }
}

// The coarse cell of each cell.
std::vector<std::uint32_t> parentsOf(const CellEquations& fine, const CellEquations& coarse) {
    std::vector<std::uint32_t> parent(std::size_t{fine.count} + 2, 0);
    for (std::size_t column = 0; column < fine.columns(); ++column) {
        const auto i = static_cast<std::int32_t>(column % static_cast<std::size_t>(fine.columnsX));
        const auto j = static_cast<std::int32_t>(column / static_cast<std::size_t>(fine.columnsX));
        const std::size_t above = static_cast<std::size_t>(j >> 1) * static_cast<std::size_t>(coarse.columnsX) +
                                  static_cast<std::size_t>(i >> 1);
        std::size_t r = coarse.columnStart[above];
        for (std::size_t own = fine.columnStart[column]; own < fine.columnStart[column + 1]; ++own) {
            const CellRun& run = fine.runs[own];
            // One coarse run contains the whole run.
            while (coarse.runs[r].k + static_cast<std::int32_t>(coarse.runs[r].count) <= run.k >> 1) ++r;
            for (std::uint32_t n = 0; n < run.count; ++n) {
                const std::int32_t k = (run.k + static_cast<std::int32_t>(n)) >> 1;
                parent[run.first + n] = coarse.runs[r].first + static_cast<std::uint32_t>(k - coarse.runs[r].k);
            }
        }
    }
    return parent;
}

CellEquations coarsen(const CellEquations& fine, std::vector<std::uint32_t>& parent) {
    CellEquations coarse;
    coarse.columnsX = (fine.columnsX + 1) / 2;
    coarse.columnsY = (fine.columnsY + 1) / 2;
    for (std::int32_t j = 0; j < coarse.columnsY; ++j)
        for (std::int32_t i = 0; i < coarse.columnsX; ++i) {
            coarse.columnStart.push_back(coarse.runs.size());
            addCoarseRuns(fine, i, j, coarse);
        }
    coarse.columnStart.push_back(coarse.runs.size());
    coarse.allocate();
    parent = parentsOf(fine, coarse);
    for (std::uint32_t u = 1; u <= fine.count; ++u) {
        const std::uint32_t own = parent[u];
        coarse.toZones[own] += fine.toZones[u];
        for (std::size_t a = 0; a < 3; ++a) {
            if (!(fine.g[a][u] > 0)) continue;
            const std::uint32_t other = parent[a == 2 ? u + 1 : fine.next[a][u]];
            if (other != own) coarse.link(static_cast<int>(a), own, other, fine.g[a][u]);
        }
    }
    return coarse;
}

std::vector<float> inverseDiagonal(const CellEquations& equations, int threads) {
    std::vector<float> inverse(std::size_t{equations.count} + 2, 0.0f);
    forCells(equations.count, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t u = begin; u < end; ++u) {
            double sum = double{equations.toZones[u]} + double{equations.g[2][u]} + double{equations.g[2][u - 1]};
            for (std::size_t a = 0; a < 2; ++a)
                sum += double{equations.g[a][u]} + double{equations.g[a][equations.previous[a][u]]};
            inverse[u] = sum > 0 ? static_cast<float>(1 / sum) : 0.0f;
        }
    });
    return inverse;
}

}  // namespace

Multigrid::Multigrid(const CellEquations& equations, int threads) : threads_(threads) {
    coarse_.reserve(kMostLevels);  // levels refer to its elements
    const CellEquations* finest = &equations;
    while (true) {
        Level& level = levels_.emplace_back();
        level.equations = finest;
        level.inverse = inverseDiagonal(*finest, threads);
        level.x.assign(level.inverse.size(), 0.0f);
        level.b.assign(level.inverse.size(), 0.0f);
        if (finest->count <= kCoarsest || levels_.size() == kMostLevels) break;
        CellEquations next = coarsen(*finest, level.parent);
        if (next.count >= finest->count) {  // as with cells that do not touch
            level.parent.clear();
            break;
        }
        coarse_.push_back(std::move(next));
        finest = &coarse_.back();
    }
}

void Multigrid::sweep(Level& level, unsigned colour) const {
    const CellEquations& equations = *level.equations;
    const float *gx = equations.g[0].data(), *gy = equations.g[1].data(), *gz = equations.g[2].data();
    const std::uint32_t *nextX = equations.next[0].data(), *nextY = equations.next[1].data();
    const std::uint32_t *previousX = equations.previous[0].data(), *previousY = equations.previous[1].data();
    const float *b = level.b.data(), *inverse = level.inverse.data();
    float* x = level.x.data();
    const auto across = static_cast<std::size_t>(equations.columnsX);
    parallelFor(equations.columns(), kColumnGrain, threads_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t column = begin; column < end; ++column) {
            const auto parity = static_cast<unsigned>(column % across + column / across) + colour;
            for (std::size_t r = equations.columnStart[column]; r < equations.columnStart[column + 1]; ++r) {
                const CellRun& run = equations.runs[r];
                const std::uint32_t last = run.first + run.count;
                for (std::uint32_t u = run.first + ((parity + static_cast<unsigned>(run.k)) & 1u); u < last; u += 2) {
                    const std::uint32_t beforeX = previousX[u], beforeY = previousY[u];
                    // Beyond the ends of a run are cells of other columns, which another thread may write.
                    const float above = u + 1 < last ? x[u + 1] : 0.0f, below = u > run.first ? x[u - 1] : 0.0f;
                    const float sum = b[u] + gz[u] * above + gz[u - 1] * below + gx[u] * x[nextX[u]] +
                                      gx[beforeX] * x[beforeX] + gy[u] * x[nextY[u]] + gy[beforeY] * x[beforeY];
                    x[u] = sum * inverse[u];
                }
            }
        }
    });
}

void Multigrid::restrictResidual(const Level& fine, Level& coarse) const {
    const CellEquations& equations = *fine.equations;
    const CellEquations& target = *coarse.equations;
    const float *gx = equations.g[0].data(), *gy = equations.g[1].data(), *gz = equations.g[2].data();
    const float* x = fine.x.data();
    const auto addCell = [&](std::uint32_t u) {
        const std::uint32_t nextX = equations.next[0][u], nextY = equations.next[1][u];
        const std::uint32_t beforeX = equations.previous[0][u], beforeY = equations.previous[1][u];
        const float own = x[u];
        const float flow = equations.toZones[u] * own + gz[u] * (own - x[u + 1]) + gz[u - 1] * (own - x[u - 1]) +
                           gx[u] * (own - x[nextX]) + gx[beforeX] * (own - x[beforeX]) + gy[u] * (own - x[nextY]) +
                           gy[beforeY] * (own - x[beforeY]);
        coarse.b[fine.parent[u]] += fine.b[u] - flow;
    };
    const auto across = static_cast<std::size_t>(target.columnsX);
    parallelFor(target.columns(), kColumnGrain / 4, threads_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t column = begin; column < end; ++column) {
            for (std::size_t r = target.columnStart[column]; r < target.columnStart[column + 1]; ++r)
                std::fill_n(coarse.b.begin() + target.runs[r].first, target.runs[r].count, 0.0f);
            const auto i = static_cast<std::int32_t>(column % across), j = static_cast<std::int32_t>(column / across);
            for (std::int32_t y = 2 * j; y < std::min(2 * j + 2, equations.columnsY); ++y)
                for (std::int32_t f = 2 * i; f < std::min(2 * i + 2, equations.columnsX); ++f) {
                    const std::size_t own = static_cast<std::size_t>(y) * static_cast<std::size_t>(equations.columnsX) +
                                            static_cast<std::size_t>(f);
                    for (std::size_t r = equations.columnStart[own]; r < equations.columnStart[own + 1]; ++r)
                        for (std::uint32_t n = 0; n < equations.runs[r].count; ++n)
                            addCell(equations.runs[r].first + n);
                }
        }
    });
}

void Multigrid::correct(Level& fine, const Level& coarse) const {
    forCells(fine.equations->count, threads_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t u = begin; u < end; ++u) fine.x[u] += coarse.x[fine.parent[u]];
    });
}

void Multigrid::cycle(std::size_t number) {
    Level& level = levels_[number];
    std::fill(level.x.begin(), level.x.end(), 0.0f);
    if (level.parent.empty()) {
        for (int n = 0; n < kCoarsestSweeps; ++n)
            for (const unsigned colour : {0u, 1u}) sweep(level, colour);
        for (int n = 0; n < kCoarsestSweeps; ++n)
            for (const unsigned colour : {1u, 0u}) sweep(level, colour);
        return;
    }
    for (const unsigned colour : {0u, 1u}) sweep(level, colour);
    for (int visit = 0; visit < (number < kFirstOfW ? 1 : 2); ++visit) {
        restrictResidual(level, levels_[number + 1]);
        cycle(number + 1);
        correct(level, levels_[number + 1]);
        for (const unsigned colour : {1u, 0u}) sweep(level, colour);
    }
}

std::span<const float> Multigrid::cycle() {
    cycle(0);
    return levels_.front().x;
}

SolveReport solveEquations(const CellEquations& equations, std::span<double> b, std::span<double> x, double tolerance,
                           int mostIterations, int threads, const Progress* progress) {
    Multigrid multigrid(equations, threads);
    return solveEquations(equations, multigrid, b, x, tolerance, mostIterations, threads, progress);
}

SolveReport solveEquations(const CellEquations& equations, Multigrid& multigrid, std::span<double> b,
                           std::span<double> x, double tolerance, int mostIterations, int threads,
                           const Progress* progress) {
    const std::uint32_t count = equations.count;
    const auto norm = [&](std::span<const double> v) {
        return std::sqrt(sumOverCells(count, threads, [&](std::size_t u) { return v[u] * v[u]; }));
    };
    const double size = norm(b);
    const std::span<double> r = b;  // b becomes the residual
    std::vector<double> p(std::size_t{count} + 2, 0), q(std::size_t{count} + 2, 0);
    applyEquations(equations, x, q, threads);
    for (std::size_t u = 1; u <= count; ++u) r[u] -= q[u];
    SolveReport report;
    double before = 0;
    const double first = norm(r);
    while (true) {
        const double now = norm(r);
        report.residual = size > 0 ? now / size : 0;
        report.isConverged = now <= tolerance * size;
        if (first > 0 && now > 0 && size > 0)
            Progress::tell(progress, "solve",
                           std::clamp(std::log(first / now) / std::log(first / (tolerance * size)), 0.0, 1.0));
        if (report.isConverged || report.iterations >= mostIterations || !std::isfinite(now)) break;
        if (Progress::isCancelled(progress)) {
            report.isCancelled = true;
            break;
        }
        // Scaled, so that small residuals stay far from the smallest floats.
        const std::span<float> right = multigrid.rightSide();
        const double scale = 1 / now;
        for (std::size_t u = 1; u <= count; ++u) right[u] = static_cast<float>(r[u] * scale);
        const std::span<const float> z = multigrid.cycle();
        const double rz = now * sumOverCells(count, threads, [&](std::size_t u) { return r[u] * double{z[u]}; });
        const double keep = report.iterations > 0 ? rz / before : 0;
        before = rz;
        for (std::size_t u = 1; u <= count; ++u) p[u] = now * double{z[u]} + keep * p[u];
        applyEquations(equations, p, q, threads);
        const double step = rz / sumOverCells(count, threads, [&](std::size_t u) { return p[u] * q[u]; });
        for (std::size_t u = 1; u <= count; ++u) {
            x[u] += step * p[u];
            r[u] -= step * q[u];
        }
        ++report.iterations;
    }
    return report;
}

}  // namespace svt::simulate
