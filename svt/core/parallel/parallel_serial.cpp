// Replaces parallel_tbb.cpp in builds without threads, such as for browsers, where hosting may not allow them.
#include <svt/core/parallel.hpp>

namespace svt {

void parallelFor(std::size_t count, std::size_t, int, const std::function<void(std::size_t, std::size_t)>& body) {
    if (count != 0) body(0, count);
}

int hardwareThreads() noexcept { return 1; }

}  // namespace svt
