#pragma once
/// \file
/// Options common to all readers: limits, threads and progress reports.

#include <svt/core/progress.hpp>

#include <cstdint>

namespace svt::readers {

struct ReadOptions {
    std::uint64_t maxBytes = std::uint64_t{16} << 30;  ///< limit on input bytes (after decompression)
    std::uint32_t maxDepth = 512;                      ///< limit on nesting of elements or arrays
    int threads = 0;                                   ///< 0: all cores; the result does not depend on it
    const Progress* progress = nullptr;                ///< may be null
};

}  // namespace svt::readers
