#pragma once
/// \file
/// Parallel loops. Results must not depend on the number of threads: each index writes only
/// its own results, which are combined in index order.

#include <cstddef>
#include <functional>

namespace svt {

/// Calls `body(begin, end)` for disjoint ranges that cover [0, count).
/// \param threads  maximum number of threads; 0: all cores; 1: the calling thread only
/// \param grain    minimum number of indices per range where possible, >= 1
void parallelFor(std::size_t count, std::size_t grain, int threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Number of cores that `threads = 0` stands for, >= 1.
[[nodiscard]] int hardwareThreads() noexcept;

}  // namespace svt
