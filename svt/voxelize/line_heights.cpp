#include <svt/voxelize/line_heights.hpp>

// This file is compiled once for each set of instructions.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svt/voxelize/line_heights.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svt::voxelize::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

std::uint64_t heightsAlong(const Level& level, std::int64_t first, std::int64_t step, std::int32_t count,
                           std::int32_t* heights) {
    const hn::CappedTag<std::int64_t, 8> d;
    const hn::RebindToUnsigned<decltype(d)> dUnsigned;
    const hn::Rebind<std::int32_t, decltype(d)> dHeight;
    const hn::RebindToUnsigned<decltype(dHeight)> dBits;
    const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
    const auto lowest = hn::Set(d, std::int64_t{level.lowest}), highest = hn::Set(d, std::int64_t{level.highest});
    const auto clamped = [&](auto height) HWY_ATTR {
        return hn::Max(lowest, hn::Min(highest, hn::ShiftRight<Level::kBits>(height)));
    };
    const auto one = hn::Set(d, step), all = hn::Set(d, lanes * step);
    auto height = hn::Add(hn::Set(d, first), hn::Mul(hn::Iota(d, 0), one));
    std::uint64_t breaks = 0;
    for (std::int32_t n = 0; n < count; n += lanes) {
        const auto k = clamped(height);
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, hn::Ne(k, clamped(hn::Sub(height, one))), bits);
        breaks |= std::uint64_t{bits[0]} << n;
        hn::StoreU(hn::BitCast(dHeight, hn::TruncateTo(dBits, hn::BitCast(dUnsigned, k))), dHeight, heights + n);
        height = hn::Add(height, all);
    }
    return breaks & (~std::uint64_t{0} >> (static_cast<std::int32_t>(kLineSamples) - count)) & ~std::uint64_t{1};
}

}  // namespace
}  // namespace svt::voxelize::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svt::voxelize {

HWY_EXPORT(heightsAlong);

std::uint64_t heightsAlong(const Level& level, std::int64_t first, std::int64_t step, std::int32_t count,
                           std::int32_t* heights) {
    return HWY_DYNAMIC_DISPATCH(heightsAlong)(level, first, step, count, heights);
}

}  // namespace svt::voxelize
#endif
