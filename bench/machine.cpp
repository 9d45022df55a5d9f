#include <bench/machine.hpp>
#include <svt/core/parallel.hpp>

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

namespace svt::bench {
namespace {

// The value of the first line that begins with `key`, after its colon.
std::string firstValue(const char* file, const std::string& key) {
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
        if (line.compare(0, key.size(), key) != 0) continue;
        const std::size_t colon = line.find(':');
        const std::size_t start = colon == std::string::npos ? colon : line.find_first_not_of(" \t", colon + 1);
        if (start != std::string::npos) return line.substr(start);
    }
    return "unknown";
}

std::uint64_t memoryBytes(const std::string& key) {
    std::istringstream memory(firstValue("/proc/meminfo", key));
    std::uint64_t kilobytes = 0;
    memory >> kilobytes;
    return kilobytes * 1024;
}

std::string simdOfProcessor() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512bw")) return "AVX-512";
    if (__builtin_cpu_supports("avx2")) return "AVX2";
    return "SSE2";
#elif defined(__aarch64__)
    return "NEON";
#else
    return "unknown";
#endif
}

}  // namespace

std::uint64_t availableMemory() { return memoryBytes("MemAvailable"); }

nlohmann::ordered_json describeMachine() {
#if defined(__clang__)
    const std::string compiler = fmt::format("clang {}.{}", __clang_major__, __clang_minor__);
#else
    const std::string compiler = fmt::format("gcc {}.{}", __GNUC__, __GNUC_MINOR__);
#endif
    return {{"cores", hardwareThreads()}, {"processor", firstValue("/proc/cpuinfo", "model name")},
            {"simd", simdOfProcessor()},  {"memory_gib", std::round(double(memoryBytes("MemTotal")) / (1 << 30))},
            {"compiler", compiler},       {"build", SVT_BENCH_BUILD}};
}

}  // namespace svt::bench
