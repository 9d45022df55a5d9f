#include <svt/voxelize/profiles.hpp>

#include <algorithm>
#include <tuple>

namespace svt::voxelize {
namespace {

constexpr std::size_t kFirstTable = 1024;

std::uint64_t hashCodes(std::span<const std::uint32_t> codes) noexcept {
    std::uint64_t hash = codes.size();
    for (const std::uint32_t code : codes) hash = (hash ^ code) * 0x9E3779B97F4A7C15ull;
    return hash ^ hash >> 32;
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
    if (table_.empty()) table_.assign(kFirstTable, 0);
    const std::uint64_t hash = hashCodes(codes);
    const std::size_t mask = table_.size() - 1;
    std::size_t slot = hash & mask;
    for (; table_[slot] != 0; slot = (slot + 1) & mask) {
        const std::uint32_t number = table_[slot] - 1;
        if (profiles_[number].hash == hash && std::ranges::equal(codesOf(profiles_[number]), codes)) return number;
    }
    table_[slot] = static_cast<std::uint32_t>(profiles_.size() + 1);
    const std::uint32_t number = add(codes, hash);
    if (profiles_.size() * 2 > table_.size()) growTable();
    return number;
}

void Profiles::growTable() {
    table_.assign(table_.size() * 2, 0);
    const std::size_t mask = table_.size() - 1;
    for (std::uint32_t number = 0; number < profiles_.size(); ++number) {
        std::size_t slot = profiles_[number].hash & mask;
        while (table_[slot] != 0) slot = (slot + 1) & mask;
        table_[slot] = number + 1;
    }
}

void Profiles::pass(std::uint32_t code) {
    const BoundaryCode boundary = BoundaryCode::unpack(code);
    std::int32_t& winding = winding_[boundary.claim];
    if (boundary.isEntry) {
        if (++winding == 1)
            active_.insert(std::lower_bound(active_.begin(), active_.end(), boundary.claim), boundary.claim);
    } else if (--winding == 0) {
        active_.erase(std::lower_bound(active_.begin(), active_.end(), boundary.claim));
    }
}

void Profiles::leaveAll(std::span<const std::uint32_t> codes) {
    for (const std::uint32_t code : codes) winding_[BoundaryCode::unpack(code).claim] = 0;
    active_.clear();
}

std::uint32_t Profiles::add(std::span<const std::uint32_t> codes, std::uint64_t hash) {
    Profile profile;
    profile.hash = hash;
    profile.firstCode = static_cast<std::uint32_t>(codes_.size());
    profile.codeCount = static_cast<std::uint32_t>(codes.size());
    profile.firstChange = static_cast<std::uint32_t>(changes_.size());
    profile.firstShared = static_cast<std::uint32_t>(shared_.size());
    codes_.insert(codes_.end(), codes.begin(), codes.end());
    volume::Scalar scalar = 0;
    for (std::uint32_t c = 0; c < codes.size(); ++c) {
        pass(codes[c]);
        const volume::Scalar above = active_.empty() ? 0 : claims_[active_.front()].scalar;
        if (above != scalar) changes_.push_back({c, scalar});
        scalar = above;
        const auto isSolid = [&](std::uint32_t claim) { return claims_[claim].isSolid; };
        if (std::count_if(active_.begin(), active_.end(), isSolid) > 1) shared_.push_back({c, 0});
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
        std::uint32_t c = 0;
        for (std::uint32_t s = profile.firstShared; s < profile.firstShared + profile.sharedCount; ++s) {
            while (c <= shared_[s].crossing) pass(codes[c++]);
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
    table_.clear();
    codes_.clear();
    changes_.clear();
    shared_.clear();
}

}  // namespace svt::voxelize
