#pragma once
/// \file
/// The distinct columns of a block, numbered by first use.

#include <svt/core/hash.hpp>
#include <svt/core/hash_index.hpp>
#include <svt/volume/column_volume.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::volume {

/// Stores each distinct column once.
class ColumnDictionary {
public:
    /// Number of the column with these runs, added if new. Adjacent runs with equal scalars are merged. Cost: O(runs).
    std::uint32_t add(std::span<const Run> runs) {
        const std::size_t begin = runs_.size();
        std::uint64_t hash = 0;
        for (std::size_t r = 0; r < runs.size(); ++r) {
            if (r + 1 < runs.size() && runs[r + 1].scalar == runs[r].scalar) continue;
            runs_.push_back(runs[r]);
            hash = mixHash(hash, std::uint64_t{runs[r].end} << 32 | runs[r].scalar);
        }
        const std::span<const Run> added(runs_.data() + begin, runs_.size() - begin);
        bool isNew = false;
        const std::uint32_t number = index_.findOrAdd(
            hash,
            [&](std::uint32_t known) {
                const std::span<const Run> other = column(known);
                return std::equal(other.begin(), other.end(), added.begin(), added.end());
            },
            [&] {
                isNew = true;
                return static_cast<std::uint32_t>(starts_.size() - 1);
            });
        if (isNew)
            starts_.push_back(runs_.size());
        else
            runs_.resize(begin);
        return number;
    }

    [[nodiscard]] std::span<const Run> column(std::uint32_t number) const noexcept {
        return {runs_.data() + starts_[number], starts_[number + 1] - starts_[number]};
    }
    /// Total count of runs of all columns.
    [[nodiscard]] std::size_t runCount() const noexcept { return runs_.size(); }

private:
    std::vector<Run> runs_;
    std::vector<std::size_t> starts_{0};
    HashIndex index_{1024};
};

/// A segment of a row: columns [end of the previous segment, end) are equal.
struct Segment {
    std::uint32_t end = 0;
    std::uint32_t column = 0;  ///< number in the dictionary
    friend bool operator==(const Segment&, const Segment&) = default;
};

}  // namespace svt::volume
