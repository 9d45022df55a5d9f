#include <bench/measure.hpp>

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <numeric>
#include <sstream>

namespace svt::bench {
namespace {

using Clock = std::chrono::steady_clock;

double secondsOf(const std::function<void()>& run) {
    const auto start = Clock::now();
    run();
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Reads a line such as "VmHWM:   1234 kB" of the process status, in bytes; 0 if missing.
std::uint64_t statusBytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.compare(0, key.size(), key) != 0) continue;
        std::istringstream rest(line.substr(key.size() + 1));
        std::uint64_t kilobytes = 0;
        rest >> kilobytes;
        return kilobytes * 1024;
    }
    return 0;
}

double medianOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

// Seconds per run: the median of as many runs as fit into a turn, at least one.
double secondsOfTurn(const std::function<void()>& run, double secondsPerTurn) {
    std::vector<double> seconds;
    const auto start = Clock::now();
    do {
        seconds.push_back(secondsOf(run));
    } while (std::chrono::duration<double>(Clock::now() - start).count() + seconds.back() < secondsPerTurn);
    return medianOf(std::move(seconds));
}

}  // namespace

std::uint64_t peakMemoryOf(const std::function<void()>& run) {
    // Release freed memory, which would hide new allocations.
    malloc_trim(0);
    std::ofstream clear("/proc/self/clear_refs");
    clear << 5 << std::flush;  // resets the peak
    const bool isCleared = clear.good();
    const std::uint64_t before = statusBytes("VmRSS");
    run();
    const std::uint64_t peak = statusBytes("VmHWM");
    return isCleared && peak > before ? peak - before : 0;
}

std::vector<Measurement> measureInTurns(const std::vector<Contestant>& contestants, const MeasureOptions& options) {
    std::vector<Measurement> measurements(contestants.size());
    std::vector<std::vector<double>> seconds(contestants.size());
    std::vector<double> own(contestants.size(), 0);
    for (std::size_t c = 0; c < contestants.size(); ++c) {
        measurements[c].name = contestants[c].name;
        measurements[c].peakBytes = peakMemoryOf(contestants[c].run);
    }
    const auto start = Clock::now();
    for (int round = 0; round < options.mostRuns; ++round) {
        const double spent = std::chrono::duration<double>(Clock::now() - start).count();
        if (round >= options.leastRuns && spent > options.maxTotalSeconds) break;
        for (std::size_t c = 0; c < contestants.size(); ++c) {
            if (own[c] > (round >= 3 ? options.maxSecondsPerContestant : 4 * options.maxSecondsPerContestant)) continue;
            const auto turn = Clock::now();
            seconds[c].push_back(secondsOfTurn(contestants[c].run, options.secondsPerTurn));
            own[c] += std::chrono::duration<double>(Clock::now() - turn).count();
        }
    }
    for (std::size_t c = 0; c < contestants.size(); ++c) {
        measurements[c].median = medianOf(seconds[c]);
        measurements[c].least = *std::min_element(seconds[c].begin(), seconds[c].end());
        measurements[c].most = *std::max_element(seconds[c].begin(), seconds[c].end());
        measurements[c].runs = static_cast<int>(seconds[c].size());
    }
    return measurements;
}

void yardstick() {
    static std::vector<std::uint64_t> block(std::size_t{1} << 23, 1);
    std::vector<std::uint32_t> numbers(std::size_t{1} << 19);
    std::uint64_t state = 1;
    for (std::uint32_t& number : numbers) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        number = static_cast<std::uint32_t>(state >> 32);
    }
    std::sort(numbers.begin(), numbers.end());
    volatile std::uint64_t sum = std::accumulate(block.begin(), block.end(), std::uint64_t{numbers[7]});
    static_cast<void>(sum);
}

}  // namespace svt::bench
