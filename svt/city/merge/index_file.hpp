#pragma once
/// \file
/// The files that merge writes: index.bin, ids.bin, packs.bin.

#include <svt/city/city_folder.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::city {

/// A page of the index as its parent names it. 56 bytes.
struct PageRef {
    static constexpr std::size_t kBytes = 56;
    int detail = 0;
    bool isLeaf = true;
    std::uint32_t size = 0;
    std::uint64_t offset = 0;
    std::array<std::int32_t, 4> rectangle{};  ///< west, south, east, north of all members below, metres
    std::int32_t lowest = 0, highest = 0;     ///< of all members below, metres
    std::uint64_t members = 0;                ///< bytes of all members below
    std::uint64_t checksum = 0;
};

/// An entry and where its samples lie in plan (metres, rounded outwards).
struct PlacedEntry {
    IndexEntry entry;
    std::array<std::int32_t, 4> rectangle{};
};

inline constexpr std::size_t kIndexHead = 32, kIndexPage = std::size_t{16} << 10, kIdHead = 40, kIdPage = 4096,
                             kIdEntry = 24;
inline constexpr std::size_t kIdsOfPage = 170;

/// index.bin of entries, which are sorted here.
[[nodiscard]] std::string indexBytes(std::vector<PlacedEntry> entries);
/// The references of the root, or of an inner page; nothing for damaged ones.
[[nodiscard]] std::optional<std::vector<PageRef>> takeRefs(std::string_view page);
/// The entries of a leaf; nothing for a damaged one.
[[nodiscard]] std::optional<std::vector<IndexEntry>> takeEntries(std::string_view page);

struct IdEntry {
    std::uint64_t hash = 0;
    TileKey tile;
    std::uint32_t label = 0;
};
/// ids.bin of entries, which are sorted here.
[[nodiscard]] std::string idsBytes(std::vector<IdEntry> entries);

}  // namespace svt::city
