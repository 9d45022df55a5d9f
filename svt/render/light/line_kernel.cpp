#include <svt/core/simd_targets.hpp>
#include <svt/render/light/line_kernel.hpp>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svt/render/light/line_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svt::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, kLineRays>;
using V = hn::Vec<D>;

std::size_t find(const LineView& view, const PictureLine* lines, const LineStyle* styles,
                 std::span<const std::uint32_t> numbers, const double* x, const double* y, LineHit* hits) {
    const D d;
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0), half = hn::Set(d, 0.5);
    constexpr std::size_t kMaxLanes = hn::MaxLanes(D());
    alignas(64) double coverages[kMaxLanes], alongs[kMaxLanes], depths[kMaxLanes];
    std::size_t count = 0;
    for (std::size_t first = 0; first < kLineRays; first += hn::Lanes(d)) {
        const V placeX = hn::LoadU(d, x + first), placeY = hn::LoadU(d, y + first);
        for (const std::uint32_t number : numbers) {
            const PictureLine& line = lines[number];
            const LineStyle& style = styles[line.style];
            const V asideX = hn::Sub(placeX, hn::Set(d, line.x)), asideY = hn::Sub(placeY, hn::Set(d, line.y));
            const V dx = hn::Set(d, line.dx), dy = hn::Set(d, line.dy);
            const V way = hn::Mul(hn::Add(hn::Mul(asideX, dx), hn::Mul(asideY, dy)), hn::Set(d, line.perSquaredLength));
            const V along = hn::Min(hn::Max(way, zero), one);
            const V offX = hn::Sub(asideX, hn::Mul(along, dx)), offY = hn::Sub(asideY, hn::Mul(along, dy));
            const V squared = hn::Add(hn::Mul(offX, offX), hn::Mul(offY, offY));
            // Early exit: the square root below takes longer than all above.
            const double reach = style.halfWidth + 0.51;
            if (hn::AllTrue(d, hn::Gt(squared, hn::Set(d, reach * reach)))) continue;
            const V distance = hn::Sqrt(squared);
            const V inside = hn::Mul(hn::Sub(hn::Set(d, style.halfWidth), distance), hn::Set(d, view.samplesPerPixel));
            const V coverage = hn::Min(hn::Add(inside, half), hn::Set(d, style.darkest));
            const auto isHit = hn::Gt(coverage, zero);
            if (hn::AllFalse(d, isHit)) continue;
            const V place = hn::Add(hn::Set(d, line.depth), hn::Mul(hn::Set(d, line.depthChange), along));
            const V depth = view.isPerspective ? hn::Div(one, place) : place;
            const V perPixel = hn::Set(d, view.pixelSize);
            const V pixelSize = view.isPerspective ? hn::Mul(perPixel, depth) : perPixel;
            const V before = hn::Add(hn::Set(d, view.depthBias),
                                     hn::Mul(hn::Set(d, kHalfWidthsBefore * style.halfWidth), pixelSize));
            hn::Store(coverage, d, coverages);
            hn::Store(along, d, alongs);
            hn::Store(hn::Max(hn::Sub(depth, before), zero), d, depths);
            for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane)
                if (coverages[lane] > 0)
                    hits[count++] = lineHit(line, style, number, static_cast<std::uint32_t>(first + lane),
                                            coverages[lane], alongs[lane], depths[lane]);
        }
    }
    return count;
}

}  // namespace
}  // namespace svt::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svt::render {

HWY_EXPORT(find);

std::size_t findLines(const LineView& view, const PictureLine* lines, const LineStyle* styles,
                      std::span<const std::uint32_t> numbers, const double* x, const double* y,
                      LineHit* hits) noexcept {
    return HWY_DYNAMIC_DISPATCH(find)(view, lines, styles, numbers, x, y, hits);
}

}  // namespace svt::render
#endif
