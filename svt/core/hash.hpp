#pragma once
/// \file
/// Hashes of words for tables in memory. They never decide a result, and no file holds one.

#include <cstdint>

namespace svt {

/// 2^64 divided by the golden ratio, odd: the factor of multiplicative hashing (Knuth, vol. 3, 6.4).
inline constexpr std::uint64_t kHashFactor = 0x9E3779B97F4A7C15ull;

/// The hash of a sequence of words whose hash was `hash` before `word`. Its upper bits are the better ones.
[[nodiscard]] constexpr std::uint64_t mixHash(std::uint64_t hash, std::uint64_t word) noexcept {
    return (hash ^ hash >> 29 ^ word) * kHashFactor;
}

}  // namespace svt
