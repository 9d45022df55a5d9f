#pragma once
/// \file
/// Points that lie within a distance of each other as one.

#include <svt/core/vec.hpp>

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace svt::readers::ifc {

/// Numbers points; one within `distance` (along each axis) of an earlier one gets its number. The first of several stands.
class Welder {
public:
    explicit Welder(double distance) : distance_(distance) {}

    /// Cost: O(1) but for many points in one cell.
    std::uint32_t add(Vec3d p) {
        const std::int64_t i = cell(p.x), j = cell(p.y), k = cell(p.z);
        for (std::int64_t dx = -1; dx <= 1; ++dx)
            for (std::int64_t dy = -1; dy <= 1; ++dy)
                for (std::int64_t dz = -1; dz <= 1; ++dz) {
                    const auto found = first_.find(key(i + dx, j + dy, k + dz));
                    if (found == first_.end()) continue;
                    for (std::uint32_t n = found->second; n != kNone; n = next_[n])
                        if (std::abs(points_[n].x - p.x) <= distance_ && std::abs(points_[n].y - p.y) <= distance_ &&
                            std::abs(points_[n].z - p.z) <= distance_)
                            return n;
                }
        const auto number = static_cast<std::uint32_t>(points_.size());
        points_.push_back(p);
        const auto [it, isNew] = first_.try_emplace(key(i, j, k), number);
        next_.push_back(isNew ? kNone : it->second);
        it->second = number;
        return number;
    }

    [[nodiscard]] const std::vector<Vec3d>& points() const noexcept { return points_; }

private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    [[nodiscard]] std::int64_t cell(double value) const noexcept {
        const double scaled = std::floor(value / (2 * distance_));
        return std::abs(scaled) < 4e18 ? static_cast<std::int64_t>(scaled) : 0;
    }
    [[nodiscard]] static std::uint64_t key(std::int64_t i, std::int64_t j, std::int64_t k) noexcept {
        return std::uint64_t(i) * 0x9E3779B97F4A7C15u ^ std::uint64_t(j) * 0xC2B2AE3D27D4EB4Fu ^
               std::uint64_t(k) * 0x165667B19E3779F9u;
    }

    double distance_;
    std::vector<Vec3d> points_;
    std::vector<std::uint32_t> next_;  // in the same cell
    std::unordered_map<std::uint64_t, std::uint32_t> first_;
};

}  // namespace svt::readers::ifc
