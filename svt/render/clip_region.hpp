#pragma once
/// \file
/// Regions of space that are cut away or kept, as plain data. World space, metres.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace svt::render {

/// The points p with dot(normal, p) + offset > 0. The normal need not have length 1.
struct HalfSpace {
    Vec3d normal{0, 0, 1};
    double offset = 0;
    friend bool operator==(const HalfSpace&, const HalfSpace&) = default;
};

/// A convex body bounded by one quadric. It contains the points p with the following condition, where
/// d[i] = dot(axes[i], p - center), with axes in 1 / metres.
///     Ball      d0^2 + d1^2 + d2^2 < 1            also ellipsoids
///     Cylinder  d0^2 + d1^2 < 1                   infinite
///     Cone      d0^2 + d1^2 < d2^2 and d2 > 0     infinite, with its apex at `center`
struct RoundBody {
    enum class Kind : std::uint8_t { Ball, Cylinder, Cone };

    Kind kind = Kind::Ball;
    Vec3d center{};
    std::array<Vec3d, 3> axes{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};

    [[nodiscard]] static RoundBody ball(Vec3d center, double radius);
    /// \param axis  need not have length 1
    [[nodiscard]] static RoundBody cylinder(Vec3d point, Vec3d axis, double radius);
    /// \param u, v  half-axes of the elliptic cross-section one metre along `axis` from the tip, from the axis to the
    ///              surface; u, v and axis must be at right angles
    [[nodiscard]] static RoundBody cone(Vec3d tip, Vec3d axis, Vec3d u, Vec3d v);

    [[nodiscard]] bool contains(Vec3d p) const noexcept;
    /// Outward normal of the surface at p, unit length.
    [[nodiscard]] Vec3d normalAt(Vec3d p) const noexcept;
    friend bool operator==(const RoundBody&, const RoundBody&) = default;
};

/// The intersection of half-spaces and round bodies; 1 to kMaxFaces of them.
struct ConvexPart {
    std::vector<HalfSpace> halfSpaces;
    std::vector<RoundBody> rounds;

    static constexpr std::size_t kMaxFaces = 16;
    friend bool operator==(const ConvexPart&, const ConvexPart&) = default;
};

/// The union of its parts.
struct ClipRegion {
    enum class Mode : std::uint8_t {
        CutAway,   ///< nothing inside the region is drawn
        KeepOnly,  ///< only the inside of the region is drawn
        Gap  ///< only the stretch of a line of sight from part `gap` to the next one is drawn; 0: before all parts
    };

    std::vector<ConvexPart> parts;  ///< at least one
    Mode mode = Mode::CutAway;
    std::uint32_t gap = 0;  ///< of Mode::Gap; parts that meet along a line count as one

    /// Cuts away the side of the plane to which `normal` points: a section.
    [[nodiscard]] static ClipRegion plane(Vec3d normal, Vec3d point);
    /// Cuts away, or keeps only, an axis-parallel box.
    [[nodiscard]] static ClipRegion box(const Box3d& box, Mode mode);

    friend bool operator==(const ClipRegion&, const ClipRegion&) = default;
};

/// The six half-spaces of a box along `axes` (unit vectors), between `low` and `high` metres from `origin`.
[[nodiscard]] ConvexPart boxPart(Vec3d origin, const std::array<Vec3d, 3>& axes, Vec3d low, Vec3d high);

/// \param place  prefix of messages, such as "pass 2"
/// \return BadFrame if a part has no face or too many, or a face is degenerate or not finite
[[nodiscard]] Result<void> checkClip(const ClipRegion& clip, const std::string& place);

}  // namespace svt::render
