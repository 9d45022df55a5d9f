#pragma once
/// \file
/// Tests which rays meet the lines of a picture: eight rays at once, compiled for several instruction sets like the
/// packet kernel, and for one ray, with the same results to the last bit.

#include <svt/render/pass_shapes.hpp>
#include <svt/render/picture_constants.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace svt::render {

/// A ray meets a line.
struct LineHit {
    double depth;    ///< at which it is drawn: that of the line minus the depth bias
    double opacity;  ///< coverage of the ray's sample
    double hidden;   ///< opacity as a hidden line, behind something opaque
    std::uint32_t line, ray;
};

/// Parameters of all lines of a picture.
struct LineView {
    bool isPerspective;
    double samplesPerPixel;  ///< along a side
    double pixelSize;        ///< metres at depth 1; at any depth if orthographic
    double depthBias;        ///< constant depth bias towards the viewer, metres
};

/// Makes a hit, with the line's opacity where it is hidden.
/// \param along  place on the line, 0..1 from its start
inline LineHit lineHit(const PictureLine& line, const LineStyle& style, std::uint32_t number, std::uint32_t ray,
                       double coverage, double along, double depth) noexcept {
    double hidden = style.hidden == HiddenLines::None ? 0 : coverage * style.hiddenOpacity;
    if (style.hidden == HiddenLines::Dashed) {
        const double pixels = along * line.length;
        if (pixels - std::floor(pixels / style.period) * style.period > style.dash) hidden = 0;
    }
    return {depth, coverage, hidden, number, ray};
}

/// Whether the ray through (x, y), pixels, meets the line; if so, sets `hit`.
inline bool findLine(const LineView& view, const PictureLine& line, const LineStyle& style, std::uint32_t number,
                     double x, double y, LineHit& hit) noexcept {
    const double asideX = x - line.x, asideY = y - line.y;
    const double along = std::min(std::max((asideX * line.dx + asideY * line.dy) * line.perSquaredLength, 0.0), 1.0);
    const double offX = asideX - along * line.dx, offY = asideY - along * line.dy;
    const double distance = std::sqrt(offX * offX + offY * offY);
    const double coverage = std::min((style.halfWidth - distance) * view.samplesPerPixel + 0.5, style.darkest);
    if (!(coverage > 0)) return false;
    const double place = line.depth + line.depthChange * along;
    const double depth = view.isPerspective ? 1 / place : place;
    const double pixelSize = view.isPerspective ? view.pixelSize * depth : view.pixelSize;
    const double before = view.depthBias + kHalfWidthsBefore * style.halfWidth * pixelSize;
    hit = lineHit(line, style, number, 0, coverage, along, std::max(depth - before, 0.0));
    return true;
}

/// Rays that findLines() tests at once.
inline constexpr std::size_t kLineRays = 8;

/// findLine() for the rays through (x[n], y[n]), n < kLineRays, and all lines of `numbers`.
/// \param hits  room for kLineRays * numbers.size() hits
/// \return number of hits
std::size_t findLines(const LineView& view, const PictureLine* lines, const LineStyle* styles,
                      std::span<const std::uint32_t> numbers, const double* x, const double* y, LineHit* hits) noexcept;

}  // namespace svt::render
