#pragma once
/// \file
/// Coordinates as whole numbers, so that all tests of sides are exact. Double precision is not enough: a point one
/// micrometre beyond a wall must lie beyond each tested triangle of it.

#include <svt/plane/point.hpp>

namespace svt::validate {

/// A point in units of a Lattice; each coordinate at most 2^40 from 0.
struct Point {
    std::int64_t x = 0, y = 0, z = 0;
    [[nodiscard]] std::int64_t operator[](int axis) const noexcept { return axis == 0 ? x : axis == 1 ? y : z; }
    friend bool operator==(const Point&, const Point&) = default;
    friend auto operator<=>(const Point&, const Point&) = default;
};

using plane::Meeting;

/// Whole numbers for the coordinates of one model: steps of 2^-20 m (about a micrometre) from an origin of whole
/// metres, or larger steps for a model beyond 1000 km.
class Lattice {
public:
    Lattice() = default;
    /// \param bounds  of all points to convert; world space
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

/// 1 if `d` lies on the side of the plane a, b, c from which they turn counter-clockwise, -1 on the other, 0 on it.
/// Exact.
[[nodiscard]] int side(const Point& a, const Point& b, const Point& c, const Point& d) noexcept;

/// The point without its coordinate along `axis`. A ring that is counter-clockwise seen from the positive end of the
/// axis is also counter-clockwise in the plane.
[[nodiscard]] constexpr plane::Point dropped(const Point& p, int axis) noexcept {
    return axis == 0 ? plane::Point{p.y, p.z} : axis == 1 ? plane::Point{p.z, p.x} : plane::Point{p.x, p.y};
}

/// The axis along which a, b, c are seen without collapsing to a line, -1 if they lie on one line. Exact.
[[nodiscard]] int axisOf(const Point& a, const Point& b, const Point& c) noexcept;

/// How the segment pq meets a triangle that is not collapsed. Exact.
[[nodiscard]] Meeting meet(const Point& p, const Point& q, const std::array<Point, 3>& triangle) noexcept;

}  // namespace svt::validate
