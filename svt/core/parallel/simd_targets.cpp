#include <svt/core/simd_targets.hpp>

#include <hwy/targets.h>

#include <cstdint>

namespace svt {

std::string_view simdTargetName() noexcept {
    // The best of those that are both compiled and supported; better targets have lower bits.
    const auto usable = hwy::SupportedTargets() & HWY_TARGETS;
    return hwy::TargetName(usable & -usable);
}

std::vector<std::string_view> compiledSimdTargets() {
    std::vector<std::string_view> names;
    for (auto targets = std::int64_t{HWY_TARGETS}; targets != 0; targets &= targets - 1)
        names.emplace_back(hwy::TargetName(targets & -targets));
    return names;
}

}  // namespace svt
