#pragma once
/// \file
/// The coordinate reference system of a CityJSON file.

#include <svt/readers/cityjson/cityjson_json.hpp>

#include <svt/model/building_model.hpp>
#include <svt/readers/read_options.hpp>

#include <span>

namespace svt::readers::cityjson {

/// Sets the name and CRS of `model` from the member `metadata`.
void readMetadata(const std::optional<json::element>& metadata, model::BuildingModel& model, std::string_view file,
                  Diagnostics& diagnostics);

/// Converts the coordinates of `model` to metres east, north, up; see georeference(). CityJSON does not define the
/// order of axes, and files have east first. Projected coordinates are therefore swapped only if their magnitude proves
/// that north comes first; degrees also if the orientation of faces proves it.
/// \param anchors  see GivenCrs
[[nodiscard]] Result<void> settleCrs(model::BuildingModel& model, std::string_view file, std::span<const Vec3d> anchors,
                                     const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace svt::readers::cityjson
