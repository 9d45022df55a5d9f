#include <svt/core/simd_targets.hpp>
#include <svt/volume/bricks/side_masks.hpp>

#include <algorithm>

// Highway compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svt/volume/bricks/side_masks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svt::volume::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

bool findSides(double first, const Vec3d& normal, double margin, SideMask& mask) {
    const hn::CappedTag<double, 8> d;
    const std::size_t lanes = hn::Lanes(d);
    double along[8], least[8];
    for (int i = 0; i < 8; ++i) along[i] = normal.x * i;
    auto nearest = hn::Set(d, 1e300);
    for (std::size_t k = 0; k < 8; ++k) {
        std::uint64_t word = 0;
        for (std::size_t j = 0; j < 8; ++j) {
            const auto row = hn::Set(d, first + normal.y * static_cast<double>(j) + normal.z * static_cast<double>(k));
            for (std::size_t i = 0; i < 8; i += lanes) {
                const auto value = hn::Add(row, hn::LoadU(d, along + i));
                nearest = hn::Min(nearest, hn::Abs(value));
                std::uint8_t bits[8] = {};
                hn::StoreMaskBits(d, hn::Gt(value, hn::Zero(d)), bits);
                word |= std::uint64_t{bits[0]} << (i + 8 * j);
            }
        }
        mask[k] = word;
    }
    hn::StoreU(nearest, d, least);
    return *std::min_element(least, least + lanes) >= margin;
}

}  // namespace
}  // namespace svt::volume::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svt::volume {

HWY_EXPORT(findSides);

bool findSides(double first, Vec3d normal, double margin, SideMask& mask) noexcept {
    return HWY_DYNAMIC_DISPATCH(findSides)(first, normal, margin, mask);
}

}  // namespace svt::volume
#endif
