#pragma once
/// \file
/// The section of a volume by a plane, as closed polygons: the drawing of a plan or a section.
///
/// If the volume stores its meshes, the meshes are cut. The borders of all closed objects form one arrangement of
/// edges, and each region gets the label that voxels there would have. Objects without an interior become lines, and
/// open shells are drawn by their voxels.
///
/// Without meshes, voxels are cut. The section of each brick is split into convex pieces of one label. A brick of one
/// label is one piece, a coded brick is split by its cuts and planes, and a brick of voxels by its voxels. Adjacent
/// pieces share their corners exactly, because coordinates are integers (multiples of a drawing unit). After edges
/// between equal labels are removed, both neighbours share each border point by point. A border is straightened once,
/// for both.

#include <svt/core/diagnostics.hpp>
#include <svt/core/names.hpp>
#include <svt/core/result.hpp>
#include <svt/drawing/section_plane.hpp>
#include <svt/record/members.hpp>
#include <svt/render/hatch.hpp>
#include <svt/volume/brick_volume.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace svt::drawing {

/// A point of the drawing, metres along the axes u and v.
struct PlanePoint {
    double u = 0, v = 0;
    friend bool operator==(const PlanePoint&, const PlanePoint&) = default;
};

/// The drawing's coordinate system in world space. u, v and normal are orthonormal and right-handed.
///
/// Horizontal planes are drawn as seen from above: u and v are the grid's x and y axes. All other planes are drawn as
/// seen from the side that is cut away: v is the steepest upward direction in the plane, and u points to the right.
struct PlaneAxes {
    Vec3d origin{};  ///< the point of the plane nearest to the grid's lower corner
    Vec3d u{1, 0, 0}, v{0, 1, 0}, normal{0, 0, 1};

    [[nodiscard]] Vec3d worldFromPlane(PlanePoint p) const noexcept { return origin + u * p.u + v * p.v; }
    /// Projects `world` onto the plane along its normal.
    [[nodiscard]] PlanePoint planeFromWorld(Vec3d world) const noexcept {
        return {dot(world - origin, u), dot(world - origin, v)};
    }
};

/// Coordinate system of a plane that cuts `grid`.
[[nodiscard]] PlaneAxes makePlaneAxes(const SectionPlane& plane, const volume::Grid& grid);

/// A closed ring; the first point is not repeated at the end.
using Ring = std::vector<PlanePoint>;

/// An outer ring, counter-clockwise, and its holes, clockwise. Rings are simple; they may touch at single points.
struct SectionPolygon {
    Ring outer;
    std::vector<Ring> holes;
    double area = 0;  ///< m2, without holes
};

/// The section of one label.
struct SectionComponent {
    std::uint32_t label = 0;  ///< index into LabelTable::labels
    std::vector<SectionPolygon> polygons;
    double area = 0;  ///< m2
    /// Error bound of `area`, m2. Exact components: each edge of a border is within a few tolerances of the object's
    /// mesh. Between thematic bodies, it is within half a millimetre of the place where surfaces are equally near.
    /// Other components: the distance of each edge to the object's surface is up to half a voxel, measured across the
    /// edge, plus the tolerance. In coded bricks the actual error is far smaller. For surfaces that meet the plane at
    /// an angle t, divide by sin t. Space that the object lost to finer components is not included.
    double areaBound = 0;
    bool isExact = false;   ///< cut from the mesh, not from voxels
    double lineLength = 0;  ///< total length of its lines, metres
    /// Rooms in plans: the floor area of its closed mesh, m2, see roomFloorAreas(); the area in stamps and schedules.
    std::optional<double> floorArea{};
    bool isZone = false;  ///< plans: a room without stamp and dimensions, see RoomShare::isZone

    /// The area to print in the room, m2.
    [[nodiscard]] double stampArea() const noexcept { return floorArea.value_or(area); }
};

/// The section of an object without an interior, where no object of higher priority covers it.
struct SectionLine {
    std::vector<PlanePoint> points;  ///< a closed one repeats the first at the end
    std::uint32_t label = 0;
};

/// A polyline between two labels, each drawn once. Walls of one material join without a border between them.
struct SectionBorder {
    std::vector<PlanePoint> points;  ///< a closed one repeats the first at the end
    std::uint32_t left = 0;          ///< label on the left side in the order of points, or volume::kNoLabel
    std::uint32_t right = 0;
};

/// The kind of a line beyond the cut.
enum class BeyondKind : std::uint8_t {
    Visible,  ///< behind the plane, and seen from it
    Hidden,   ///< behind the plane, and hidden by another object or a cut component
    Above     ///< on the side that is cut away (in a plan: above the cut), and seen from the plane
};

/// A straight line of parts that are not cut, projected onto the plane: an edge of an object, or the line where two
/// objects pierce each other. Lines overlap neither each other nor borders and lines of the cut. Where lines overlap,
/// the first kind of the enumeration is kept.
struct BeyondLine {
    PlanePoint from, to;
    std::uint32_t label = 0;
    BeyondKind kind = BeyondKind::Visible;
    friend bool operator==(const BeyondLine&, const BeyondLine&) = default;
};

/// The unit of the numbers of dimensions.
enum class DimensionUnit : std::uint8_t {
    MetresCentimetres,  ///< metres from 1 m, otherwise centimetres (DIN 1356-1)
    Millimetres,
    Centimetres,
    Metres,
    FeetInches  ///< to the sixteenth of an inch
};
constexpr auto namesOf(DimensionUnit) {
    return std::to_array<Name<DimensionUnit>>({{DimensionUnit::MetresCentimetres, "m-cm"},
                                               {DimensionUnit::Millimetres, "mm"},
                                               {DimensionUnit::Centimetres, "cm"},
                                               {DimensionUnit::Metres, "m"},
                                               {DimensionUnit::FeetInches, "ft-in"}});
}

/// The side of a drawing on which a chain of dimensions stands.
enum class DimensionSide : std::uint8_t { Below, Right, Above, Left };

/// A chain of dimensions along a side: of a plan, the dimensions of the parts that are visible from that side; of an
/// upright section, heights.
struct DimensionChain {
    DimensionSide side = DimensionSide::Below;
    int row = 0;                ///< 0 is nearest to the building
    std::vector<double> stops;  ///< ascending, two or more, metres: u for a chain below or above, otherwise v
    friend bool operator==(const DimensionChain&, const DimensionChain&) = default;
};

/// The reason why a plan or a section has no chains of dimensions although they were requested.
enum class ChainsLeftOut : std::uint8_t {
    No,
    NothingMeasured,  ///< it cuts no wall, slab, roof, column, window or door
    TurnedWalls       ///< most walls of the plan run along axes that are turned against those of the grid
};

/// A clear dimension of a room in a plan, along u or v, between the walls of the room.
struct RoomDimension {
    std::uint32_t label = 0;
    PlanePoint from, to;
    friend bool operator==(const RoomDimension&, const RoomDimension&) = default;
};

/// The heights of a window or door that a plan cuts, metres above the floor of the level.
struct OpeningHeights {
    std::uint32_t label = 0;
    PlanePoint at;         ///< on the face of the wall where the mark stands: outside, if the wall is external
    PlanePoint away;       ///< the direction from the wall to the mark, a unit vector
    double sill = 0;       ///< lower edge of the opening in the wall; 0 or below: a door
    double head = 0;       ///< upper edge
    bool isExact = false;  ///< edges of the opening in the wall; otherwise those of the window or door itself
};

/// The symbol of an opening door in a plan.
struct DoorSwing {
    /// A quarter of a circle, counter-clockwise.
    struct Arc {
        PlanePoint center, from, to;
    };
    std::uint32_t label = 0;
    std::vector<std::vector<PlanePoint>> lines;  ///< open leaves, arrows
    std::vector<Arc> arcs;
};
/// A change of an object between two states of the model, as a table of revisions lists it.
struct Revision {
    std::uint32_t number = 0;  ///< from 1; 0: no drawing shows it
    std::string change;        ///< nameOf() its compare::Change, such as "moved"
    std::string object;        ///< name, otherwise id
    std::string className;
    std::string storey;                    ///< name; empty without one
    std::optional<double> added, removed;  ///< m3; empty: unknown
    friend bool operator==(const Revision&, const Revision&) = default;
};
/// The lines of a drawing that a change added or removed.
struct RevisionLines {
    struct Line {
        PlanePoint from, to;
    };
    Revision revision;
    std::vector<Line> added;    ///< lines of this drawing
    std::vector<Line> removed;  ///< lines that only a drawing of the old state has
};
/// The points of an arc as 12 chords.
[[nodiscard]] std::vector<PlanePoint> pointsOf(const DoorSwing::Arc& arc);

/// Total of one class.
struct ClassArea {
    std::string className;
    std::size_t components = 0;
    double area = 0;  ///< m2
};

struct SectionDrawing {
    SectionPlane plane;
    PlaneAxes axes;
    std::vector<SectionComponent> components;  ///< by label, ascending; only those that the plane cuts
    std::vector<SectionBorder> borders;
    std::vector<SectionLine> lines;             ///< by label
    std::vector<BeyondLine> beyond;             ///< by kind, then label
    std::vector<DimensionChain> dimensions;     ///< by side and row; only on request, in plans and upright sections
    std::vector<RoomDimension> roomDimensions;  ///< by label; only on request, and only in plans
    std::vector<OpeningHeights> openings;       ///< by label; only on request, and only in plans
    ChainsLeftOut chainsLeftOut = ChainsLeftOut::No;
    DimensionUnit dimensionUnit = DimensionUnit::MetresCentimetres;
    std::vector<DoorSwing> doors;    ///< by label; only in plans, if the model describes how doors open
    std::vector<ClassArea> classes;  ///< by name
    double area = 0;                 ///< of all components, m2
    double drawingUnit = 0;          ///< all coordinates are integer multiples of it, metres
    double tolerance = 0;            ///< the effective tolerance, metres
    /// The number of mesh edges in the requested plane (within 0.2 mm). The drawing shows the parts just before it, on
    /// the kept side.
    std::size_t edgesInPlane = 0;
    bool isFromMeshes = false;  ///< meshes were cut; otherwise everything is drawn from voxels
    /// Meshes could not be cut, because their edges did not converge in integer coordinates (see
    /// plane/arrangement.hpp).
    bool isUnsettled = false;
    bool lacksMeshes = false;  ///< lines beyond the cut were requested, but the volume stores no meshes
    double planeShift = 0;     ///< distance that `plane` was moved to the kept side to avoid such edges, metres
    /// The hatches of all labels, if the drawing needed them or SectionOptions::tables were given; null: see
    /// labelHatches(). Drawings of one set share them.
    std::shared_ptr<const std::vector<render::Hatch>> hatches{};
    /// Changes since an old state, by number: see compare/revisions.hpp. Pictures enclose them by revision clouds.
    std::vector<RevisionLines> revisions{};
};

/// The kinds of lines beyond the cut to draw. They come from the meshes that the volume stores, not from voxels.
struct BeyondOptions {
    bool visible = false;
    bool hidden = false;
    bool above = false;
    double depth = 0;  ///< metres: visible and hidden lines that lie farther behind the plane are omitted; 0: none
    [[nodiscard]] bool isAny() const noexcept { return visible || hidden || above; }
};

struct BuildingLevel;  // building_levels.hpp
class DrawingTables;   // drawing_tables.hpp

/// Area in m2 below which finished drawings leave out polygons: slivers between voxels.
inline constexpr double kSliverArea = 1e-4;

struct SectionOptions {
    std::vector<std::string> show;  ///< queries; only labels that one of them selects are drawn; empty: all
    std::vector<std::string> hide;  ///< queries; labels that one of them selects are omitted
    bool spaces = true;             ///< also draw rooms, units and storeys
    double smallestArea = 0;        ///< m2; smaller polygons are omitted
    /// Largest deviation of a simplified border, metres; below 0: a hundredth of the smallest spacing, or four
    /// micrometres if meshes are cut.
    double tolerance = -1;
    BeyondOptions beyond;     ///< lines behind the plane, and above it
    bool dimensions = false;  ///< chains of dimensions, clear dimensions of rooms, heights of openings: see
                              ///< addDimensions() in dimension/dimension_chains.hpp
    DimensionUnit dimensionUnit = DimensionUnit::MetresCentimetres;
    /// Levels of the volume for dimensions, as findLevels() returns them; null: they are found.
    const std::vector<BuildingLevel>* levels = nullptr;
    /// Tables of the volume, for several drawings of it; null: they are made.
    const DrawingTables* tables = nullptr;
    bool doorSwings = true;  ///< plans: door symbols, see findDoorSwings() in section/door_swings.hpp
    bool useMeshes = true;   ///< cut the meshes that the volume stores; false: always cut voxels
    int threads = 0;         ///< 0: all cores; the result does not depend on it
    /// If given, queries of show and hide that select nothing are appended here instead of causing an error.
    std::vector<std::string>* nothing = nullptr;
};

/// The options that a user can set.
record::Members<SectionOptions> membersOf(const SectionOptions*) noexcept;

/// Cuts `volume` with `plane`. Omitted labels become gaps, like background. If the plane coincides with voxel faces,
/// the voxels on the kept side are cut. The same applies to faces of meshes.
///
/// All coordinates are integer multiples of `drawingUnit`, a power of two, at most 2^-28 of the largest coordinate that
/// the grid can have. All phases of an object's pattern are one label. A drawing without components is not an error.
/// \return the drawing, or
///         - BadSection               the plane's normal or point is not finite, or the normal is zero
///         - BadQuery, NothingSelected  of show and hide
///         - BadArgument              smallestArea or tolerance is not finite
///         - GridTooLarge             see BrickVolume::fromColumns
/// Cost: with meshes O(triangles + n log n) for n cut segments, about 2 us each. Without meshes, that of
/// BrickVolume::fromColumns(), plus 1 to 2 us per brick that the plane meets, or 50 us for a brick of voxels. Lines
/// beyond the cut: see addLinesBeyond() in beyond/lines_beyond.hpp.
[[nodiscard]] Result<SectionDrawing> drawSection(const volume::SemanticVolume& volume, const SectionPlane& plane,
                                                 const SectionOptions& options = {});

/// The same with existing bricks, which must be those of `volume`.
[[nodiscard]] Result<SectionDrawing> drawSection(const volume::SemanticVolume& volume,
                                                 const volume::BrickVolume& bricks, const SectionPlane& plane,
                                                 const SectionOptions& options = {});

/// Reports limits of the drawing. One warning lists all areas whose bound is larger than the area. Notes report a plane
/// in faces, and objects that are drawn by their voxels although others are exact.
void reportSection(const SectionDrawing& drawing, const volume::SemanticVolume& volume, Diagnostics& log);
/// The same for several drawings of one volume, each component once. Does not report planes in faces.
void reportSections(std::span<const SectionDrawing* const> drawings, const volume::SemanticVolume& volume,
                    Diagnostics& log);

/// A sentence for the user on drawings whose chains of dimensions were left out, with the reason; empty: none.
[[nodiscard]] std::string leftOutChains(std::span<const SectionDrawing* const> drawings);

/// A rectangle for a text inside a polygon.
struct TextPlace {
    PlanePoint center;
    double width = 0, height = 0;  ///< metres
};
/// The largest rectangle for a text that is about twice as wide as high. The polygon is sampled on 32 levels of v, so
/// details smaller than a level may be missed. Cost: O(32 points).
[[nodiscard]] TextPlace findTextPlace(const SectionPolygon& polygon);

}  // namespace svt::drawing
