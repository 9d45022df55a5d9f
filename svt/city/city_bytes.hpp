#pragma once
/// \file
/// Bytes of a city that the caller fetches. For web pages, whose requests end long after the call that needs the bytes.
///
///     call --reads--> CityBytes --has it not--> the call fails; wanted() names the range
///      ^                                                          |
///      '---- again ---- give(), or refuse() <---- fetched by the caller
///
/// Each call continues as far as it can, so that all independent ranges are requested together.

#include <svt/core/result.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace svt::city {

class Store;

/// Not thread-safe.
class CityBytes {
public:
    /// A range of bytes in a file such as "packs/00000.svtp".
    struct Range {
        std::string name;
        std::uint64_t offset = 0, size = 0;
        friend bool operator<(const Range& a, const Range& b) {
            return std::tie(a.name, a.offset, a.size) < std::tie(b.name, b.offset, b.size);
        }
        friend bool operator==(const Range&, const Range&) = default;
    };

    CityBytes();

    /// The store for City::open(). Reading a range that was not given is an error. `packs.bin` is empty: it holds
    /// digests of whole packs, which a reader of ranges cannot compare.
    [[nodiscard]] std::shared_ptr<const Store> store() const;

    /// Ranges that were read but not given, since the last call; ordered, each once.
    [[nodiscard]] std::vector<Range> wanted();
    /// Whether wanted() would return a range.
    [[nodiscard]] bool isWanting() const noexcept;
    /// \param bytes  of the range; fewer if the file ends within it
    /// \param total  size of the file; 0: the file does not exist
    void give(const Range& range, std::string bytes, std::uint64_t total);
    /// Marks a range as unavailable: reading it is an error with this message.
    void refuse(const Range& range, std::string message);
    /// Forgets bytes of packs and of words.bin, and refused ranges. Keeps those of other files: the index and the ids.
    void forget();

private:
    struct Held;
    std::shared_ptr<Held> held_;
};

}  // namespace svt::city
