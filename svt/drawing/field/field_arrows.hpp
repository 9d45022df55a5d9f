#pragma once
/// \file
/// Arrows of a vector field within the regions of a section.

#include <svt/drawing/field/region_grid.hpp>
#include <svt/drawing/field_drawing.hpp>

#include <deque>
#include <vector>

namespace svt::drawing {

/// The distance between arrows that options ask for, or the usual one for the size of all regions.
/// \return metres, 0: none; or BadArgument if there would be more than kMostArrows
[[nodiscard]] Result<double> arrowStepOf(const std::deque<RegionGrid>& grids, const FieldDrawingOptions& options);

/// Arrows at whole multiples of the step that lie within one region. Longer values than `longest` have arrows of the
/// same length.
/// \param source  its field and sampler are those of the vectors
/// Cost: O(arrows * (edges of a row + runs of a column)).
[[nodiscard]] std::vector<FieldArrow> findArrows(const std::deque<RegionGrid>& grids, const FieldSource& source,
                                                 double step, double longest);

}  // namespace svt::drawing
