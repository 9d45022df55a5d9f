#include <svt/drawing/clip_segment.hpp>

#include <algorithm>

namespace svt::drawing {

std::optional<std::pair<PlanePoint, PlanePoint>> clipSegment(PlanePoint a, PlanePoint b, PlanePoint low,
                                                             PlanePoint high) noexcept {
    double from = 0, to = 1;
    const auto within = [&](double start, double change, double least, double most) {
        if (change == 0) return start >= least && start <= most;
        const double x = (least - start) / change, y = (most - start) / change;
        from = std::max(from, std::min(x, y));
        to = std::min(to, std::max(x, y));
        return from < to;
    };
    const double du = b.u - a.u, dv = b.v - a.v;
    if ((du == 0 && dv == 0) || !within(a.u, du, low.u, high.u) || !within(a.v, dv, low.v, high.v)) return std::nullopt;
    const auto at = [&](double t) { return t == 0 ? a : t == 1 ? b : PlanePoint{a.u + t * du, a.v + t * dv}; };
    return std::pair(at(from), at(to));
}

}  // namespace svt::drawing
