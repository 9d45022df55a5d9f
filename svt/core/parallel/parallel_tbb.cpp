#include <svt/core/parallel.hpp>

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace svt {

void parallelFor(std::size_t count, std::size_t grain, int threads,
                 const std::function<void(std::size_t, std::size_t)>& body) {
    if (count == 0) return;
    grain = std::max<std::size_t>(grain, 1);
    if (threads == 1 || count <= grain) {
        body(0, count);
        return;
    }
    const auto loop = [&] {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, count, grain),
            [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); },
            tbb::simple_partitioner());
    };
    if (threads <= 0) {
        loop();
    } else {
        // More threads than cores do not help, and TBB would print a warning.
        tbb::task_arena arena(std::min(threads, hardwareThreads()));
        arena.execute(loop);
    }
}

int hardwareThreads() noexcept { return std::max(1, tbb::info::default_concurrency()); }

}  // namespace svt
