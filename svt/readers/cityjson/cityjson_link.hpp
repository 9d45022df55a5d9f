#pragma once
/// \file
/// Internal: joins the objects of a file, each read for itself, into one tree.

#include <svt/readers/cityjson/cityjson_objects.hpp>

namespace svt::readers::cityjson {

/// Appends `objects` (in file order; consumed) to `model`: resolves parents, children and groups, numbers polygons,
/// and gives every semantic surface an id of its own. Features come out in tree order.
/// \return InputTooBig where features or polygons are more than 32 bits can number
/// Cost: O(objects + polygons). Memory: the polygons are moved, not copied.
[[nodiscard]] Result<void> linkObjects(std::vector<ParsedObject> objects, std::string_view file,
                                       model::BuildingModel& model, Diagnostics& diagnostics);

}  // namespace svt::readers::cityjson
