#include <svt/core/simd_targets.hpp>
#include <svt/voxelize/lattice/edge_columns.hpp>

// Highway compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svt/voxelize/lattice/edge_columns.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svt::voxelize::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// EdgeWalk vectorized: each SIMD lane holds one row, and all lanes advance together by the number of lanes.
EdgeRows edgeColumns(const EdgeWalk& walk, std::int32_t firstColumn, std::int32_t width, std::int32_t count,
                     std::uint8_t* columns) {
    const hn::CappedTag<std::int64_t, 8> d;
    const hn::RebindToUnsigned<decltype(d)> dUnsigned;
    const hn::Rebind<std::uint8_t, decltype(d)> dColumn;
    const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
    const std::int64_t denominator = walk.denominator();
    const auto one = hn::Set(d, 1), whole = hn::Set(d, denominator);
    const auto step = hn::Set(d, walk.step()), remainderStep = hn::Set(d, walk.remainderStep());

    // Advancing n rows adds up to n denominators to the remainder: carry them into the column by binary subtraction.
    const auto carry = [&](auto& column, auto& remainder) HWY_ATTR {
        for (std::int64_t times = lanes / 2; times > 0; times /= 2) {
            const auto part = hn::Set(d, times * denominator);
            const auto isOver = hn::Not(hn::Lt(remainder, part));
            remainder = hn::Sub(remainder, hn::IfThenElseZero(isOver, part));
            column = hn::Add(column, hn::IfThenElseZero(isOver, hn::Set(d, times)));
        }
    };
    auto column = hn::Add(hn::Set(d, walk.sample() - firstColumn), hn::Mul(hn::Iota(d, 0), step));  // lane n: row n
    auto remainder = hn::Add(hn::Set(d, walk.remainder()), hn::Mul(hn::Iota(d, 0), remainderStep));
    carry(column, remainder);
    auto columnStride = hn::Set(d, lanes * walk.step()), remainderStride = hn::Set(d, lanes * walk.remainderStep());
    carry(columnStride, remainderStride);

    EdgeRows rows;
    const auto end = hn::Set(d, std::int64_t{width});
    const auto bitsOf = [&](auto mask) HWY_ATTR {
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, mask, bits);
        return std::uint64_t{bits[0]};
    };
    for (std::int32_t n = 0; n < count; n += lanes) {
        const auto isWest = hn::Lt(column, one);
        // The remainder is below remainderStep exactly where it has just wrapped: that step was one column longer.
        const auto moved = hn::Add(step, hn::IfThenElseZero(hn::Lt(remainder, remainderStep), one));
        rows.west |= bitsOf(isWest) << n;
        rows.within |= bitsOf(hn::AndNot(isWest, hn::Lt(column, end))) << n;
        rows.moves |= bitsOf(hn::Ne(moved, hn::Zero(d))) << n;
        hn::StoreU(hn::TruncateTo(dColumn, hn::BitCast(dUnsigned, column)), dColumn, columns + n);
        remainder = hn::Add(remainder, remainderStride);
        const auto isOver = hn::Not(hn::Lt(remainder, whole));
        remainder = hn::Sub(remainder, hn::IfThenElseZero(isOver, whole));
        column = hn::Add(column, hn::Add(columnStride, hn::IfThenElseZero(isOver, one)));
    }
    const std::uint64_t all = ~std::uint64_t{0} >> (64 - count);
    return {rows.west & all, rows.within & all, rows.moves & all};
}

}  // namespace
}  // namespace svt::voxelize::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svt::voxelize {

HWY_EXPORT(edgeColumns);

EdgeRows edgeColumns(const EdgeWalk& walk, std::int32_t firstColumn, std::int32_t width, std::int32_t count,
                     std::uint8_t* columns) {
    return HWY_DYNAMIC_DISPATCH(edgeColumns)(walk, firstColumn, width, count, columns);
}

}  // namespace svt::voxelize
#endif
