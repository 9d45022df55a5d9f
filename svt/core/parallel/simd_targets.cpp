#include <svt/core/simd_targets.hpp>

#include <hwy/targets.h>

namespace svt {

std::string_view simdTargetName() noexcept {
    // The best of those that are both compiled and supported; better targets have lower bits.
    const auto usable = hwy::SupportedTargets() & HWY_TARGETS;
    return hwy::TargetName(usable & -usable);
}

}  // namespace svt
