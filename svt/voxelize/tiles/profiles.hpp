#pragma once
/// \file
/// A profile is the sequence of boundaries that a vertical line crosses, in order, and the scalars between them.
/// Thousands of columns share one profile and differ only in the heights of the crossings, so the sweep that resolves
/// priority between overlapping claims runs once per profile, not once per column.
///
///     crossings, bottom up   room entry | room exit, attic entry | attic exit
///     isSameHeightPlane           0     |      0          1      |     0      of their codes; 1: as the one before
///     scalars between       0           | room                   | attic           | 0
///     changes                {plane 0, below 0} {plane 1, below room} {plane 2, below attic}, top 0

#include <svt/core/hash_index.hpp>
#include <svt/volume/column_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::voxelize {

/// A claim. Claims are indexed by priority ("order"): index 0 wins over all others.
struct PrioritizedClaim {
    volume::Scalar scalar = 0;
    std::uint32_t object = 0;
    bool isSolid = false;  ///< is counted in overlaps; sheets and thin parts are not
};

/// Number of voxels claimed by both of two claims.
struct OverlapCount {
    std::uint32_t first = 0, second = 0;  ///< orders, first < second
    std::uint64_t voxels = 0;
};

/// Sums of shared voxels per pair of claims.
class OverlapCounts {
public:
    /// Where more solids than this claim a voxel, only pairs with one of the first ones, by priority, are counted: n
    /// solids in one place would else be n^2 / 2 pairs.
    static constexpr std::size_t kFirst = 16;

    void add(const OverlapCount& shared);
    [[nodiscard]] std::span<const OverlapCount> sums() const noexcept { return sums_; }  ///< unordered
    void addCrowded(std::uint64_t voxels) noexcept { crowded_ += voxels; }
    /// Voxels that more than kFirst solids claim.
    [[nodiscard]] std::uint64_t crowded() const noexcept { return crowded_; }

private:
    std::uint64_t crowded_ = 0;
    HashIndex index_;
    std::vector<OverlapCount> sums_;
};

/// A crossing of a profile, packed into 32 bits: the claim, the direction, and whether it is at the same height plane
/// as the crossing before.
struct ProfileCode {
    std::uint32_t claim = 0;  ///< below 2^30
    bool isEntry = false, isSameHeightPlane = false;
    [[nodiscard]] std::uint32_t packed() const noexcept {
        return claim << 2 | std::uint32_t(isEntry) << 1 | std::uint32_t(isSameHeightPlane);
    }
    [[nodiscard]] static ProfileCode unpack(std::uint32_t code) noexcept {
        return {code >> 2, (code & 2) != 0, (code & 1) != 0};
    }
};

/// A change of the scalar in a profile.
struct ScalarChange {
    std::uint32_t heightPlane = 0;  ///< index of the height plane within the profile, bottom up
    volume::Scalar below = 0;
};

/// All profiles found so far, each stored once, and the voxels shared by solids in them. One instance per thread.
class Profiles {
public:
    explicit Profiles(std::span<const PrioritizedClaim> claims) : claims_(claims), winding_(claims.size(), 0) {}

    /// Number of the profile with these crossings (packed ProfileCodes, bottom up), added if it is new. Cost: O(n) if
    /// known, else O(n * claims active at once).
    [[nodiscard]] std::uint32_t find(std::span<const std::uint32_t> codes);

    [[nodiscard]] std::span<const ScalarChange> changes(std::uint32_t profile) const noexcept {
        const Profile& p = profiles_[profile];
        return std::span(changes_).subspan(p.firstChange, p.changeCount);
    }
    /// Scalar above the last crossing.
    [[nodiscard]] volume::Scalar topScalar(std::uint32_t profile) const noexcept { return profiles_[profile].top; }

    /// Calls `body(group, length)` for each non-empty interval of a column in which two or more solids (a group) are
    /// active.
    /// \param heights  first sample above each height plane of the profile, ascending, followed by the grid's depth
    template <class Body>
    void forEachShared(std::uint32_t profile, const std::int32_t* heights, Body&& body) const {
        const Profile& p = profiles_[profile];
        for (std::uint32_t s = p.firstShared; s < p.firstShared + p.sharedCount; ++s) {
            const std::int32_t* height = heights + shared_[s].heightPlane;
            if (height[1] > height[0]) body(shared_[s].group, static_cast<std::uint32_t>(height[1] - height[0]));
        }
    }
    /// Adds to the shared voxels of a group.
    void addShared(std::uint32_t group, std::uint64_t voxels) noexcept { groups_[group].voxels += voxels; }

    /// Adds the shared voxels of all groups to `counts`, then clears profiles and groups; their numbers become invalid.
    void takeCounts(OverlapCounts& counts);
    /// Measure of the memory in use: stored crossings and group members.
    [[nodiscard]] std::size_t size() const noexcept { return codes_.size() + groupMembers_.size(); }

private:
    struct Profile {
        std::uint32_t firstCode = 0, codeCount = 0;
        std::uint32_t firstChange = 0, changeCount = 0;
        std::uint32_t firstShared = 0, sharedCount = 0;
        volume::Scalar top = 0;
    };
    // An interval between two height planes in which two or more solids are active.
    struct SharedInterval {
        std::uint32_t heightPlane = 0;  // the lower one
        std::uint32_t group = 0;
    };
    // A set of solids that are active together, in any number of profiles.
    struct Group {
        std::uint32_t firstMember = 0, memberCount = 0;  // range of groupMembers_: orders, ascending
        std::uint64_t voxels = 0;
    };

    std::uint32_t add(std::span<const std::uint32_t> codes);
    std::size_t passHeightPlane(std::span<const std::uint32_t> codes, std::size_t first);
    std::uint32_t findGroup(std::span<const std::uint32_t> solids);
    [[nodiscard]] std::span<const std::uint32_t> codesOf(const Profile& p) const noexcept {
        return std::span(codes_).subspan(p.firstCode, p.codeCount);
    }
    [[nodiscard]] std::span<const std::uint32_t> membersOf(const Group& g) const noexcept {
        return std::span(groupMembers_).subspan(g.firstMember, g.memberCount);
    }

    std::span<const PrioritizedClaim> claims_;
    std::vector<Profile> profiles_;
    HashIndex index_{1024};
    std::vector<std::uint32_t> codes_;
    std::vector<ScalarChange> changes_;
    std::vector<SharedInterval> shared_;
    std::vector<Group> groups_;
    HashIndex groupIndex_;
    std::vector<std::uint32_t> groupMembers_;
    std::vector<std::int32_t> winding_;  // per order; all zero outside of add()
    std::vector<std::uint32_t> active_;  // orders with winding > 0, ascending
    std::vector<std::uint32_t> solids_;  // the solids among active_
};

}  // namespace svt::voxelize
