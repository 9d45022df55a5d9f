#pragma once
/// \file
/// Heights of a level along a line of samples. Compiled for several instruction sets, of which the best that the
/// machine has is taken when the program runs; all give the same numbers. Internal to voxelize.

#include <svt/voxelize/levels.hpp>

#include <cstddef>
#include <cstdint>

namespace svt::voxelize {

/// A line has at most so many samples.
inline constexpr std::size_t kLineSamples = 64;
/// heightsAlong() may write so many numbers, whatever the line's length.
inline constexpr std::size_t kLineSpace = kLineSamples + 8;

/// level.clamped(first + n step) for each n < count.
/// \param heights  kLineSpace numbers; those from `count` on are left with any value
/// \return bit n: sample n differs from the one before; bit 0 is not set
[[nodiscard]] std::uint64_t heightsAlong(const Level& level, std::int64_t first, std::int64_t step, std::int32_t count,
                                         std::int32_t* heights);

}  // namespace svt::voxelize
