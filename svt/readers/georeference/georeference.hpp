#pragma once
/// \file
/// Brings the coordinates of a model that was read to metres east, north and up: order of axes, degrees, feet, and
/// features that lie on another continent. The last step of every reader.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/read_options.hpp>

#include <span>
#include <string>

namespace svt::readers::georeference {

/// What the file says of its coordinates.
struct GivenCrs {
    std::string name;          ///< srsName or referenceSystem; empty: none
    std::string units;         ///< uomLabels of GML, such as "deg deg m"; empty: none
    bool isEastFirst = false;  ///< the format has east first, whatever the name promises (CityJSON)
    Place place;               ///< where the name stands
    /// Of shapes that are placed at a point of the CRS and measured in metres from there (ImplicitGeometry): that point,
    /// for each polygon of the model; kNoAnchor for others. Empty: none.
    std::span<const Vec3d> anchors{};
};
inline constexpr Vec3d kNoAnchor{kInfinity, kInfinity, kInfinity};

/// Sets `model.crs` and brings all coordinates to metres in the order east, north, up.
///
/// Heights keep their unit and datum, but for feet, which become metres: by `units`, else by the vertical CRS that the
/// name has, else they are in the unit of a projection in feet.
/// \param model  as the file has it; what no geometry uses is left as it is
/// \return GeographicCrs for degrees of no known system; CannotProject where there is no way to metres; BadArgument
///         for a wrong options.crs. Findings: GeographicCrs, ForeignUnit (what was done), FarFeature, BadValue (name and
///         coordinates contradict each other). Cost: O(points).
[[nodiscard]] Result<void> georeference(model::BuildingModel& model, const GivenCrs& given, const ReadOptions& options,
                                        Diagnostics& diagnostics);

}  // namespace svt::readers::georeference
