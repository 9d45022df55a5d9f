#include <svt/core/hash.hpp>
#include <svt/voxelize/tiles/profiles.hpp>

#include <algorithm>

namespace svt::voxelize {
namespace {

std::uint64_t hashOf(std::span<const std::uint32_t> numbers) noexcept {
    std::uint64_t hash = numbers.size();
    for (const std::uint32_t number : numbers) hash = mixHash(hash, number);
    return hash;
}

}  // namespace

void OverlapCounts::add(const OverlapCount& shared) {
    const auto isSame = [&](std::uint32_t number) {
        return sums_[number].first == shared.first && sums_[number].second == shared.second;
    };
    const std::uint64_t hash = mixHash(0, std::uint64_t{shared.first} << 32 | shared.second);
    const std::uint32_t number = index_.findOrAdd(hash, isSame, [&] {
        sums_.push_back({shared.first, shared.second, 0});
        return static_cast<std::uint32_t>(sums_.size() - 1);
    });
    sums_[number].voxels += shared.voxels;
}

std::uint32_t Profiles::find(std::span<const std::uint32_t> codes) {
    return index_.findOrAdd(
        hashOf(codes), [&](std::uint32_t number) { return std::ranges::equal(codesOf(profiles_[number]), codes); },
        [&] { return add(codes); });
}

// Processes all crossings at the height plane of codes[first]; returns the index of the first crossing of the next
// height plane.
std::size_t Profiles::passHeightPlane(std::span<const std::uint32_t> codes, std::size_t first) {
    std::size_t c = first;
    do {
        const ProfileCode code = ProfileCode::unpack(codes[c]);
        std::int32_t& winding = winding_[code.claim];
        if (code.isEntry) {
            if (++winding == 1)
                active_.insert(std::lower_bound(active_.begin(), active_.end(), code.claim), code.claim);
        } else if (--winding == 0) {
            active_.erase(std::lower_bound(active_.begin(), active_.end(), code.claim));
        }
        ++c;
    } while (c < codes.size() && ProfileCode::unpack(codes[c]).isSameHeightPlane);
    return c;
}

std::uint32_t Profiles::findGroup(std::span<const std::uint32_t> solids) {
    return groupIndex_.findOrAdd(
        hashOf(solids), [&](std::uint32_t number) { return std::ranges::equal(membersOf(groups_[number]), solids); },
        [&] {
            groups_.push_back(
                {static_cast<std::uint32_t>(groupMembers_.size()), static_cast<std::uint32_t>(solids.size()), 0});
            groupMembers_.insert(groupMembers_.end(), solids.begin(), solids.end());
            return static_cast<std::uint32_t>(groups_.size() - 1);
        });
}

std::uint32_t Profiles::add(std::span<const std::uint32_t> codes) {
    Profile profile;
    profile.firstCode = static_cast<std::uint32_t>(codes_.size());
    profile.codeCount = static_cast<std::uint32_t>(codes.size());
    profile.firstChange = static_cast<std::uint32_t>(changes_.size());
    profile.firstShared = static_cast<std::uint32_t>(shared_.size());
    codes_.insert(codes_.end(), codes.begin(), codes.end());
    volume::Scalar scalar = 0;
    std::uint32_t heightPlane = 0;
    for (std::size_t c = 0; c < codes.size(); ++heightPlane) {
        c = passHeightPlane(codes, c);
        const volume::Scalar above = active_.empty() ? 0 : claims_[active_.front()].scalar;
        if (above != scalar) changes_.push_back({heightPlane, scalar});
        scalar = above;
        solids_.clear();
        for (const std::uint32_t claim : active_)
            if (claims_[claim].isSolid) solids_.push_back(claim);
        if (solids_.size() > 1) shared_.push_back({heightPlane, findGroup(solids_)});
    }
    for (const std::uint32_t code : codes) winding_[ProfileCode::unpack(code).claim] = 0;
    active_.clear();
    profile.top = scalar;
    profile.changeCount = static_cast<std::uint32_t>(changes_.size()) - profile.firstChange;
    profile.sharedCount = static_cast<std::uint32_t>(shared_.size()) - profile.firstShared;
    profiles_.push_back(profile);
    return static_cast<std::uint32_t>(profiles_.size() - 1);
}

void Profiles::takeCounts(OverlapCounts& counts) {
    for (const Group& group : groups_) {
        if (group.voxels == 0) continue;
        const auto members = membersOf(group);
        if (members.size() > OverlapCounts::kFirst) counts.addCrowded(group.voxels);
        for (std::size_t a = 0; a + 1 < members.size() && a < OverlapCounts::kFirst; ++a)
            for (std::size_t b = a + 1; b < members.size(); ++b) counts.add({members[a], members[b], group.voxels});
    }
    profiles_.clear();
    index_.clear();
    codes_.clear();
    changes_.clear();
    shared_.clear();
    groups_.clear();
    groupIndex_.clear();
    groupMembers_.clear();
}

}  // namespace svt::voxelize
