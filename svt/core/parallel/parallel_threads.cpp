// Replaces parallel_tbb.cpp in builds with the thread sanitizer: it does not see the synchronization inside of TBB's
// library and would report each loop. Slower, since every loop starts its own threads.
#include <svt/core/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace svt {

void parallelFor(std::size_t count, std::size_t grain, int threads,
                 const std::function<void(std::size_t, std::size_t)>& body) {
    if (count == 0) return;
    grain = std::max<std::size_t>(grain, 1);
    const std::size_t ranges = (count + grain - 1) / grain;
    // At least four threads, also on a machine with fewer cores, so that data races can occur.
    constexpr std::size_t kMinThreads = 4;
    const std::size_t wanted =
        threads > 0 ? std::size_t(threads) : std::max(kMinThreads, std::size_t(hardwareThreads()));
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t range = next++; range < ranges; range = next++)
            body(range * grain, std::min(count, (range + 1) * grain));
    };
    std::vector<std::thread> helpers;
    for (std::size_t t = 1; t < std::min({wanted, ranges, std::size_t{16}}); ++t) helpers.emplace_back(work);
    work();
    for (std::thread& helper : helpers) helper.join();
}

int hardwareThreads() noexcept { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

}  // namespace svt
