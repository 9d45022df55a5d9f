#pragma once
/// \file
/// Polygons in one plane, laid over each other: the parts that the same claims cover, as polygons with holes.

#include <svt/core/vec.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace svt::analyze {

using OverlayPoint = std::array<double, 2>;
using OverlayRing = std::vector<OverlayPoint>;

struct OverlayPolygon {
    OverlayRing outer;               ///< counter-clockwise; the first point is not repeated
    std::vector<OverlayRing> holes;  ///< clockwise
    double area = 0;                 ///< without holes
};

/// The parts of the plane that the same claims cover.
struct OverlayRegion {
    std::vector<std::uint32_t> claims;  ///< ascending, at least one
    std::vector<OverlayPolygon> polygons;
};

/// Axes of a plane: u, v and normal are orthonormal and right-handed.
struct OverlayAxes {
    Vec3d u{1, 0, 0}, v{0, 1, 0}, normal{0, 0, 1};

    /// v is the steepest upward direction; horizontal planes have the axes x and y.
    [[nodiscard]] static OverlayAxes across(Vec3d normal) noexcept;
    [[nodiscard]] OverlayPoint flat(Vec3d p) const noexcept { return {dot(p, u), dot(p, v)}; }
    [[nodiscard]] Vec3d inSpace(OverlayPoint p, double height) const noexcept {
        return u * p[0] + v * p[1] + normal * height;
    }
};

class PlaneOverlay {
public:
    /// \param extent  maximum distance of a coordinate from 0
    /// \param snap    points within this distance become one
    PlaneOverlay(double extent, double snap);

    /// \param ring  counter-clockwise: adds to the claim; clockwise: a hole of it
    void add(const OverlayRing& ring, std::uint32_t claim);

    /// The regions, ordered by claims. Strips thinner than five times `snap` are left out. Empty if the arrangement
    /// does not settle (see plane/arrangement.hpp).
    /// Cost: O(n log n) for n edges.
    [[nodiscard]] std::optional<std::vector<OverlayRegion>> run() const;

private:
    struct Segment {
        std::array<std::int64_t, 4> ends;  // u, v of both
        std::uint32_t claim;
    };
    double unit_, snap_;
    std::vector<Segment> segments_;
};

/// Points inside of a polygon, spread over it: at least one, at most 4 per stretch of 8 levels.
[[nodiscard]] std::vector<OverlayPoint> pointsInside(const OverlayPolygon& polygon);

}  // namespace svt::analyze
