#include <svt/drawing/clip_segment.hpp>

#include <algorithm>

namespace svt::drawing {
namespace {

// The shares of a segment between which it lies in a rectangle; the first is larger if it lies outside.
struct ShareWithin {
    double from = 0, to = 1;

    ShareWithin(PlanePoint a, PlanePoint b, PlanePoint low, PlanePoint high) noexcept {
        clip(a.u, b.u - a.u, low.u, high.u);
        clip(a.v, b.v - a.v, low.v, high.v);
    }

private:
    void clip(double start, double change, double least, double most) noexcept {
        if (change == 0) {
            if (!(start >= least && start <= most)) to = -1;
            return;
        }
        const double x = (least - start) / change, y = (most - start) / change;
        from = std::max(from, std::min(x, y));
        to = std::min(to, std::max(x, y));
    }
};

}  // namespace

std::optional<std::pair<PlanePoint, PlanePoint>> clipSegment(PlanePoint a, PlanePoint b, PlanePoint low,
                                                             PlanePoint high) noexcept {
    const ShareWithin share(a, b, low, high);
    const double du = b.u - a.u, dv = b.v - a.v;
    if ((du == 0 && dv == 0) || !(share.from < share.to)) return std::nullopt;
    const auto at = [&](double t) { return t == 0 ? a : t == 1 ? b : PlanePoint{a.u + t * du, a.v + t * dv}; };
    return std::pair(at(share.from), at(share.to));
}

bool meetsRectangle(PlanePoint a, PlanePoint b, PlanePoint low, PlanePoint high) noexcept {
    const ShareWithin share(a, b, low, high);
    return share.from <= share.to;
}

}  // namespace svt::drawing
