#pragma once
/// \file
/// Solids between cross sections that stand along a curve: roads, bridge decks, ducts that widen.

#include <svt/readers/ifc_shape/body.hpp>
#include <svt/readers/ifc_shape/ifc_file.hpp>

#include <string>
#include <vector>

namespace svt::readers::ifc {

/// IfcSectionedSolidHorizontal and IfcSectionedSpine. Between two sections their corners move evenly along the curve, so
/// sections must have equally many; where the directrix of a solid bends, there is a section between.
/// \return closed faces, one body for each area of the profiles; none where it cannot be read: then `why` says it
[[nodiscard]] std::vector<std::vector<model::Polygon>> readSectioned(const IfcFile& file, RecordIndex item,
                                                                     std::string& why);

}  // namespace svt::readers::ifc
