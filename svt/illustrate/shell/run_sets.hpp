#pragma once
/// \file
/// Internal: columns of group values, each kept once, and what two of them have in common.

#include <svt/core/hash_index.hpp>
#include <svt/volume/column_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::illustrate {

/// Sets are runs up to nz, neighbours differ in value; value 0 is none. Number 0 is the set of none at all.
class RunSets {
public:
    static constexpr std::uint32_t kNone = 0;

    explicit RunSets(std::uint32_t nz) {
        const volume::Run none{nz, 0};
        (void)add({&none, 1});
    }

    /// Number of the set with these runs, new or known.
    [[nodiscard]] std::uint32_t add(std::span<const volume::Run> runs);

    /// Number of the set that has what `a` and `b` have in common: their values where they are equal, else none.
    [[nodiscard]] std::uint32_t common(std::uint32_t a, std::uint32_t b);

    [[nodiscard]] std::span<const volume::Run> runs(std::uint32_t set) const noexcept {
        return std::span(runs_).subspan(start_[set], start_[set + 1] - start_[set]);
    }

private:
    struct Pair {
        std::uint32_t a, b, common;
    };
    std::vector<volume::Run> runs_;
    std::vector<std::size_t> start_{0};
    std::vector<Pair> pairs_;
    std::vector<volume::Run> scratch_;
    HashIndex setIndex_, pairIndex_;
};

/// Appends a run, joined with the one before where they have one scalar.
inline void appendRun(std::vector<volume::Run>& runs, std::uint32_t end, volume::Scalar scalar) {
    if (!runs.empty() && runs.back().scalar == scalar)
        runs.back().end = end;
    else
        runs.push_back({end, scalar});
}

}  // namespace svt::illustrate
