#include <svt/core/simd_targets.hpp>
#include <svt/voxelize/surfaces/lid_samples.hpp>

// Highway compiles this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svt/voxelize/surfaces/lid_samples.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svt::voxelize::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<double, 8>;
using V = hn::Vec<Lanes>;

// From the samples to a corner of a piece.
struct Rays {
    V x, y, z, length;
};

HWY_INLINE V sumOfProducts(V a, V b, V c, V d, V e, V f) {
    return hn::Add(hn::Add(hn::Mul(a, b), hn::Mul(c, d)), hn::Mul(e, f));
}

HWY_INLINE V dotOf(const Rays& a, const Rays& b) { return sumOfProducts(a.x, b.x, a.y, b.y, a.z, b.z); }

HWY_INLINE V crossOf(V a, V b, V c, V d) { return hn::Sub(hn::Mul(a, b), hn::Mul(c, d)); }

// Argument of a complex number, in full turns, -1/2 to 1/2, with an error of less than 1e-5.
HWY_INLINE V argument(V real, V imaginary) {
    const Lanes d;
    const V x = hn::Abs(real), y = hn::Abs(imaginary);
    const V larger = hn::Max(hn::Max(x, y), hn::Set(d, 1e-300)), t = hn::Div(hn::Min(x, y), larger);
    // atan t for 0 <= t <= 1 (Abramowitz & Stegun 4.4.49), over 2 pi
    const V square = hn::Mul(t, t);
    V sum = hn::Set(d, 0.0208351);
    for (const double next : {-0.0851330, 0.1801410, -0.3302995, 0.9998660})
        sum = hn::Add(hn::Mul(sum, square), hn::Set(d, next));
    V turns = hn::Mul(hn::Mul(sum, t), hn::Set(d, 0.15915494309189535));
    turns = hn::IfThenElse(hn::Gt(y, x), hn::Sub(hn::Set(d, 0.25), turns), turns);
    turns = hn::IfThenElse(hn::Lt(real, hn::Zero(d)), hn::Sub(hn::Set(d, 0.5), turns), turns);
    return hn::IfThenElse(hn::Lt(imaginary, hn::Zero(d)), hn::Neg(turns), turns);
}

// TurnCounter for many samples.
struct Product {
    V real, imaginary, turns;

    HWY_INLINE void multiply(V r, V i) {
        const Lanes d;
        const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
        const V x = hn::Sub(hn::Mul(real, r), hn::Mul(imaginary, i));
        const V y = hn::Add(hn::Mul(real, i), hn::Mul(imaginary, r));
        const auto isLow = hn::Lt(imaginary, zero), isFactorLow = hn::Lt(i, zero), isNowLow = hn::Lt(y, zero);
        const auto up = hn::AndNot(hn::Or(isLow, isFactorLow), isNowLow);
        const auto down = hn::AndNot(isNowLow, hn::And(isLow, isFactorLow));
        turns = hn::Add(turns, hn::IfThenElseZero(up, one));
        turns = hn::Sub(turns, hn::IfThenElseZero(down, one));
        const V size = hn::Add(hn::Abs(x), hn::Abs(y));
        const auto isFinite = hn::Gt(size, zero);
        const V inverse = hn::Div(one, hn::IfThenElse(isFinite, size, one));
        real = hn::IfThenElse(isFinite, hn::Mul(x, inverse), real);
        imaginary = hn::IfThenElse(isFinite, hn::Mul(y, inverse), imaginary);
    }
};

void windingsAt(const LidField& field, std::span<const std::uint32_t> set, const Jet& far, Vec3d center,
                const LidSamples& samples, double* windings) {
    const Lanes d;
    const V half = hn::Set(d, 0.5);
    for (std::size_t n = 0; n < samples.count; n += hn::Lanes(d)) {
        const V x = hn::LoadU(d, samples.x + n), y = hn::LoadU(d, samples.y + n), z = hn::LoadU(d, samples.z + n);
        const auto raysTo = [&](Vec3d corner) HWY_ATTR {
            const Vec3d at = corner - center;
            Rays rays{hn::Sub(hn::Set(d, at.x), x), hn::Sub(hn::Set(d, at.y), y), hn::Sub(hn::Set(d, at.z), z), x};
            rays.length = hn::Sqrt(dotOf(rays, rays));
            return rays;
        };
        Product product{hn::Set(d, 1.0), hn::Zero(d), hn::Zero(d)};
        Rays apex{x, y, z, x}, to{x, y, z, x};
        for (std::size_t s = 0; s < set.size(); ++s) {
            const LidPiece& piece = field.pieces()[set[s]];
            // Successive pieces of a ring share the apex and a corner.
            const bool follows = s > 0 && set[s - 1] == piece.previous;
            if (!follows) apex = raysTo(piece.apex);
            const Rays from = follows ? to : raysTo(piece.from);
            to = raysTo(piece.to);
            const V real = hn::Add(sumOfProducts(hn::Mul(apex.length, from.length), to.length, dotOf(apex, from),
                                                 to.length, dotOf(from, to), apex.length),
                                   hn::Mul(dotOf(to, apex), from.length));
            const V imaginary =
                sumOfProducts(apex.x, crossOf(from.y, to.z, from.z, to.y), apex.y, crossOf(from.z, to.x, from.x, to.z),
                              apex.z, crossOf(from.x, to.y, from.y, to.x));
            product.multiply(real, imaginary);
        }
        const auto constant = [&](double c) HWY_ATTR { return hn::Set(d, c); };
        const V hx = sumOfProducts(constant(far.diagonal.x), x, constant(far.mixed.z), y, constant(far.mixed.y), z);
        const V hy = sumOfProducts(constant(far.mixed.z), x, constant(far.diagonal.y), y, constant(far.mixed.x), z);
        const V hz = sumOfProducts(constant(far.mixed.y), x, constant(far.mixed.x), y, constant(far.diagonal.z), z);
        const V slopes = sumOfProducts(hn::Add(constant(far.gradient.x), hn::Mul(hx, half)), x,
                                       hn::Add(constant(far.gradient.y), hn::Mul(hy, half)), y,
                                       hn::Add(constant(far.gradient.z), hn::Mul(hz, half)), z);
        const V near = hn::Add(product.turns, argument(product.real, product.imaginary));
        hn::StoreU(hn::Add(near, hn::Add(constant(far.value), slopes)), d, windings + n);
    }
}

}  // namespace
}  // namespace svt::voxelize::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svt::voxelize {

HWY_EXPORT(windingsAt);

void windingsAt(const LidField& field, std::span<const std::uint32_t> set, const Jet& far, Vec3d center,
                const LidSamples& samples, double* windings) {
    HWY_DYNAMIC_DISPATCH(windingsAt)(field, set, far, center, samples, windings);
}

}  // namespace svt::voxelize
#endif
