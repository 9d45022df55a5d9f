#pragma once
/// \file
/// The hashes and random numbers of generated models: the same on every machine and in every version.

#include <svt/core/hash.hpp>

#include <cstdint>
#include <string_view>

namespace svt::samples {

/// A permutation of the words in which each bit of the result depends on all bits of `word` (the finish of splitmix64).
[[nodiscard]] constexpr std::uint64_t mixBits(std::uint64_t word) noexcept {
    word = (word ^ word >> 30) * 0xBF58476D1CE4E5B9ull;
    word = (word ^ word >> 27) * 0x94D049BB133111EBull;
    return word ^ word >> 31;
}

/// Random numbers that depend only on their key (splitmix64: Steele, Lea, Flood 2014).
class Random {
public:
    explicit constexpr Random(std::uint64_t key) noexcept : state_(key) {}
    constexpr std::uint64_t next() noexcept { return mixBits(state_ += kHashFactor); }
    /// 0 <= value < count. The bias of the remainder is below count * 2^-64.
    constexpr std::int64_t below(std::int64_t count) noexcept {
        return static_cast<std::int64_t>(next() % static_cast<std::uint64_t>(count));
    }

private:
    std::uint64_t state_;
};

inline constexpr std::uint64_t kFnvBasis = 0xCBF29CE484222325ull;

/// FNV-1a of bytes whose hash was `hash` before them: the same on every machine.
[[nodiscard]] constexpr std::uint64_t fnvHash(std::string_view bytes, std::uint64_t hash = kFnvBasis) noexcept {
    for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ull;
    return hash;
}

}  // namespace svt::samples
