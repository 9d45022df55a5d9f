#pragma once
/// \file
/// Curves of products without a body: annotations, grids and others.

#include <svt/readers/ifc_shape/ifc_file.hpp>

#include <string>
#include <vector>

namespace svt::readers::ifc {

/// The curves of all representations, of curve sets and geometric sets, borders of filled areas, edges, and those of
/// mapped items.
/// \param definition  IfcProductDefinitionShape
/// \param leftOut     receives items that are unreadable or not lines (texts, points); each once
/// \return lines of at least two points, in the axes of the product, metres
[[nodiscard]] std::vector<std::vector<Vec3d>> readLines(const IfcFile& file, RecordIndex definition,
                                                        std::vector<std::string>& leftOut);

}  // namespace svt::readers::ifc
