#pragma once
/// \file
/// Hatches of components, for their caps (cut faces).

#include <svt/analyze/selection.hpp>
#include <svt/render/hatch.hpp>

#include <vector>

namespace svt::drawing {

/// Hatch of each label: by its material if the model has one, otherwise by class, IFC type and name. Walls are masonry,
/// slabs and beams reinforced concrete, rafters timber, ground earth. Spaces have no hatch.
/// \return one hatch per label, by index
[[nodiscard]] std::vector<render::Hatch> labelHatches(const analyze::LabelRows& labels);

}  // namespace svt::drawing
