#pragma once
/// \file
/// Solids of the generated models: ordered unions and differences of convex prisms in whole
/// millimetres, and their exact boundary. All arithmetic is on integers, so that touching
/// solids share identical polygons, vertex by vertex.

#include <svt/core/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::samples {

using Length = std::int64_t;  ///< millimetres

using Point = Vec3<Length>;  ///< millimetres in the model's own axes (x east, y north, z up)

/// All (v, z) with across * v + up * z <= limit; v is y for Axis::X and x for Axis::Y.
struct HalfPlane {
    Length across = 0, up = 0, limit = 0;
    friend auto operator<=>(const HalfPlane&, const HalfPlane&) = default;
};

/// Direction along which all pieces of a solid are extruded.
enum class Axis : std::uint8_t { X, Y };

/// A convex prism: [from, to] along the solid's axis, times the intersection of half-planes (which must be bounded).
struct Piece {
    Length from = 0, to = 0;
    std::vector<HalfPlane> sides;
    bool adds = true;  ///< false: subtracted from the pieces before it
};

/// Material of a solid; index into materials().
enum class Material : std::uint8_t {
    Brick,
    Concrete,
    Timber,
    RoofTiles,
    Glass,
    Gypsum,
    Fabric,
    Ceramic,
    Steel,
    Paint,
    Air,
    PlasterWhite,
    PlasterSand,
    PlasterOchre,
    PlasterSage,
    RoofBrown,
    RoofSlate
};

/// A solid: the pieces are applied in order; each is added to or subtracted from the result so far.
struct Solid {
    Axis axis = Axis::X;
    Material material = Material::Air;
    std::vector<Piece> pieces;

    Solid& add(Piece piece);
    Solid& cut(Piece piece);
};

/// An axis-aligned box as a piece of a solid with Axis::X.
[[nodiscard]] Piece box(Length x0, Length x1, Length y0, Length y1, Length z0, Length z1);

/// A corner of a piece's section in the plane (v, z) of its half-planes: v / scale, z / scale millimetres.
struct SectionCorner {
    std::int64_t v = 0, z = 0, scale = 1;
    [[nodiscard]] double across() const { return double(v) / double(scale); }
    [[nodiscard]] double up() const { return double(z) / double(scale); }
};

/// The section of a convex prism, counter-clockwise in (v, z), exact.
[[nodiscard]] std::vector<SectionCorner> sectionOf(const Piece& piece);

/// True if `point` (millimetres) lies in the solid; undefined on its boundary.
[[nodiscard]] bool contains(const Solid& solid, Vec3d point);

/// Box around all added pieces; rounded outwards to whole millimetres.
[[nodiscard]] Box3d boundsOf(const Solid& solid);

/// A solid that may touch another solid.
struct Neighbor {
    /// `tag` is any number >= 0 that identifies the solid, which must outlive this.
    Neighbor(const Solid& solid, int tag);

    const Solid* solid;
    int tag;
    Box3d bounds;
    std::vector<Box3d> pieces;  ///< boxes around the solid's pieces
};

/// Points in boundary() are in 1/120 mm: with roof pitches of 3/5, 4/5 or 1, roof lines intersect each other
/// and all whole millimetres on this grid. The vertices left by simplify() are whole millimetres.
inline constexpr Length kUnitsPerMillimetre = 120;

/// A planar face, counter-clockwise seen from outside; further rings are holes.
struct RawFace {
    std::vector<std::vector<Point>> rings;  ///< units of 1/120 mm
    int neighbor = -1;                      ///< tag of the solid on the other side, -1: none
};

struct Boundary {
    std::vector<RawFace> faces;
    double volume = 0;  ///< m3, sum of the convex cells, exact to rounding
};

/// The closed boundary of `solid` as maximal planar faces, split where the neighbour changes.
/// Rings contain every vertex of the cell complex on them; simplify() removes the redundant ones.
/// \param neighbors  solids with Axis::X that do not overlap `solid`; those that do not touch it are ignored
/// Cost: O(planes^3) for the planes of the solid and of touching solids.
[[nodiscard]] Boundary boundary(const Solid& solid, std::span<const Neighbor> neighbors);

/// Adds the vertices at which rings of `face` change direction to `corners`.
void collectCorners(const RawFace& face, std::vector<Point>& corners);

/// Removes from `face` the vertices that are not a corner of any face, so that no edge of one face ends inside an
/// edge of another. `corners` must be sorted.
void simplify(RawFace& face, std::span<const Point> corners);

}  // namespace svt::samples
