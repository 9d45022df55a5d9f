#pragma once
/// \file
/// The distinct columns of a block, numbered by first use.

#include <svt/volume/column_volume.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::volume {

/// Stores each distinct column once; hash table with open addressing and linear probing.
class ColumnDictionary {
public:
    ColumnDictionary() : table_(1024, 0) {}

    /// Number of the column with these runs, added if new. Adjacent runs with equal scalars are merged. Cost: O(runs).
    std::uint32_t add(std::span<const Run> runs) {
        const std::size_t begin = runs_.size();
        std::uint64_t hash = 0;
        for (std::size_t r = 0; r < runs.size(); ++r) {
            if (r + 1 < runs.size() && runs[r + 1].scalar == runs[r].scalar) continue;
            runs_.push_back(runs[r]);
            hash = (hash ^ (std::uint64_t{runs[r].end} << 32 | runs[r].scalar)) * 0x9E3779B97F4A7C15ull;
            hash ^= hash >> 32;
        }
        const std::span<const Run> added(runs_.data() + begin, runs_.size() - begin);
        std::size_t slot = hash & (table_.size() - 1);
        for (; table_[slot] != 0; slot = (slot + 1) & (table_.size() - 1)) {
            const std::uint32_t known = table_[slot] - 1;
            if (hashes_[known] != hash) continue;
            const auto other = column(known);
            if (!std::equal(other.begin(), other.end(), added.begin(), added.end())) continue;
            runs_.resize(begin);
            return known;
        }
        hashes_.push_back(hash);
        starts_.push_back(runs_.size());
        table_[slot] = static_cast<std::uint32_t>(hashes_.size());
        if (hashes_.size() * 2 > table_.size()) grow();
        return static_cast<std::uint32_t>(hashes_.size() - 1);
    }

    [[nodiscard]] std::span<const Run> column(std::uint32_t number) const noexcept {
        return {runs_.data() + starts_[number], starts_[number + 1] - starts_[number]};
    }
    /// Total count of runs of all columns.
    [[nodiscard]] std::size_t runCount() const noexcept { return runs_.size(); }

private:
    void grow() {
        std::vector<std::uint32_t> table(table_.size() * 2, 0);
        for (std::size_t c = 0; c < hashes_.size(); ++c) {
            std::size_t slot = hashes_[c] & (table.size() - 1);
            while (table[slot] != 0) slot = (slot + 1) & (table.size() - 1);
            table[slot] = static_cast<std::uint32_t>(c + 1);
        }
        table_ = std::move(table);
    }

    std::vector<Run> runs_;
    std::vector<std::size_t> starts_{0};
    std::vector<std::uint64_t> hashes_;
    std::vector<std::uint32_t> table_;  // open addressing: column number + 1, 0 = free
};

/// A segment of a row: columns [end of the previous segment, end) are equal.
struct Segment {
    std::uint32_t end = 0;
    std::uint32_t column = 0;  ///< number in the dictionary
    friend bool operator==(const Segment&, const Segment&) = default;
};

}  // namespace svt::volume
