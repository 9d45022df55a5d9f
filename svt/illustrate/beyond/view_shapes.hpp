#pragma once
/// \file
/// What is seen of a volume's meshes from a plane: faces that hide, and edges to draw, in the coordinates of the view.
///
///     view space: u and v of the drawing, d the depth behind the plane; the eye is infinitely far away at d < 0
///
///     eye -->  |plane    +------+       faces that look to the eye hide what is behind them; of closed shells
///              |         | box  |       the others need not be asked, for they are behind the former, or behind
///              |         +------+       what is cut
///              d = 0

#include <svt/illustrate/section_drawing.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::illustrate {

/// A triangle, or what the plane leaves of it: convex, in view space.
struct ViewFace {
    std::array<Vec3d, 4> corners;  ///< counter-clockwise in u and v
    std::uint32_t cornerCount = 0;
    Vec3d normal;  ///< unit vector that points away from the eye
    double leastDepth = 0;
    std::uint32_t label = 0;
};

/// An edge to draw, in view space; not behind the plane's other side.
struct ViewEdge {
    Vec3d from, to;
    std::uint32_t label = 0;
    /// Of an edge with one face that looks to the eye: its unit normal (pointing away from the eye), and the side of
    /// the edge where it lies, 1 for the left. 0: any other edge.
    Vec3d normal;
    int faceSide = 0;
    bool isPiercing = false;  ///< no edge of a mesh, but where two of them cross, see piercing.hpp
};

struct ViewShapes {
    std::vector<ViewFace> faces;  ///< largest first
    std::vector<ViewEdge> edges;  ///< by label
};

struct ViewOptions {
    bool looksAtCut = false;  ///< looks at what is cut away instead: the depth grows to the other side
    bool everyEdge = false;   ///< also edges of closed shells between faces that look away
};

/// Projects the meshes of `volume`. Faces that are seen from the side, and what is in front of the plane, are left out.
/// What hides: objects that are drawn, but spaces and closure surfaces. A room that is a hole in a closed building and
/// has no surfaces of its own shows its shell from within.
/// Edges: where a face ends, creases over 20 degrees, and where a round surface turns away from the eye.
/// \param isDrawn  by label
[[nodiscard]] ViewShapes projectMeshes(const volume::SemanticVolume& volume, const SectionPlane& plane,
                                       const PlaneAxes& axes, std::span<const std::uint8_t> isDrawn,
                                       const ViewOptions& options);

}  // namespace svt::illustrate
