#include <svt/drawing/field/field_arrows.hpp>

#include <svt/core/rounding.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace svt::drawing {
namespace {

constexpr double kAcross = 40;      // the least number of arrows across the drawing, unless a step is given
constexpr double kLeastPart = 0.1;  // of the longest arrow: shorter ones are left out

// The vector at a place in world space; NaN where it is missing.
Vec3d vectorAt(const FieldSource& source, Vec3d world) {
    const Vec3d index = source.volume.grid.indexFromWorld(world);
    const std::array<Vec3d, 3>& axes = source.volume.grid.axes();
    Vec3d vector{};
    for (std::int32_t c = 0; c < 3; ++c)
        vector =
            vector + axes[static_cast<std::size_t>(c)] * double{source.sampler.atSeconds(index, source.seconds, c)};
    return vector;
}

}  // namespace

Result<double> arrowStepOf(const std::deque<RegionGrid>& grids, const FieldDrawingOptions& options) {
    if (grids.empty()) return options.arrows.value_or(0);
    PlanePoint low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
    for (const RegionGrid& grid : grids) {
        low = {std::min(low.u, grid.low().u), std::min(low.v, grid.low().v)};
        high = {std::max(high.u, grid.high().u), std::max(high.v, grid.high().v)};
    }
    const double width = high.u - low.u, height = high.v - low.v;
    const double step = options.arrows ? *options.arrows : roundDownTo125(std::max(width, height) / kAcross);
    if (step == 0) return 0.0;
    if (step > 0 && width / step * (height / step) <= kMostArrows) return step;
    return Error(Code::BadArgument,
                 fmt::format("--arrows {:g} gives more than {:.0f} arrows on {:.1f} x {:.1f} m; give {:.2g} or more",
                             step, kMostArrows, width, height, std::sqrt(width * height / kMostArrows)));
}

std::vector<FieldArrow> findArrows(const std::deque<RegionGrid>& grids, const FieldSource& source, double step,
                                   double longest) {
    std::vector<FieldArrow> arrows;
    if (!(step > 0) || !(longest > 0)) return arrows;
    for (const RegionGrid& grid : grids) {
        const PlanePoint low = grid.low(), high = grid.high();
        for (double row = std::ceil(low.v / step); row * step < high.v; row += 1)
            for (double column = std::ceil(low.u / step); column * step < high.u; column += 1) {
                const PlanePoint at{column * step, row * step};
                if (!grid.holds(at, at)) continue;
                const Vec3d vector = vectorAt(source, source.axes.worldFromPlane(at));
                const double u = dot(vector, source.axes.u), v = dot(vector, source.axes.v), value = std::hypot(u, v);
                const double part = std::sqrt(std::min(1.0, value / longest));
                if (!(part >= kLeastPart)) continue;  // also where the vector is missing
                const double half = kArrowPart * step * part / 2;
                const double du = half * u / value, dv = half * v / value;
                const FieldArrow arrow{{at.u - du, at.v - dv}, {at.u + du, at.v + dv}, value};
                if (grid.holds(arrow.from, arrow.to)) arrows.push_back(arrow);
            }
    }
    return arrows;
}

}  // namespace svt::drawing
