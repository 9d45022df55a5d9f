#pragma once
/// \file
/// Drawings of one volume side by side.

#include <svt/core/parallel.hpp>

#include <cstddef>
#include <functional>

namespace svt::drawing {

/// Calls `draw(n, threads)` for each n in [0, count). The first drawing has all threads and makes most of the tables that
/// the drawings share, see DrawingTables. The others are drawn side by side, with one thread each.
/// \param threads  0: all cores; the results must not depend on it
inline void drawSideBySide(std::size_t count, int threads,
                           const std::function<void(std::size_t n, int threads)>& draw) {
    if (count == 0) return;
    draw(0, threads);
    parallelFor(count - 1, 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) draw(n + 1, 1);
    });
}

}  // namespace svt::drawing
