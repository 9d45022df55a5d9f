#pragma once
/// \file
/// Joins the independently read objects of a file into one tree.

#include <svt/readers/cityjson/cityjson_objects.hpp>

namespace svt::readers::cityjson {

/// Appends `objects` (in file order; consumed) to `model`: resolves parents, children and groups, numbers polygons,
/// and gives every semantic surface a unique id. The resulting features are in tree order.
/// \param anchors  receives the anchors of the polygons of `model`, empty if there are no instances; see GivenCrs
/// \return InputTooBig if there are more features or polygons than 32 bits can number
/// Cost: O(objects + polygons). Memory: the polygons are moved, not copied.
[[nodiscard]] Result<void> linkObjects(std::vector<ParsedObject> objects, std::string_view file,
                                       model::BuildingModel& model, std::vector<Vec3d>& anchors,
                                       Diagnostics& diagnostics);

}  // namespace svt::readers::cityjson
