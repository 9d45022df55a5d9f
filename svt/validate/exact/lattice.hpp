#pragma once
/// \file
/// Coordinates as whole numbers, so that every question of side has one exact answer. Double precision is not enough:
/// a point one micrometre beyond a wall must lie beyond it for each triangle that is asked.

#include <svt/core/vec.hpp>

#include <array>
#include <cstdint>

namespace svt::validate {

/// A point in units of a Lattice; each coordinate at most 2^40 from 0.
struct Point {
    std::int64_t x = 0, y = 0, z = 0;
    [[nodiscard]] std::int64_t operator[](int axis) const noexcept { return axis == 0 ? x : axis == 1 ? y : z; }
    friend bool operator==(const Point&, const Point&) = default;
    friend auto operator<=>(const Point&, const Point&) = default;
};

/// A point of a plane that was projected along one axis.
struct Point2 {
    std::int64_t u = 0, v = 0;
    friend bool operator==(const Point2&, const Point2&) = default;
    friend auto operator<=>(const Point2&, const Point2&) = default;
};

/// Whole numbers for the coordinates of one model: steps of 2^-20 m (about a micrometre) from an origin of whole
/// metres, or larger steps for a model beyond 1000 km.
class Lattice {
public:
    Lattice() = default;
    /// \param bounds  of all points that will be asked for; world space
    explicit Lattice(const Box3d& bounds) noexcept;

    [[nodiscard]] Point toLattice(Vec3d world) const noexcept;
    [[nodiscard]] Vec3d toWorld(Point point) const noexcept { return origin_ + local(point) * unit_; }
    /// World space from lattice units in double precision.
    [[nodiscard]] Vec3d toWorld(Vec3d units) const noexcept { return origin_ + units * unit_; }
    /// The same point as doubles, in units.
    [[nodiscard]] static Vec3d local(Point point) noexcept {
        return {static_cast<double>(point.x), static_cast<double>(point.y), static_cast<double>(point.z)};
    }
    /// Metres of one step.
    [[nodiscard]] double unit() const noexcept { return unit_; }

private:
    Vec3d origin_{};
    double unit_ = 1.0 / 1048576;
};

/// 1 if a, b, c turn counter-clockwise, -1 if clockwise, 0 if they lie on one line. Exact.
[[nodiscard]] int turn(Point2 a, Point2 b, Point2 c) noexcept;

/// 1 if `d` lies on the side of the plane a, b, c from which they turn counter-clockwise, -1 on the other, 0 on it.
/// Exact.
[[nodiscard]] int side(const Point& a, const Point& b, const Point& c, const Point& d) noexcept;

/// The point without its coordinate along `axis`, so that what turns counter-clockwise seen from the positive end of
/// the axis does so in the plane.
[[nodiscard]] constexpr Point2 dropped(const Point& p, int axis) noexcept {
    return axis == 0 ? Point2{p.y, p.z} : axis == 1 ? Point2{p.z, p.x} : Point2{p.x, p.y};
}

/// The axis along which a, b, c are seen without collapsing to a line, -1 if they lie on one line. Exact.
[[nodiscard]] int axisOf(const Point& a, const Point& b, const Point& c) noexcept;

/// How two closed segments or a segment and a triangle meet.
enum class Meeting : std::uint8_t {
    None,
    Touch,  ///< at an end point, along an edge, or lying within one line or plane
    Cross   ///< an inner point of one lies within the inside of the other, with ends on both sides
};

/// How the segments ab and cd meet. Exact.
[[nodiscard]] Meeting meet(Point2 a, Point2 b, Point2 c, Point2 d) noexcept;

/// True if `p`, on the line through a and b, lies between them (ends included). Exact.
[[nodiscard]] bool isBetween(Point2 a, Point2 b, Point2 p) noexcept;

/// True if the triangle (not collapsed) holds `p`, border included. Exact.
[[nodiscard]] bool holds(const std::array<Point2, 3>& triangle, Point2 p) noexcept;

/// How the segment pq meets a triangle that is not collapsed. Exact.
[[nodiscard]] Meeting meet(const Point& p, const Point& q, const std::array<Point, 3>& triangle) noexcept;

}  // namespace svt::validate
