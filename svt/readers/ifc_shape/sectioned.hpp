#pragma once
/// \file
/// Solids between cross sections along a curve: roads, bridge decks, ducts that widen.

#include <svt/readers/ifc_shape/body.hpp>
#include <svt/readers/ifc_shape/ifc_file.hpp>

#include <string>
#include <vector>

namespace svt::readers::ifc {

/// IfcSectionedSolidHorizontal and IfcSectionedSpine. Corners move evenly along the curve between two sections, which
/// must have the same number of corners. Each bend of the directrix of a solid gets a section of its own.
/// \return closed faces, one body per area of the profiles; none, and a reason in `why`, if it is unreadable
[[nodiscard]] std::vector<std::vector<model::Polygon>> readSectioned(const IfcFile& file, RecordIndex item,
                                                                     std::string& why);

}  // namespace svt::readers::ifc
