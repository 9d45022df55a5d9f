#pragma once
/// \file
/// Leaves out what a plan cannot show before its meshes are projected: without this, the plan of each storey would
/// project all others.
///
///     cut     ---------------   looking up: the slab above and the cut walls cover the storeys beyond it
///     slab    ===============   that lie within their outline; all lines there are hidden
///     beyond   [ ]  [ ]  [ ]

#include <svt/drawing/beyond/view_shapes.hpp>

#include <cstdint>
#include <vector>

namespace svt::drawing {

/// The labels that a view of addLinesBeyond() needs. Other labels change nothing in it:
///
/// - A label beyond the depth: a plan of one storey does not show the storey below it.
/// - A copy in a deeper storey: a closed object hides its copies.
/// - A label within the common outline of cut components and of nearer faces.
///
/// \param drawing     with the cut
/// \param depth       see BeyondOptions::depth; 0: none
/// \param projection  of the view; the labels near the eye are added to it
/// \return one entry per label, 1 for needed ones; empty: all are needed. Views that are not horizontal or have hidden
///         lines need all.
/// Cost: O(labels), and that of projecting and arranging the faces near the eye.
[[nodiscard]] std::vector<std::uint8_t> labelsInView(const volume::SemanticVolume& volume,
                                                     const SectionDrawing& drawing, const ViewOptions& view,
                                                     double depth, const DrawingTables& tables,
                                                     MeshProjection& projection);

}  // namespace svt::drawing
