#pragma once
/// \file
/// A multigrid cycle as preconditioner of conjugate gradients.
///
/// Eight cells of 2 x 2 x 2 become one coarse cell (plain aggregation), whose conductances are the sums of those between its
/// cells and others (Galerkin). One sweep of red-black Gauss-Seidel before and after each coarse correction; two
/// corrections (W-cycle) below the second level. Single precision; the outer iteration is in double precision.

#include <svt/core/progress.hpp>
#include <svt/simulate/solver/cell_equations.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::simulate {

/// The levels of one system. The finest refers to the given equations.
class Multigrid {
public:
    /// \param equations  must outlive this, unchanged
    /// \param threads    0: all cores; the result does not depend on it
    Multigrid(const CellEquations& equations, int threads);
    Multigrid(const Multigrid&) = delete;
    Multigrid& operator=(const Multigrid&) = delete;

    /// The right side of a cycle: count + 2 entries.
    [[nodiscard]] std::span<float> rightSide() noexcept { return levels_.front().b; }
    /// Applies one symmetric cycle to rightSide(). \return the result: count + 2 entries
    std::span<const float> cycle();

private:
    struct Level {
        const CellEquations* equations = nullptr;
        std::vector<float> inverse;  // of the diagonal; 0 for cells without conductance
        std::vector<float> x, b;
        std::vector<std::uint32_t> parent;  // cell of the next level; empty in the last
    };
    void sweep(Level& level, unsigned colour) const;
    void restrictResidual(const Level& fine, Level& coarse) const;
    void correct(Level& fine, const Level& coarse) const;
    void cycle(std::size_t number);

    int threads_;
    std::vector<CellEquations> coarse_;
    std::vector<Level> levels_;
};

/// How the equations were solved.
struct SolveReport {
    int iterations = 0;
    double residual = 0;  ///< relative to the right side, Euclidean norm
    bool isConverged = false;
    bool isCancelled = false;
};

/// Solves the equations by conjugate gradients with a multigrid cycle as preconditioner.
/// \param multigrid of the same equations; for several right sides of one matrix
/// \param b         right side, count + 2 entries; overwritten
/// \param x         in: first guess; out: the solution; count + 2 entries, the first and the last 0
/// \param tolerance of the relative residual
/// Cost: O(cells) an iteration; the number of iterations grows slowly. Memory: 100 bytes a cell with the equations and b, x.
[[nodiscard]] SolveReport solveEquations(const CellEquations& equations, Multigrid& multigrid, std::span<double> b,
                                         std::span<double> x, double tolerance, int mostIterations, int threads,
                                         const Progress* progress = nullptr);
/// The same, with its own multigrid.
[[nodiscard]] SolveReport solveEquations(const CellEquations& equations, std::span<double> b, std::span<double> x,
                                         double tolerance, int mostIterations, int threads,
                                         const Progress* progress = nullptr);

}  // namespace svt::simulate
