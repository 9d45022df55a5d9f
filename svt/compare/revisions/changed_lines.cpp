#include <svt/compare/revisions/changed_lines.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace svt::compare {
namespace {

using drawing::PlanePoint;

constexpr double kLargestSine = 0.1;  // between lines of one direction

double distanceOf(PlanePoint p, const Line& line) noexcept {
    const double u = line.to.u - line.from.u, v = line.to.v - line.from.v, square = u * u + v * v;
    const double along = square > 0 ? ((p.u - line.from.u) * u + (p.v - line.from.v) * v) / square : 0;
    const double t = std::clamp(along, 0.0, 1.0);
    return std::hypot(p.u - line.from.u - t * u, p.v - line.from.v - t * v);
}

PlanePoint pointAt(const Line& line, double t) noexcept {
    return {line.from.u + t * (line.to.u - line.from.u), line.from.v + t * (line.to.v - line.from.v)};
}

bool areApart(const Line& a, const Line& b, double tolerance) noexcept {
    const auto beyond = [&](double from, double to, double otherFrom, double otherTo) {
        return std::min(from, to) > std::max(otherFrom, otherTo) + tolerance ||
               std::max(from, to) + tolerance < std::min(otherFrom, otherTo);
    };
    return beyond(a.from.u, a.to.u, b.from.u, b.to.u) || beyond(a.from.v, a.to.v, b.from.v, b.to.v);
}

bool haveOneDirection(const Line& a, const Line& b, double tolerance) noexcept {
    const double u = a.to.u - a.from.u, v = a.to.v - a.from.v, x = b.to.u - b.from.u, y = b.to.v - b.from.v;
    const double lengths = std::hypot(u, v) * std::hypot(x, y);
    return std::hypot(x, y) <= tolerance || std::abs(u * y - v * x) <= kLargestSine * lengths;
}

// Where a line is near another one. The distance is convex along it, so that this is one interval.
std::optional<std::pair<double, double>> nearPart(const Line& line, const Line& other, double tolerance) {
    constexpr int kSteps = 40;
    if (areApart(line, other, tolerance) || !haveOneDirection(line, other, tolerance)) return std::nullopt;
    const auto distance = [&](double t) { return distanceOf(pointAt(line, t), other); };
    double low = 0, high = 1;
    for (int step = 0; step < kSteps && high - low > 1e-9; ++step) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        if (distance(a) <= distance(b))
            high = b;
        else
            low = a;
    }
    const double nearest = 0.5 * (low + high);
    if (distance(nearest) > tolerance) return std::nullopt;
    const auto end = [&](double inside, double outside) {
        if (distance(outside) <= tolerance) return outside;
        for (int step = 0; step < kSteps; ++step) {
            const double middle = 0.5 * (inside + outside);
            (distance(middle) <= tolerance ? inside : outside) = middle;
        }
        return inside;
    };
    return std::pair(end(nearest, 0.0), end(nearest, 1.0));
}

}  // namespace

void addMissingParts(const Line& line, std::span<const Line> others, double tolerance, std::vector<Line>& parts) {
    const double length = std::hypot(line.to.u - line.from.u, line.to.v - line.from.v);
    if (!(length > 0)) return;
    std::vector<std::pair<double, double>> common;
    for (const Line& other : others)
        if (const auto part = nearPart(line, other, tolerance)) common.push_back(*part);
    if (common.empty()) {
        parts.push_back(line);
        return;
    }
    std::sort(common.begin(), common.end());
    double at = 0;
    const auto add = [&](double from, double to) {
        if ((to - from) * length > tolerance) parts.push_back({pointAt(line, from), pointAt(line, to)});
    };
    for (const auto& [from, to] : common) {
        if (from > at) add(at, from);
        at = std::max(at, to);
    }
    add(at, 1);
}

}  // namespace svt::compare
