#pragma once
/// \file
/// What every reader is told: limits and who hears of the progress.

#include <svt/core/progress.hpp>

#include <cstdint>

namespace svt::readers {

struct ReadOptions {
    std::uint64_t maxBytes = std::uint64_t{16} << 30;  ///< larger input (after decompression) is refused, bytes
    std::uint32_t maxDepth = 512;                      ///< deeper nesting of elements or arrays is refused
    int threads = 0;                                   ///< 0: all cores; the result does not depend on it
    const Progress* progress = nullptr;                ///< may be null
};

}  // namespace svt::readers
