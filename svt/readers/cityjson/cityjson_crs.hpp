#pragma once
/// \file
/// The coordinate reference system of a CityJSON file.

#include <svt/readers/cityjson/cityjson_json.hpp>

#include <svt/model/building_model.hpp>

namespace svt::readers::cityjson {

/// Sets the name and CRS of `model` from the member `metadata`.
void readMetadata(const std::optional<json::element>& metadata, model::BuildingModel& model, std::string_view file,
                  Diagnostics& diagnostics);

/// Reorders the axes of `model` to (east, north). CityJSON does not define their order and files have east first, so
/// they are swapped only if the magnitude of the coordinates proves that north comes first.
/// \return GeographicCrs if the coordinates are degrees (see gml_crs.hpp). Cost: O(points).
[[nodiscard]] Result<void> settleCrs(model::BuildingModel& model, std::string_view file, Diagnostics& diagnostics);

}  // namespace svt::readers::cityjson
