#pragma once
/// \file
/// Cuts the triangles of a volume's meshes with a plane.
///
/// A corner on the plane counts as on the side that is cut away, so that rounding never decides whether faces and edges
/// in the plane are drawn. The drawing shows the parts just before the plane. If edges lie nearly, but not exactly, in
/// the plane, the plane is moved slightly to the side that is kept.

#include <svt/drawing/drawing_tables.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/vector_parts.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::drawing {

/// The segment of one triangle; for a closed mesh the inside is to the left.
struct CutSegment {
    PlanePoint from, to;
    std::uint32_t label = 0;
};

struct MeshCut {
    std::vector<CutSegment> segments;  ///< labels ascend; a closed mesh gives closed rings, point by point
    std::size_t edgesInPlane = 0;      ///< edges of triangles that lie in the plane as given
    double shift = 0;                  ///< distance that the plane was moved to the kept side, metres
    std::size_t visited = 0;           ///< triangles of runs near the plane
};

/// Cuts all triangles with the plane through `axes`.
/// \param origin       Grid::origin()
/// \param keepsAbove   the side to which axes.normal points is kept, not cut away
/// \param runs         of `parts`, see DrawingTables::runs()
/// Cost: O(runs + triangles of runs that meet the plane).
[[nodiscard]] MeshCut cutMeshes(const volume::VectorParts& parts, Vec3d origin, const PlaneAxes& axes, bool keepsAbove,
                                std::span<const MeshRun> runs);

}  // namespace svt::drawing
