#include <svt/render/hatch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace svt::render {
namespace {

// Coverage by a line at `distance` from its centre line.
double lineInk(double distance, const HatchPen& pen) noexcept {
    return std::clamp((pen.lineWidth / 2 + pen.pixel / 2 - distance) / pen.pixel, 0.0, 1.0) *
           std::min(1.0, pen.lineWidth / pen.pixel);
}

// Distance to the nearest whole multiple of `period`.
double toMultiple(double x, double period) noexcept { return std::abs(x - period * std::round(x / period)); }

double stripes(double x, double period, const HatchPen& pen) noexcept { return lineInk(toMultiple(x, period), pen); }

// A pseudo-random number, 0..1, by cell.
double randomOf(double i, double j, int salt) noexcept {
    auto hash = static_cast<std::uint64_t>(static_cast<std::int64_t>(i)) * 0x9E3779B97F4A7C15ull ^
                static_cast<std::uint64_t>(static_cast<std::int64_t>(j)) * 0xC2B2AE3D27D4EB4Full ^
                static_cast<std::uint64_t>(salt) * 0x165667B19E3779F9ull;
    hash = (hash ^ hash >> 31) * 0xBF58476D1CE4E5B9ull;
    hash = (hash ^ hash >> 29) * 0x94D049BB133111EBull;
    return static_cast<double>(hash >> 40) / double(1 << 24);
}

double toSegment(double u, double v, double u0, double v0, double u1, double v1) noexcept {
    const double du = u1 - u0, dv = v1 - v0;
    const double at = std::clamp(((u - u0) * du + (v - v0) * dv) / (du * du + dv * dv), 0.0, 1.0);
    return std::hypot(u - u0 - at * du, v - v0 - at * dv);
}

// A dot in each square field, and a triangle in some.
double gravel(double u, double v, const HatchPen& pen) noexcept {
    const double field = pen.spacing;
    const double i = std::floor(u / field), j = std::floor(v / field);
    const double x = u - i * field, y = v - j * field;
    const double cx = (0.3 + 0.4 * randomOf(i, j, 1)) * field, cy = (0.3 + 0.4 * randomOf(i, j, 2)) * field;
    if (randomOf(i, j, 3) > 0.3) {
        const double radius = 0.5 * pen.lineWidth + (0.02 + 0.03 * randomOf(i, j, 4)) * field;
        return std::clamp((radius + pen.pixel / 2 - std::hypot(x - cx, y - cy)) / pen.pixel, 0.0, 1.0);
    }
    const double turn = 2 * std::numbers::pi * randomOf(i, j, 5), size = 0.22 * field;
    const auto corner = [&](int n) {
        const double angle = turn + n * 2 * std::numbers::pi / 3;
        return std::pair(cx + size * std::cos(angle), cy + size * std::sin(angle));
    };
    double nearest = field;
    for (int n = 0; n < 3; ++n) {
        const auto [u0, v0] = corner(n);
        const auto [u1, v1] = corner(n + 1);
        nearest = std::min(nearest, toSegment(x, y, u0, v0, u1, v1));
    }
    return lineInk(nearest, pen);
}

double zigzag(double u, double v, const HatchPen& pen) noexcept {
    const double band = 3 * pen.spacing, half = 0.75 * pen.spacing;
    const double height = v - band * std::floor(v / band);
    // A zigzag between the lines of the band, with a slope of 63 degrees.
    const double along = u / half - 2 * std::floor(u / (2 * half));
    const double wave = band * (along < 1 ? along : 2 - along);
    const double slope = band / half;
    return std::max(stripes(v, band, pen), lineInk(std::abs(height - wave) / std::sqrt(1 + slope * slope), pen));
}

double earth(double u, double v, const HatchPen& pen) noexcept {
    const double field = 4 * pen.spacing;
    const double i = std::floor(u / field), j = std::floor(v / field);
    const double x = u - (i + 0.5) * field, y = v - (j + 0.5) * field;
    const bool isTurned = std::fmod(std::abs(i + j), 2) == 1;
    const double across = (isTurned ? x + y : x - y) / std::numbers::sqrt2;
    const double along = (isTurned ? x - y : x + y) / std::numbers::sqrt2;
    if (std::abs(along) > 0.42 * field || std::abs(across) > 1.2 * pen.spacing) return 0;
    return stripes(across, pen.spacing, pen);
}

// Wood grain with varying line distances.
double grain(double u, double v, const HatchPen& pen) noexcept {
    const double bend = 0.35 * pen.spacing * std::sin(u / (2.1 * pen.spacing) + 0.9 * std::sin(v / (3 * pen.spacing)));
    return stripes(v + bend, 0.8 * pen.spacing, pen);
}

double strokes(double u, double v, const HatchPen& pen) noexcept {
    const double across = (u - v) / std::numbers::sqrt2, along = (u + v) / std::numbers::sqrt2;
    const double line = std::round(across / (1.5 * pen.spacing));
    const double at = along / (6 * pen.spacing) + randomOf(line, 0, 6);
    return at - std::floor(at) < 0.3 ? stripes(across, 1.5 * pen.spacing, pen) : 0;
}

}  // namespace

double hatchCoverage(Hatch hatch, double u, double v, const HatchPen& pen) noexcept {
    if (hatch == Hatch::None) return 0;
    // Too dense to resolve: the mean.
    if (pen.spacing < 2 * pen.pixel) return std::min(0.5, 0.7 * pen.lineWidth / pen.spacing);
    const double across = (u - v) / std::numbers::sqrt2, along = (u + v) / std::numbers::sqrt2;
    switch (hatch) {
        case Hatch::None: break;
        case Hatch::Masonry: return stripes(across, pen.spacing, pen);
        case Hatch::General: return stripes(across, 2 * pen.spacing, pen);
        case Hatch::Steel:
            return std::max(stripes(across, 2 * pen.spacing, pen),
                            stripes(across - 0.5 * pen.spacing, 2 * pen.spacing, pen));
        case Hatch::ReinforcedConcrete: {
            const double line = std::round(across / pen.spacing);
            const bool isDashed = std::fmod(std::abs(line), 2) == 1;
            const double dash = along / (2.4 * pen.spacing);
            return isDashed && dash - std::floor(dash) > 0.65 ? 0 : stripes(across, pen.spacing, pen);
        }
        case Hatch::Concrete: return gravel(u, v, pen);
        case Hatch::Timber: return grain(u, v, pen);
        case Hatch::Insulation: return zigzag(u, v, pen);
        case Hatch::Earth: return earth(u, v, pen);
        case Hatch::Glass: return strokes(u, v, pen);
    }
    return 0;
}

}  // namespace svt::render
