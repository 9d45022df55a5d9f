#pragma once
/// \file
/// Bytes of a city that somebody else fetches: a page, whose requests end long after the call that needs them.
///
///     call --reads--> CityBytes --has it not--> the call fails; wanted() names the range
///      ^                                                          |
///      '---- again ---- give(), or refuse() <---- fetched by the caller
///
/// Each call goes as far as it can, so that all ranges which do not depend on each other are asked for together.

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
    /// Of a file such as "packs/00000.svtp".
    struct Range {
        std::string name;
        std::uint64_t offset = 0, size = 0;
        friend bool operator<(const Range& a, const Range& b) {
            return std::tie(a.name, a.offset, a.size) < std::tie(b.name, b.offset, b.size);
        }
        friend bool operator==(const Range&, const Range&) = default;
    };

    CityBytes();

    /// For City::open(). A range that is not here is an error there; `packs.bin`, whose digests of whole packs nobody
    /// compares who reads ranges, is empty.
    [[nodiscard]] std::shared_ptr<const Store> store() const;

    /// What was read and is not here, since the last call; ordered, each once.
    [[nodiscard]] std::vector<Range> wanted();
    /// Whether wanted() has any.
    [[nodiscard]] bool isWanting() const noexcept;
    /// \param bytes  of the range; fewer where the file ends in it
    /// \param total  size of the file; 0: there is none
    void give(const Range& range, std::string bytes, std::uint64_t total);
    /// The range cannot be had: reading it is an error with this message.
    void refuse(const Range& range, std::string message);
    /// Forgets bytes of packs, and what was refused. What is known of the index and the ids stays.
    void forget();

private:
    struct Held;
    std::shared_ptr<Held> held_;
};

}  // namespace svt::city
