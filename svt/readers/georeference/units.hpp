#pragma once
/// \file
/// The unit of lengths of a model: of the user, else of the file, else metres where that is plausible.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/model/building_model.hpp>

#include <span>
#include <string_view>

namespace svt::readers::georeference {

/// Metres per unit of heights by the third of `uomLabels`; 0: unknown.
[[nodiscard]] double heightUnitOf(std::string_view uomLabels) noexcept;

/// Metres per unit of the lengths of a model that is not in degrees.
/// \param model   with the coordinates of the file
/// \param labels  `uomLabels`, such as "mm mm mm"; empty: none
/// \param stated  by the user, metres per unit; 0: not stated
/// \return the unit; UnitInDoubt if nobody states one, and half of the rooms are so high (over 100) that metres are not
///         plausible. Feet in `labels` count as 1, because a projection in feet has its own conversion.
[[nodiscard]] Result<double> unitOfModel(const model::BuildingModel& model, std::string_view labels, double stated,
                                         const Place& place);

/// Half of the buildings, their parts and rooms with geometry are at least as wide along x or y, in units of the file; 0
/// without any.
/// \param anchors  as in GivenCrs: a shape that was placed by adding metres to degrees counts as its anchor
[[nodiscard]] double medianWidth(const model::BuildingModel& model, std::span<const Vec3d> anchors);

/// Warns of a model whose unit nobody states, if half of its rooms are higher than 10 units.
void warnOfHighRooms(const model::BuildingModel& model, const Place& place, Diagnostics& diagnostics);

}  // namespace svt::readers::georeference
