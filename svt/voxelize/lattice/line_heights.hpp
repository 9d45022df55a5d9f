#pragma once
/// \file
/// Heights of levels along a line of samples. Compiled for several instruction sets, of which the best that the
/// machine has is taken when the program runs; all give the same numbers. Internal to voxelize.

#include <svt/voxelize/lattice/levels.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace svt::voxelize {

/// A line has at most so many samples.
inline constexpr std::size_t kLineSamples = 64;

/// A level along a line: at sample n the first sample above is (first + step n) >> Level::kBits, kept within
/// [lowest, highest].
struct LineLevel {
    std::int64_t first = 0, step = 0;
    std::int32_t lowest = 0, highest = 0;
};

/// Heights of `levels` at samples n < count, and what they hash to.
/// \param line  (levels + 1) * kLineSamples numbers: a hash for each sample, of `seed` and of its heights, whose upper
///              bits are the good ones; then level by level the heights. Those from `count` on have any value.
/// \return bit n: some height differs from that of the sample before; bit 0 is not set
[[nodiscard]] std::uint64_t heightsAlong(std::span<const LineLevel> levels, std::int32_t count, std::uint32_t seed,
                                         std::int32_t* line);

}  // namespace svt::voxelize
