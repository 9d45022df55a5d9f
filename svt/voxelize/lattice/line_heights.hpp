#pragma once
/// \file
/// Heights of height planes along a line of samples. SIMD by Google Highway: compiled for several instruction sets, the
/// best one available is chosen at run time; all give the same results.

#include <svt/voxelize/lattice/height_planes.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace svt::voxelize {

/// Maximum number of samples of a line.
inline constexpr std::size_t kLineSamples = 64;

/// A height plane along a line: at sample n the first sample above it is (first + step n) >> HeightPlane::kBits,
/// clamped to [lowest, highest].
struct LineHeightPlane {
    std::int64_t first = 0, step = 0;
    std::int32_t lowest = 0, highest = 0;
};

/// Computes the heights of `heightPlanes` at samples n < count, and a hash of them for each sample.
/// \param line  output, (height planes + 1) * kLineSamples numbers: first the hash of each sample, over `seed` and its
///              heights (use its upper bits), then the heights by height plane. Entries beyond `count` are unspecified.
/// \return bit n is set where some height differs from that of sample n - 1; bit 0 is never set
[[nodiscard]] std::uint64_t heightsAlong(std::span<const LineHeightPlane> heightPlanes, std::int32_t count,
                                         std::uint32_t seed, std::int32_t* line);

}  // namespace svt::voxelize
