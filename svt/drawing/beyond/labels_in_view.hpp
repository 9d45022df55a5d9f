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
#include <span>
#include <vector>

namespace svt::drawing {

/// The labels that a view of addLinesBeyond() needs. Other labels change nothing in it: in plan they lie within the
/// common outline of cut components and of faces that are nearer to the cut than the label.
/// \param drawing  with the cut
/// \param depth    see BeyondOptions::depth; 0: none
/// \return one entry per label, 1 for needed ones; empty: all are needed. Views that are not horizontal or have hidden
///         lines need all.
/// Cost: O(labels), and that of projecting and arranging the faces near the cut.
[[nodiscard]] std::vector<std::uint8_t> labelsInView(const volume::SemanticVolume& volume,
                                                     const SectionDrawing& drawing,
                                                     std::span<const std::uint8_t> isDrawn, const ViewOptions& view,
                                                     double depth, const DrawingTables& tables);

}  // namespace svt::drawing
