#pragma once
/// \file
/// A hash table that finds the number (index) of an item by its hash. The caller stores the items and compares them.
/// Used to store equal parts only once (columns, rows, stacks of boundaries, profiles).

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace svt {

/// Open addressing with linear probing. An entry holds the upper 32 bits of the hash and a number below 2^32 - 1.
/// clear() keeps the memory.
class HashIndex {
public:
    /// \param size  initial number of entries, a power of two; the table doubles when it is half full
    explicit HashIndex(std::size_t size = 256) : table_(size, 0) {}

    /// Removes all numbers. Cost: O(size of the table); O(1) when it is empty.
    void clear() {
        if (count_ == 0) return;
        table_.assign(table_.size(), 0);
        count_ = 0;
    }

    /// The number stored under `hash` for which `isEqual(number)` holds; if there is none, stores and returns `add()`.
    /// \param hash  only its upper 32 bits are used, so these should differ for different items
    template <class IsEqual, class Add>
    std::uint32_t findOrAdd(std::uint64_t hash, IsEqual&& isEqual, Add&& add) {
        const std::uint64_t upper = hash >> 32;
        std::size_t slot = upper & (table_.size() - 1);
        for (; table_[slot] != 0; slot = (slot + 1) & (table_.size() - 1)) {
            const auto number = static_cast<std::uint32_t>(table_[slot] & 0xFFFFFFFFu) - 1;
            if (table_[slot] >> 32 == upper && isEqual(number)) return number;
        }
        const std::uint32_t number = add();
        table_[slot] = upper << 32 | (std::uint64_t(number) + 1);
        if (++count_ * 2 > table_.size()) grow();
        return number;
    }

private:
    void grow() {
        std::vector<std::uint64_t> wider(table_.size() * 2, 0);
        const std::size_t mask = wider.size() - 1;
        for (const std::uint64_t entry : table_) {
            if (entry == 0) continue;
            std::size_t slot = entry >> 32 & mask;
            while (wider[slot] != 0) slot = (slot + 1) & mask;
            wider[slot] = entry;
        }
        table_ = std::move(wider);
    }

    std::vector<std::uint64_t> table_;  // upper half of the hash, number + 1; 0: free
    std::size_t count_ = 0;
};

}  // namespace svt
