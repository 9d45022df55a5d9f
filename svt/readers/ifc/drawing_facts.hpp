#pragma once
/// \file
/// Attributes that drawings, title blocks and schedules use: stated sizes of doors and windows, risers of stairs,
/// addresses, axes of grids.

#include <svt/model/building_model.hpp>
#include <svt/readers/ifc/structure.hpp>
#include <svt/readers/ifc/units.hpp>

namespace svt::readers::ifc {

/// Adds the facts that a product states; absent or empty ones are omitted.
///
///     IfcDoor, IfcWindow      overallWidth, overallHeight (metres)
///     IfcStairFlight          numberOfRisers, riserHeight, treadLength (metres)
///     IfcSite, IfcBuilding    address: the parts of its IfcPostalAddress, joined by commas
///     IfcGrid                 axis NAME: the ends of a straight axis in the model, `x y z, x y z` (metres)
void addDrawingFacts(const IfcFile& file, const Product& product, const MapPlace& map, model::Feature& feature);

}  // namespace svt::readers::ifc
