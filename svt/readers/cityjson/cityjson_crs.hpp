#pragma once
/// \file
/// Internal: the coordinate reference system of a CityJSON file.

#include <svt/readers/cityjson/cityjson_json.hpp>

#include <svt/model/building_model.hpp>

namespace svt::readers::cityjson {

/// Takes name and CRS of `model` from the member `metadata`.
void readMetadata(const std::optional<json::element>& metadata, model::BuildingModel& model, std::string_view file,
                  Diagnostics& diagnostics);

/// Brings the axes of `model` to (east, north). CityJSON says nothing on their order and files have east first, so
/// they are exchanged only where the size of the coordinates proves that north comes first.
/// \return GeographicCrs where the coordinates are degrees (see gml_crs.hpp). Cost: O(points).
[[nodiscard]] Result<void> settleCrs(model::BuildingModel& model, std::string_view file, Diagnostics& diagnostics);

}  // namespace svt::readers::cityjson
