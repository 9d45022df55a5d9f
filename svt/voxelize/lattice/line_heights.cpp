#include <svt/core/simd_targets.hpp>
#include <svt/voxelize/lattice/line_heights.hpp>

// Highway compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svt/voxelize/lattice/line_heights.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svt::voxelize::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

std::uint64_t heightsAlong(std::span<const LineHeightPlane> heightPlanes, std::int32_t count, std::uint32_t seed,
                           std::int32_t* line) {
    const hn::CappedTag<std::int64_t, 8> d;
    const hn::RebindToUnsigned<decltype(d)> dUnsigned;
    const hn::Rebind<std::int32_t, decltype(d)> dHeight;
    const hn::RebindToUnsigned<decltype(dHeight)> dHash;
    const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
    const auto factor = hn::Set(dHash, 0x9E3779B1u);
    auto sample = hn::Iota(d, 0);
    std::uint64_t breaks = 0;
    for (std::int32_t n = 0; n < count; n += lanes, sample = hn::Add(sample, hn::Set(d, lanes))) {
        auto hash = hn::Set(dHash, seed);
        auto differs = hn::MaskFromVec(hn::Zero(d));
        std::int32_t* to = line + n;
        for (const LineHeightPlane& heightPlane : heightPlanes) {
            const auto lowest = hn::Set(d, std::int64_t{heightPlane.lowest}),
                       highest = hn::Set(d, std::int64_t{heightPlane.highest});
            const auto clamped = [&](auto height) HWY_ATTR {
                return hn::Max(lowest, hn::Min(highest, hn::ShiftRight<HeightPlane::kBits>(height)));
            };
            const auto step = hn::Set(d, heightPlane.step);
            const auto height = hn::Add(hn::Set(d, heightPlane.first), hn::Mul(sample, step));
            const auto k = clamped(height);
            differs = hn::Or(differs, hn::Ne(k, clamped(hn::Sub(height, step))));
            const auto narrow = hn::TruncateTo(dHash, hn::BitCast(dUnsigned, k));
            hash = hn::Mul(hn::Add(hash, narrow), factor);
            to += kLineSamples;
            hn::StoreU(hn::BitCast(dHeight, narrow), dHeight, to);
        }
        hn::StoreU(hn::BitCast(dHeight, hash), dHeight, line + n);
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, differs, bits);
        breaks |= std::uint64_t{bits[0]} << n;
    }
    return breaks & (~std::uint64_t{0} >> (static_cast<std::int32_t>(kLineSamples) - count)) & ~std::uint64_t{1};
}

}  // namespace
}  // namespace svt::voxelize::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svt::voxelize {

HWY_EXPORT(heightsAlong);

std::uint64_t heightsAlong(std::span<const LineHeightPlane> heightPlanes, std::int32_t count, std::uint32_t seed,
                           std::int32_t* line) {
    return HWY_DYNAMIC_DISPATCH(heightsAlong)(heightPlanes, count, seed, line);
}

}  // namespace svt::voxelize
#endif
