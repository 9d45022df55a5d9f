#pragma once
/// \file
/// Points of a plane on a grid of whole numbers, and exact tests of their positions. Double precision is not enough: a
/// point next to a line must lie on the same side of it in all tests.

#include <svt/core/vec.hpp>

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>

namespace svt::plane {

/// Products of coordinates. The type is not part of standard C++, but each compiler that builds SVT has it.
__extension__ using Wide = __int128;

/// Marks a missing index of a point, edge or box.
inline constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// A point, or a difference of points; each coordinate at most 2^60 from 0. Points are ordered by u, then by v.
struct Point {
    std::int64_t u = 0, v = 0;
    friend constexpr bool operator==(const Point&, const Point&) = default;
    friend constexpr auto operator<=>(const Point&, const Point&) = default;
    friend constexpr Point operator-(Point a, Point b) noexcept { return {a.u - b.u, a.v - b.v}; }
};

[[nodiscard]] constexpr Wide cross(Point a, Point b) noexcept { return Wide(a.u) * b.v - Wide(a.v) * b.u; }
[[nodiscard]] constexpr Wide dot(Point a, Point b) noexcept { return Wide(a.u) * b.u + Wide(a.v) * b.v; }

/// 1 if a, b, c turn counter-clockwise, so that c lies to the left of the line from a to b; -1 if clockwise; 0 if they
/// lie on one line. Exact.
[[nodiscard]] constexpr int turn(Point a, Point b, Point c) noexcept {
    const Wide twiceArea = cross(b - a, c - a);
    return (twiceArea > 0) - (twiceArea < 0);
}

/// Twice the signed area of the triangle a, b, c in x and y, positive if counter-clockwise; rounded. For points that
/// are not on the grid.
[[nodiscard]] constexpr double twiceArea(Vec3d a, Vec3d b, Vec3d c) noexcept {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// True if the triangle (not collapsed) contains `p`, border included. Exact.
[[nodiscard]] constexpr bool holds(const std::array<Point, 3>& t, Point p) noexcept {
    const int a = turn(t[0], t[1], p), b = turn(t[1], t[2], p), c = turn(t[2], t[0], p);
    return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

/// The box around points, borders included; empty until a point is added.
struct Box {
    static constexpr std::int64_t kFar = std::int64_t{1} << 61;
    Point low{kFar, kFar}, high{-kFar, -kFar};

    constexpr void add(Point p) noexcept {
        low = {std::min(low.u, p.u), std::min(low.v, p.v)};
        high = {std::max(high.u, p.u), std::max(high.v, p.v)};
    }
    [[nodiscard]] constexpr bool contains(Point p) const noexcept {
        return low.u <= p.u && p.u <= high.u && low.v <= p.v && p.v <= high.v;
    }
    [[nodiscard]] constexpr bool overlaps(const Box& o) const noexcept {
        return low.u <= o.high.u && o.low.u <= high.u && low.v <= o.high.v && o.low.v <= high.v;
    }
};

/// The box around a segment.
[[nodiscard]] constexpr Box boxOf(Point a, Point b) noexcept {
    return {{std::min(a.u, b.u), std::min(a.v, b.v)}, {std::max(a.u, b.u), std::max(a.v, b.v)}};
}

/// True if `p` lies on the segment from a to b, ends included. Exact.
[[nodiscard]] constexpr bool liesOn(Point p, Point a, Point b) noexcept {
    return boxOf(a, b).contains(p) && turn(a, b, p) == 0;
}

/// How two closed segments, or a segment and a triangle, meet.
enum class Meeting : std::uint8_t {
    None,
    Touch,  ///< at an end point, along an edge, or within one line or plane
    Cross   ///< an inner point of one lies inside the other, with ends on both sides
};

/// How the segments ab and cd meet. Exact.
[[nodiscard]] constexpr Meeting meet(Point a, Point b, Point c, Point d) noexcept {
    if (!boxOf(a, b).overlaps(boxOf(c, d))) return Meeting::None;
    const int abc = turn(a, b, c), abd = turn(a, b, d), cda = turn(c, d, a), cdb = turn(c, d, b);
    if (abc * abd < 0 && cda * cdb < 0) return Meeting::Cross;
    const bool isTouch = liesOn(c, a, b) || liesOn(d, a, b) || liesOn(a, c, d) || liesOn(b, c, d);
    return isTouch ? Meeting::Touch : Meeting::None;
}

}  // namespace svt::plane
