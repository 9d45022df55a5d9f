#pragma once
/// \file
/// Parallel loops. What a loop computes must not depend on the number of threads:
/// every index writes only its own results, which are joined in index order.

#include <cstddef>
#include <functional>

namespace svt {

/// Calls `body(begin, end)` for disjoint ranges that cover [0, count).
/// \param threads  at most this many threads at once; 0: all cores; 1: the caller's alone
/// \param grain    ranges hold at least this many indices where possible, >= 1
void parallelFor(std::size_t count, std::size_t grain, int threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Number of cores that `threads = 0` stands for, >= 1.
[[nodiscard]] int hardwareThreads() noexcept;

}  // namespace svt
