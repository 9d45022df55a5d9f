#pragma once
/// \file
/// Which component gets which hatch where it is cut.

#include <svt/render/hatch.hpp>
#include <svt/volume/label_table.hpp>

#include <vector>

namespace svt::illustrate {

/// Entry per label, by material where the model tells one, else by class, kind and name: walls are masonry, slabs and
/// beams reinforced concrete, rafters timber, ground earth. Spaces have none.
[[nodiscard]] std::vector<render::Hatch> hatchesOf(const volume::LabelTable& labels);

}  // namespace svt::illustrate
