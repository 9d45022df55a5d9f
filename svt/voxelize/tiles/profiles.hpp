#pragma once
/// \file
/// Profiles: what a vertical line reads when it meets given boundaries in a given order. Columns by the
/// thousand share one profile and differ in heights alone, so the sweep that settles who owns what runs once for each.

#include <svt/core/hash_index.hpp>
#include <svt/volume/column_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::voxelize {

/// A claim in order of priority: index 0 wins over all others.
struct OrderedClaim {
    volume::Scalar scalar = 0;
    std::uint32_t object = 0;
    bool isSolid = false;  ///< counts in overlaps; sheets and thin parts do not
};

/// Voxels that two claims share.
struct SharedCount {
    std::uint32_t first = 0, second = 0;  ///< orders, first < second
    std::uint64_t voxels = 0;
};

/// What is shared, summed up for each two claims.
class SharedCounts {
public:
    void add(const SharedCount& shared);
    [[nodiscard]] std::span<const SharedCount> sums() const noexcept { return sums_; }  ///< in no order

private:
    HashIndex index_;
    std::vector<SharedCount> sums_;
};

/// A crossing of a profile, packed: which claim's boundary, in which direction, and whether it lies at the level of the
/// crossing before.
struct ProfileCode {
    std::uint32_t claim = 0;  ///< below 2^30
    bool isEntry = false, isLevel = false;
    [[nodiscard]] std::uint32_t packed() const noexcept {
        return claim << 2 | std::uint32_t(isEntry) << 1 | std::uint32_t(isLevel);
    }
    [[nodiscard]] static ProfileCode unpack(std::uint32_t code) noexcept {
        return {code >> 2, (code & 2) != 0, (code & 1) != 0};
    }
};

/// Where a profile's scalar changes.
struct ScalarChange {
    std::uint32_t level = 0;  ///< number of the level, bottom up
    volume::Scalar below = 0;
};

/// All profiles met so far, and how many voxels lie in their intervals. One per thread.
class Profiles {
public:
    explicit Profiles(std::span<const OrderedClaim> claims) : claims_(claims), winding_(claims.size(), 0) {}

    /// Number of the profile with these crossings (packed ProfileCodes, bottom up). Cost: O(n) where known, else
    /// O(n * claims active at once).
    [[nodiscard]] std::uint32_t find(std::span<const std::uint32_t> codes);

    [[nodiscard]] std::span<const ScalarChange> changes(std::uint32_t profile) const noexcept {
        const Profile& p = profiles_[profile];
        return std::span(changes_).subspan(p.firstChange, p.changeCount);
    }
    /// Above the last crossing.
    [[nodiscard]] volume::Scalar topScalar(std::uint32_t profile) const noexcept { return profiles_[profile].top; }

    /// Calls `body(group, length)` for each interval in which a group of two solids or more is active and that is not
    /// empty where a column meets the profile's levels at `heights` (first sample above, ascending; one more than
    /// levels, the last is the grid's depth).
    template <class Body>
    void forEachShared(std::uint32_t profile, const std::int32_t* heights, Body&& body) const {
        const Profile& p = profiles_[profile];
        for (std::uint32_t s = p.firstShared; s < p.firstShared + p.sharedCount; ++s) {
            const std::int32_t* height = heights + shared_[s].level;
            if (height[1] > height[0]) body(shared_[s].group, static_cast<std::uint32_t>(height[1] - height[0]));
        }
    }
    /// Adds voxels that a group shares.
    void addShared(std::uint32_t group, std::uint64_t voxels) noexcept { groups_[group].voxels += voxels; }

    /// Adds what solids share to `counts` and forgets all profiles and groups: their numbers are no longer valid.
    void takeCounts(SharedCounts& counts);
    /// How much memory is in use, in crossings and solids kept.
    [[nodiscard]] std::size_t size() const noexcept { return codes_.size() + groupMembers_.size(); }

private:
    struct Profile {
        std::uint32_t firstCode = 0, codeCount = 0;
        std::uint32_t firstChange = 0, changeCount = 0;
        std::uint32_t firstShared = 0, sharedCount = 0;
        volume::Scalar top = 0;
    };
    // Between two levels, where two solids or more are active.
    struct SharedInterval {
        std::uint32_t level = 0;  // the lower one
        std::uint32_t group = 0;
    };
    // Solids that are active together, in this or that profile.
    struct Group {
        std::uint32_t firstMember = 0, memberCount = 0;  // of groupMembers_: orders, ascending
        std::uint64_t voxels = 0;
    };

    std::uint32_t add(std::span<const std::uint32_t> codes);
    std::size_t passLevel(std::span<const std::uint32_t> codes, std::size_t first);
    std::uint32_t findGroup(std::span<const std::uint32_t> solids);
    [[nodiscard]] std::span<const std::uint32_t> codesOf(const Profile& p) const noexcept {
        return std::span(codes_).subspan(p.firstCode, p.codeCount);
    }
    [[nodiscard]] std::span<const std::uint32_t> membersOf(const Group& g) const noexcept {
        return std::span(groupMembers_).subspan(g.firstMember, g.memberCount);
    }

    std::span<const OrderedClaim> claims_;
    std::vector<Profile> profiles_;
    HashIndex index_{1024};
    std::vector<std::uint32_t> codes_;
    std::vector<ScalarChange> changes_;
    std::vector<SharedInterval> shared_;
    std::vector<Group> groups_;
    HashIndex groupIndex_;
    std::vector<std::uint32_t> groupMembers_;
    std::vector<std::int32_t> winding_;  // per order; all zero between sweeps
    std::vector<std::uint32_t> active_;  // orders with winding > 0, ascending
    std::vector<std::uint32_t> solids_;  // the solids among them
};

}  // namespace svt::voxelize
