#pragma once
/// \file
/// Columns of group values, each stored once (hash consing), and their memoized intersections.

#include <svt/core/hash_index.hpp>
#include <svt/volume/column_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::illustrate {

/// A set is a column of runs that ends at nz; adjacent runs differ in value, and value 0 means none. Set number 0 is
/// empty: value 0 all over.
class RunSets {
public:
    static constexpr std::uint32_t kNone = 0;

    explicit RunSets(std::uint32_t nz) {
        const volume::Run none{nz, 0};
        (void)add({&none, 1});
    }

    /// Number of the set with these runs; adds it if it is new.
    [[nodiscard]] std::uint32_t add(std::span<const volume::Run> runs);

    /// Number of the intersection of `a` and `b`: their value where it is equal, else 0. Memoized.
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

/// Appends a run, merged with the one before if the scalar is the same.
inline void appendRun(std::vector<volume::Run>& runs, std::uint32_t end, volume::Scalar scalar) {
    if (!runs.empty() && runs.back().scalar == scalar)
        runs.back().end = end;
    else
        runs.push_back({end, scalar});
}

}  // namespace svt::illustrate
