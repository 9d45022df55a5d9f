#pragma once
/// \file
/// Which rays come near a line of the picture: eight rays at once, compiled for several instruction sets as the packet
/// kernel is, and the same for one ray, to the last bit. Internal to render.

#include <svt/render/pass_shapes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace svt::render {

/// Where a ray comes upon a line.
struct LineHit {
    double depth;    ///< where it is drawn, a little before the line itself
    double opacity;  ///< how much of the ray's surroundings it covers
    double hidden;   ///< opacity behind something opaque
    std::uint32_t line, ray;
};

/// What all lines of a picture share.
struct LineView {
    bool isPerspective;
    double samplesPerPixel;  ///< along a side
    double pixelSize;        ///< metres at depth 1, or at any where orthographic
    double before;           ///< metres that lines lie before what they lie on
};

/// Lines also lie so many half widths of theirs before what they lie on, which may come nearer aside.
inline constexpr double kHalfWidthsBefore = 4;

/// Completes a hit with how the line is drawn where it is hidden. \param along  0..1, from the line's begin
inline LineHit lineHit(const PictureLine& line, const LineLook& look, std::uint32_t number, std::uint32_t ray,
                       double coverage, double along, double depth) noexcept {
    double hidden = look.hidden == HiddenLines::None ? 0 : coverage * look.hiddenOpacity;
    if (look.hidden == HiddenLines::Dashed) {
        const double pixels = along * line.length;
        if (pixels - std::floor(pixels / look.period) * look.period > look.dash) hidden = 0;
    }
    return {depth, coverage, hidden, number, ray};
}

/// Whether a ray through a place in the picture, pixels, comes upon the line.
inline bool findLine(const LineView& view, const PictureLine& line, const LineLook& look, std::uint32_t number,
                     double x, double y, LineHit& hit) noexcept {
    const double asideX = x - line.x, asideY = y - line.y;
    const double along = std::min(std::max((asideX * line.dx + asideY * line.dy) * line.perSquaredLength, 0.0), 1.0);
    const double offX = asideX - along * line.dx, offY = asideY - along * line.dy;
    const double distance = std::sqrt(offX * offX + offY * offY);
    const double coverage = std::min((look.halfWidth - distance) * view.samplesPerPixel + 0.5, look.darkest);
    if (!(coverage > 0)) return false;
    const double place = line.depth + line.depthChange * along;
    const double depth = view.isPerspective ? 1 / place : place;
    const double pixelSize = view.isPerspective ? view.pixelSize * depth : view.pixelSize;
    const double before = view.before + kHalfWidthsBefore * look.halfWidth * pixelSize;
    hit = lineHit(line, look, number, 0, coverage, along, std::max(depth - before, 0.0));
    return true;
}

/// Rays that findLines() takes at once.
inline constexpr std::size_t kLineRays = 8;

/// findLine() for the rays through (x[n], y[n]), n < kLineRays, and all lines of `numbers`.
/// \param hits  has room for kLineRays times as many \return how many there are
std::size_t findLines(const LineView& view, const PictureLine* lines, const LineLook* looks,
                      std::span<const std::uint32_t> numbers, const double* x, const double* y, LineHit* hits) noexcept;

}  // namespace svt::render
