#pragma once
/// \file
/// Builds all coarse levels of a city in one pass over its members of detail 1.

#include <svt/city/city_folder.hpp>
#include <svt/city/levels/level_sums.hpp>

#include <functional>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

namespace svt::city {

/// Columns of detail 1, [first, last] along each axis, that a member may fill, and its tile.
struct ColumnRange {
    std::array<std::int64_t, 2> first{}, last{};
    TileKey tile{};

    void add(const ColumnRange& other);
};

/// A tile of a coarse level as a `.svt`.
struct LevelMember {
    PackMember member;
    std::vector<std::byte> bytes;
};

/// The detail whose single tile holds the whole city: the first where `whole` has at most 256 columns along each axis.
[[nodiscard]] int topDetail(const ColumnRange& whole) noexcept;

/// A tile has all of the members below it, so that no building is cut: it may reach over its square. Tiles are open
/// from the first member below them to the last one. Then they become a `.svt` and are added to the tile above.
/// Memory: the tiles along the border of the finished part, about 5 MB each.
class LevelBuilder {
public:
    /// \param members  columns of each member, in the order in which they are added; at least one
    LevelBuilder(std::span<const ColumnRange> members, double spacing, std::string crsName, int threads);

    [[nodiscard]] int top() const noexcept { return top_; }
    [[nodiscard]] const LevelClasses& classes() const noexcept { return classes_; }

    /// Adds the next members. Returns finished tiles, those of one detail along the Morton curve.
    [[nodiscard]] Result<void> add(std::span<const volume::SemanticVolume> volumes,
                                   const std::function<Result<void>(LevelMember)>& give);

private:
    struct Key {
        int detail = 0;
        std::uint64_t morton = 0;
        TileKey tile;
        friend bool operator<(const Key& a, const Key& b) {
            return std::tie(a.detail, a.morton) < std::tie(b.detail, b.morton);
        }
    };
    struct Open {
        std::uint32_t left = 0;  // members or tiles below that are still to come
        std::optional<ColumnRange> range;
        std::optional<LevelSums> sums;
    };
    struct Ready {
        Key key;
        LevelSums sums;
    };

    [[nodiscard]] Key tileOf(const ColumnRange& member) const;
    [[nodiscard]] Key above(const Key& key) const;
    [[nodiscard]] LevelSums emptySums(const Key& key) const;
    template <class Source>
    void addTo(const Key& key, const Source& source, std::vector<Ready>& ready);
    [[nodiscard]] Result<LevelMember> memberOf(const Ready& ready) const;
    Result<void> giveInOrder(const std::function<Result<void>(LevelMember)>& give);

    std::vector<ColumnRange> members_;
    double spacing_;
    std::string crsName_;
    int threads_, top_;
    ColumnRange whole_;
    std::size_t next_ = 0;
    LevelClasses classes_;
    std::map<Key, Open> open_;            // all that are not finished
    std::map<Key, LevelMember> waiting_;  // finished, but one before them is not
};

}  // namespace svt::city
