#pragma once
/// \file
/// Numbers 0 to n - 1 in groups that are joined two at a time (union-find).

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace svt::validate {

class Groups {
public:
    /// Each number is a group of its own.
    explicit Groups(std::size_t count = 0) : leader_(count) {
        std::iota(leader_.begin(), leader_.end(), std::size_t{0});
    }
    /// The least number of the group of i.
    [[nodiscard]] std::size_t leaderOf(std::size_t i) {
        while (leader_[i] != i) i = leader_[i] = leader_[leader_[i]];
        return i;
    }
    void join(std::size_t a, std::size_t b) {
        a = leaderOf(a);
        b = leaderOf(b);
        leader_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::size_t> leader_;
};

}  // namespace svt::validate
