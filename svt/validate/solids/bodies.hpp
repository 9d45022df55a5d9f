#pragma once
/// \file
/// The relative position of two closed surfaces: apart, touching, with shared faces, one within the other, overlapping.
/// A triangle of one surface is cut along all lines in which the other meets it. Each piece then lies inside, outside
/// or on the other as a whole, so one point of the piece decides.

#include <svt/validate/solids/crossings.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace svt::validate {

/// A closed surface whose triangles face outwards, away from the enclosed volume.
class Body {
public:
    /// \param points  must outlive the body
    Body(std::vector<Corners> triangles, PointSet points);

    [[nodiscard]] const std::vector<Corners>& triangles() const noexcept { return triangles_; }
    [[nodiscard]] const PointSet& points() const noexcept { return points_; }
    [[nodiscard]] const plane::BoxTree& tree() const noexcept { return tree_; }
    [[nodiscard]] Triangle triangle(std::uint32_t t) const { return points_.corners(triangles_[t]); }

    /// True if `p` (units) is enclosed. Exact for the nearest point of the lattice, which must not lie on the surface.
    [[nodiscard]] bool encloses(Vec3d p) const;

    struct Nearest {
        double distance = 0;  ///< units
        Vec3d normal{};       ///< of the nearest triangle; of several, of the one most parallel to the given normal
    };
    /// The surface near `p` (units), empty if none is within `reach`.
    [[nodiscard]] std::optional<Nearest> near(Vec3d p, double reach, Vec3d normal) const;

private:
    std::vector<Corners> triangles_;
    PointSet points_;
    plane::BoxTree tree_;
};

/// A convex part of a triangle.
struct Piece {
    std::vector<Vec3d> corners;  ///< units
    Vec3d center{};
    double area = 0;
};

/// Cuts a triangle along the parts of segments that lead through it; pieces narrower than `least` stay whole.
[[nodiscard]] std::vector<Piece> cutTriangle(const Triangle& triangle, const std::vector<Segment>& segments,
                                             double least);

/// Lines in which `body` meets the triangle, those of faces in its plane included. Units.
[[nodiscard]] std::vector<Segment> linesOn(const Triangle& triangle, const Body& body, double noise);

/// Areas (square units) of the surface of one body, by their position relative to another.
struct Share {
    double inside = 0, outside = 0;
    double alike = 0;     ///< on its surface, with the same orientation
    double opposite = 0;  ///< on its surface, with the opposite orientation
    Vec3d insideAt{};     ///< a point that lies inside, units
    Vec3d outsideAt{}, onAt{};
    double depth = 0;  ///< of `insideAt` below the surface, at most ten times the noise
};

/// \param noise  units; a point nearer to the surface of `other` lies on it
[[nodiscard]] Share shareOf(const Body& body, const Body& other, double noise);

/// The relative position of two bodies.
struct Relation {
    Share first, second;            ///< of each within the other
    bool haveContact = false;       ///< a common point
    std::optional<Vec3d> crossing;  ///< where an edge of one leads through a face of the other by more than the noise
    /// The same surface, up to the noise.
    [[nodiscard]] bool areSame() const noexcept;
    /// Insides in common, deeper than the noise.
    [[nodiscard]] bool overlap() const noexcept { return first.inside > 0 || second.inside > 0 || areSame(); }
    [[nodiscard]] bool shareFaces() const noexcept { return first.alike + first.opposite > 0; }
};
[[nodiscard]] Relation relate(const Body& first, const Body& second, double noise);

}  // namespace svt::validate
