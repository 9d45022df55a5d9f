#pragma once
/// \file
/// Hashes of words for tables in memory. No result depends on them, and no file contains one.

#include <cstdint>

namespace svt {

/// 2^64 divided by the golden ratio, odd: the factor of multiplicative hashing (Knuth, vol. 3, 6.4).
inline constexpr std::uint64_t kHashFactor = 0x9E3779B97F4A7C15ull;

/// Appends `word` to a sequence of words with the hash `hash` and returns the new hash. Its upper bits are the better
/// ones.
[[nodiscard]] constexpr std::uint64_t mixHash(std::uint64_t hash, std::uint64_t word) noexcept {
    return (hash ^ hash >> 29 ^ word) * kHashFactor;
}

}  // namespace svt
