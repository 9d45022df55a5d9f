#pragma once
/// \file
/// What a plane cuts out of a volume, as closed polygons: the drawing of a plan or a section.
///
/// Each brick that the plane meets is cut into convex pieces of one label: a brick of one label is one piece, a coded
/// brick is split by its cuts and planes, a brick of voxels by its voxels. Pieces get the same corners where they meet,
/// as whole numbers of a quantum, so that what is left when equal labels join are borders that both neighbors share,
/// point by point. A border is straightened once, for both.

#include <svt/core/result.hpp>
#include <svt/illustrate/section_plane.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace svt::illustrate {

/// A point of the drawing, metres along the frame's u and v.
struct PlanePoint {
    double u = 0, v = 0;
    friend bool operator==(const PlanePoint&, const PlanePoint&) = default;
};

/// Where the drawing lies in world space. u, v and normal are of length 1, at right angles and right-handed.
///
/// Horizontal planes are drawn as seen from above: u and v are the grid's x and y axes. All others are drawn as seen
/// from the side that is cut away: v points up as steeply as the plane does, u to the right.
struct PlaneFrame {
    Vec3d origin{};  ///< the point of the plane that is nearest to the grid's lower corner
    Vec3d u{1, 0, 0}, v{0, 1, 0}, normal{0, 0, 1};

    [[nodiscard]] Vec3d worldFromPlane(PlanePoint p) const noexcept { return origin + u * p.u + v * p.v; }
    /// Along the normal if `world` is not on the plane.
    [[nodiscard]] PlanePoint planeFromWorld(Vec3d world) const noexcept {
        return {dot(world - origin, u), dot(world - origin, v)};
    }
};

/// Frame of a plane that cuts `grid`.
[[nodiscard]] PlaneFrame frameOf(const SectionPlane& plane, const volume::Grid& grid);

/// A closed ring; the first point is not repeated at the end.
using Ring = std::vector<PlanePoint>;

/// An outer ring, counter-clockwise, and its holes, clockwise. Rings are simple; they may touch at single points.
struct SectionPolygon {
    Ring outer;
    std::vector<Ring> holes;
    double area = 0;  ///< m2, without holes
};

/// All that is cut of one label.
struct SectionComponent {
    std::uint32_t label = 0;  ///< index into LabelTable::labels
    std::vector<SectionPolygon> polygons;
    double area = 0;  ///< m2
    /// How far `area` may be off, m2: each piece of border lies within half a voxel's extent across it of where the
    /// object's surface stands, and within the tolerance. For surfaces that meet the plane at the angle t, divide by
    /// sin t. Where cuts and planes stand for the voxels the true error is far smaller. Space that the object gave to
    /// finer components is not counted.
    double areaBound = 0;
};

/// A line between two labels, each drawn once.
struct SectionBorder {
    std::vector<PlanePoint> points;  ///< a closed one repeats the first at the end
    std::uint32_t left = 0;          ///< label on the left side as the points run, or volume::kNoLabel
    std::uint32_t right = 0;
};

/// Total of one class.
struct ClassArea {
    std::string className;
    std::size_t components = 0;
    double area = 0;  ///< m2
};

struct SectionDrawing {
    SectionPlane plane;
    PlaneFrame frame;
    std::vector<SectionComponent> components;  ///< by label, ascending; only those that are cut
    std::vector<SectionBorder> borders;
    std::vector<ClassArea> classes;  ///< by name
    double area = 0;                 ///< of all components, m2
    double quantum = 0;              ///< all coordinates are whole numbers of it, metres
    double tolerance = 0;            ///< as used, metres
};

struct SectionOptions {
    std::vector<std::string> show;  ///< queries; what none of them selects is left out. Empty: all is shown
    std::vector<std::string> hide;  ///< queries; what one of them selects is left out
    bool spaces = true;             ///< rooms, units and storeys too
    double smallestArea = 0;        ///< m2; polygons with less are left out
    /// How far a border may be moved where points on a line are dropped, metres; below 0: a hundredth of the smallest
    /// spacing.
    double tolerance = -1;
    int threads = 0;  ///< 0: all cores; the result does not depend on it
};

/// Cuts `volume` with `plane`. What is left out leaves a gap, as background does; where the plane runs along faces of
/// voxels, those on the side that is kept are cut.
///
/// All coordinates are whole numbers of `quantum`, a power of two, at most 2^-28 of the largest that the grid can have.
/// All phases of an object's pattern are one label. A drawing without components is no error.
/// \return the drawing, or
///         - BadSection               the plane's normal or point is not finite, or the normal is zero
///         - BadQuery, NothingSelected  of show and hide
///         - BadArgument              smallestArea or tolerance is not finite
///         - GridTooLarge             see BrickVolume::fromColumns
/// Cost: that of the bricks, and 1 to 2 us for each brick that is met, 50 us where it has voxels.
[[nodiscard]] Result<SectionDrawing> drawSection(const volume::SemanticVolume& volume, const SectionPlane& plane,
                                                 const SectionOptions& options = {});

/// The same with bricks at hand. `bricks` are those of `volume`.
[[nodiscard]] Result<SectionDrawing> drawSection(const volume::SemanticVolume& volume,
                                                 const volume::BrickVolume& bricks, const SectionPlane& plane,
                                                 const SectionOptions& options = {});

/// A rectangle in a polygon where a text may stand.
struct LabelPlace {
    PlanePoint center;
    double width = 0, height = 0;  ///< metres
};
/// The largest one for a text about twice as wide as high, by the polygon's extent on 32 levels; what is smaller
/// than a level may be overlooked. Cost: O(32 points).
[[nodiscard]] LabelPlace labelPlaceOf(const SectionPolygon& polygon);

}  // namespace svt::illustrate
