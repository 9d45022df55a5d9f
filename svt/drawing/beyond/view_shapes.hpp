#pragma once
/// \file
/// The meshes of a volume as seen from a plane: faces that hide, and edges to draw, in the coordinates of the view.
///
///     view space: u and v of the drawing, d the depth behind the plane; the eye is infinitely far away at d < 0
///
///     eye -->  |plane    +------+       faces that look to the eye hide what is behind them; of closed shells
///              |         | box  |       the others need not be asked, for they are behind the former, or behind
///              |         +------+       what is cut
///              d = 0

#include <svt/drawing/drawing_tables.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace svt::drawing {

/// A triangle, or the part of it behind the plane: convex, in view space.
struct ViewFace {
    std::array<Vec3d, 5> corners;  ///< counter-clockwise in u and v
    std::uint32_t cornerCount = 0;
    Vec3d normal;  ///< unit vector that points away from the eye
    double leastDepth = 0;
    std::uint32_t label = 0;
};

/// An edge to draw, in view space; not behind the plane's other side.
struct ViewEdge {
    Vec3d from, to;
    std::uint32_t label = 0;
    /// For an edge with one face toward the eye: the face's unit normal (pointing away from the eye), and the side of
    /// the edge on which it lies, 1 for the left. Other edges: 0.
    Vec3d normal;
    int faceSide = 0;
    bool isPiercing = false;  ///< not an edge of a mesh, but a line where two of them cross, see piercing.hpp
};

struct ViewShapes {
    std::vector<ViewFace> faces;  ///< largest first
    std::vector<ViewEdge> edges;  ///< by label
};

struct ViewOptions {
    bool looksAtCut = false;  ///< looks at the part that is cut away: the depth grows to the other side
    bool everyEdge = false;   ///< also edges of closed shells between faces that look away
};

/// An eye anywhere, for pictures. Points of view space are (u, v, d) of `axes`, d being the depth behind its origin. A
/// perspective eye is `distance` before that; its view space is that of the picture, with the same u and v, and the
/// depth
///
///     u' = u D / (D + d)    v' = v D / (D + d)    d' = d D / (D + d)
///
/// so that lines and planes are preserved, nearer points have less depth, and points with d = 0 do not move.
struct EyeView {
    PlaneAxes axes;
    Vec3d away{0, 1, 0};      ///< unit vector from the eye along the view
    double distance = 0;      ///< of a perspective eye, metres; 0: parallel
    double nearest = -1e300;  ///< d of the near plane; above -distance
    bool hasCut = false;
    SectionPlane cut;  ///< cuts the model, if hasCut

    /// View space of the picture from that of the model; the point is behind the near plane.
    [[nodiscard]] Vec3d pictured(Vec3d p) const noexcept {
        return distance > 0 ? p * (distance / (distance + p.z)) : p;
    }
    /// (u, v, d) of a point in world space.
    [[nodiscard]] Vec3d viewed(Vec3d world) const noexcept {
        const Vec3d p = world - axes.origin;
        return {dot(p, axes.u), dot(p, axes.v), dot(p, away)};
    }
};

/// Projects the meshes of a volume, label by label. Omits faces that are seen edge-on, and all parts in front of the
/// plane. The drawn objects hide other objects, except spaces and closure surfaces. A room that is a hole in a closed
/// building and has no surfaces of its own shows its shell from within. Edges are ends of faces, creases over 20
/// degrees, and silhouettes of round surfaces.
class MeshProjection {
public:
    /// \param isDrawn  by label
    /// \param tables   of the volume
    /// The arguments must outlive the projection.
    MeshProjection(const volume::SemanticVolume& volume, const SectionPlane& plane, const PlaneAxes& axes,
                   std::span<const std::uint8_t> isDrawn, const ViewOptions& options, const DrawingTables& tables);
    /// As seen by an eye, without the parts in front of the plane of its cut.
    MeshProjection(const volume::SemanticVolume& volume, const EyeView& eye, std::span<const std::uint8_t> isDrawn,
                   const ViewOptions& options, const DrawingTables& tables);
    ~MeshProjection();

    /// Whether the label has a mesh that draws or hides something.
    [[nodiscard]] bool isShown(std::uint32_t label) const;
    /// Projects a shown label, once.
    /// Cost: that of its triangles.
    void add(std::uint32_t label);
    /// The faces of all added labels, in the order in which these were added.
    [[nodiscard]] const std::vector<ViewFace>& faces() const noexcept;
    /// The shapes of the shown labels; adds those that are missing. May be called once.
    /// \param isNeeded  by label: the others are left out, see labelsInView(); empty: all
    [[nodiscard]] ViewShapes take(std::span<const std::uint8_t> isNeeded);

private:
    class Projector;
    std::unique_ptr<Projector> projector_;
};

}  // namespace svt::drawing
