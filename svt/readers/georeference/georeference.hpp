#pragma once
/// \file
/// Converts the coordinates of a model to metres east, north and up: order of axes, degrees, feet, and features that
/// lie on another continent. The last step of every reader.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/read_options.hpp>

#include <span>
#include <string>

namespace svt::readers::georeference {

/// Facts in the file about its coordinates.
struct GivenCrs {
    std::string name;          ///< srsName or referenceSystem; empty: none
    std::string units;         ///< uomLabels of GML, such as "deg deg m"; empty: none
    bool isEastFirst = false;  ///< the format has east first, regardless of the name (CityJSON)
    Place place;               ///< of the name
    /// For each polygon of the model, the point of the CRS from which its shape is measured in metres
    /// (ImplicitGeometry); kNoAnchor for other polygons. Empty: no such shapes.
    std::span<const Vec3d> anchors{};
};
inline constexpr Vec3d kNoAnchor{kInfinity, kInfinity, kInfinity};

/// Sets `model.crs` and converts all coordinates to metres in the order east, north, up.
///
/// Heights keep their unit and datum, except that feet become metres. The unit of heights is that of `units`, else of
/// the vertical CRS in the name, else of a projection in feet.
/// \param model  with the coordinates of the file; polygons that no geometry uses do not change
/// \return GeographicCrs for degrees of an unknown system; CannotProject if coordinates cannot be converted to metres;
///         BadArgument for a wrong options.crs. Findings: GeographicCrs and ForeignUnit (the conversion), FarFeature,
///         BadValue (name and coordinates contradict each other). Cost: O(points).
[[nodiscard]] Result<void> georeference(model::BuildingModel& model, const GivenCrs& given, const ReadOptions& options,
                                        Diagnostics& diagnostics);

}  // namespace svt::readers::georeference
