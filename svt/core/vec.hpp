#pragma once
/// \file
/// Small vectors and boxes. Plain data, no hidden cost.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace svt {

template <class T>
struct Vec3 {
    T x{}, y{}, z{};

    [[nodiscard]] constexpr T& operator[](int axis) noexcept { return axis == 0 ? x : axis == 1 ? y : z; }
    [[nodiscard]] constexpr const T& operator[](int axis) const noexcept { return axis == 0 ? x : axis == 1 ? y : z; }
    friend constexpr Vec3 operator+(Vec3 a, Vec3 b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend constexpr Vec3 operator-(Vec3 a, Vec3 b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend constexpr Vec3 operator-(Vec3 a) noexcept { return {-a.x, -a.y, -a.z}; }
    friend constexpr Vec3 operator*(Vec3 a, T s) noexcept { return {a.x * s, a.y * s, a.z * s}; }
    friend constexpr Vec3 operator*(T s, Vec3 a) noexcept { return a * s; }
    friend constexpr Vec3 operator/(Vec3 a, T s) noexcept { return {a.x / s, a.y / s, a.z / s}; }
    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
    friend constexpr auto operator<=>(const Vec3&, const Vec3&) = default;
};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Vec3d = Vec3<double>;
using Vec3f = Vec3<float>;
using Vec3i = Vec3<std::int32_t>;

template <class T>
[[nodiscard]] constexpr T dot(Vec3<T> a, Vec3<T> b) noexcept {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
[[nodiscard]] constexpr Vec3<T> cross(Vec3<T> a, Vec3<T> b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// The same vector in double precision.
template <class T>
[[nodiscard]] constexpr Vec3d toDouble(Vec3<T> v) noexcept {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
/// Component-wise product.
template <class T>
[[nodiscard]] constexpr Vec3<T> scaled(Vec3<T> a, Vec3<T> b) noexcept {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
[[nodiscard]] inline double length(Vec3d a) noexcept { return std::sqrt(dot(a, a)); }
/// Unit vector along `a`, or `a` itself if its length is zero.
[[nodiscard]] inline Vec3d normalized(Vec3d a) noexcept {
    const double l = length(a);
    return l > 0 ? a / l : a;
}
[[nodiscard]] inline bool isFinite(Vec3d a) noexcept {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Axis-aligned box; empty until a point is added.
struct Box3d {
    Vec3d min{kInfinity, kInfinity, kInfinity};
    Vec3d max{-kInfinity, -kInfinity, -kInfinity};

    [[nodiscard]] bool isEmpty() const noexcept { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
    void add(Vec3d p) noexcept {
        min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
        max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
    }
    void add(const Box3d& box) noexcept {
        if (box.isEmpty()) return;
        add(box.min);
        add(box.max);
    }
    [[nodiscard]] Vec3d size() const noexcept { return isEmpty() ? Vec3d{} : max - min; }
    [[nodiscard]] Vec3d center() const noexcept { return (min + max) * 0.5; }
    [[nodiscard]] bool contains(Vec3d p) const noexcept {
        return p.x >= min.x && p.y >= min.y && p.z >= min.z && p.x <= max.x && p.y <= max.y && p.z <= max.z;
    }
    [[nodiscard]] bool overlaps(const Box3d& o) const noexcept {
        return min.x <= o.max.x && o.min.x <= max.x && min.y <= o.max.y && o.min.y <= max.y && min.z <= o.max.z &&
               o.min.z <= max.z;
    }
    friend bool operator==(const Box3d&, const Box3d&) = default;
};

}  // namespace svt
