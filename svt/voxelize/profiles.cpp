#include <svt/voxelize/profiles.hpp>

#include <algorithm>
#include <tuple>

namespace svt::voxelize {
namespace {

std::uint64_t hashCodes(std::span<const std::uint32_t> codes) noexcept {
    std::uint64_t hash = codes.size();
    for (const std::uint32_t code : codes) hash = (hash ^ hash >> 29 ^ code) * 0x9E3779B97F4A7C15ull;
    return hash;
}

}  // namespace

void joinCounts(std::vector<SharedCount>& counts) {
    std::sort(counts.begin(), counts.end(), [](const SharedCount& p, const SharedCount& q) {
        return std::tie(p.first, p.second) < std::tie(q.first, q.second);
    });
    std::size_t kept = 0;
    for (std::size_t i = 1; i < counts.size(); ++i) {
        if (counts[kept].first == counts[i].first && counts[kept].second == counts[i].second)
            counts[kept].voxels += counts[i].voxels;
        else
            counts[++kept] = counts[i];
    }
    if (!counts.empty()) counts.resize(kept + 1);
}

std::uint32_t Profiles::find(std::span<const std::uint32_t> codes) {
    return index_.findOrAdd(
        hashCodes(codes), [&](std::uint32_t number) { return std::ranges::equal(codesOf(profiles_[number]), codes); },
        [&] { return add(codes); });
}

// Crosses all that lies at the level of codes[first]; returns where the next level begins.
std::size_t Profiles::passLevel(std::span<const std::uint32_t> codes, std::size_t first) {
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
    } while (c < codes.size() && ProfileCode::unpack(codes[c]).isLevel);
    return c;
}

void Profiles::leaveAll(std::span<const std::uint32_t> codes) {
    for (const std::uint32_t code : codes) winding_[ProfileCode::unpack(code).claim] = 0;
    active_.clear();
}

std::uint32_t Profiles::add(std::span<const std::uint32_t> codes) {
    Profile profile;
    profile.firstCode = static_cast<std::uint32_t>(codes_.size());
    profile.codeCount = static_cast<std::uint32_t>(codes.size());
    profile.firstChange = static_cast<std::uint32_t>(changes_.size());
    profile.firstShared = static_cast<std::uint32_t>(shared_.size());
    codes_.insert(codes_.end(), codes.begin(), codes.end());
    const auto isSolid = [&](std::uint32_t claim) { return claims_[claim].isSolid; };
    volume::Scalar scalar = 0;
    std::uint32_t level = 0;
    for (std::size_t c = 0; c < codes.size(); ++level) {
        c = passLevel(codes, c);
        const volume::Scalar above = active_.empty() ? 0 : claims_[active_.front()].scalar;
        if (above != scalar) changes_.push_back({level, scalar});
        scalar = above;
        if (std::count_if(active_.begin(), active_.end(), isSolid) > 1) shared_.push_back({level, 0});
    }
    leaveAll(codes);
    profile.top = scalar;
    profile.changeCount = static_cast<std::uint32_t>(changes_.size()) - profile.firstChange;
    profile.sharedCount = static_cast<std::uint32_t>(shared_.size()) - profile.firstShared;
    profiles_.push_back(profile);
    return static_cast<std::uint32_t>(profiles_.size() - 1);
}

void Profiles::takeCounts(std::vector<SharedCount>& counts) {
    constexpr std::size_t kFew = 1 << 16;
    std::size_t joined = counts.size();
    for (const Profile& profile : profiles_) {
        if (profile.sharedCount == 0) continue;
        const auto codes = codesOf(profile);
        std::size_t c = 0;
        std::uint32_t level = 0;
        for (std::uint32_t s = profile.firstShared; s < profile.firstShared + profile.sharedCount; ++s) {
            for (; level <= shared_[s].level; ++level) c = passLevel(codes, c);
            if (shared_[s].voxels == 0) continue;
            for (std::size_t a = 0; a + 1 < active_.size(); ++a) {
                if (!claims_[active_[a]].isSolid) continue;
                for (std::size_t b = a + 1; b < active_.size(); ++b)
                    if (claims_[active_[b]].isSolid) counts.push_back({active_[a], active_[b], shared_[s].voxels});
            }
            if (counts.size() > 2 * joined + kFew) {
                joinCounts(counts);
                joined = counts.size();
            }
        }
        leaveAll(codes);
    }
    profiles_.clear();
    index_.clear();
    codes_.clear();
    changes_.clear();
    shared_.clear();
}

}  // namespace svt::voxelize
