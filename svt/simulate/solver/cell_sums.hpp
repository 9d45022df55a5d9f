#pragma once
/// \file
/// Sums over cells in blocks of fixed size, so that they do not depend on the number of threads.

#include <svt/core/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::simulate {

/// The sum of f(u) over the cells 1..count, the same for any number of threads.
template <class F>
[[nodiscard]] double sumOverCells(std::uint32_t count, int threads, const F& f) {
    constexpr std::size_t kBlock = 8192;
    const std::size_t blocks = (std::size_t{count} + kBlock - 1) / kBlock;
    std::vector<double> sums(blocks, 0);
    parallelFor(blocks, 4, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            double sum = 0;
            const std::size_t last = std::min((b + 1) * kBlock, std::size_t{count});
            for (std::size_t u = b * kBlock + 1; u <= last; ++u) sum += f(u);
            sums[b] = sum;
        }
    });
    double total = 0;
    for (const double sum : sums) total += sum;
    return total;
}

/// Calls body(begin, end) for ranges of cells that cover 1..count.
template <class Body>
void forCells(std::uint32_t count, int threads, const Body& body) {
    parallelFor(count, 16384, threads, [&](std::size_t begin, std::size_t end) { body(begin + 1, end + 1); });
}

}  // namespace svt::simulate
