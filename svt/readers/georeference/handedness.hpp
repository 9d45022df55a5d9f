#pragma once
/// \file
/// Whether the faces of a model look outward in the order of its axes. This distinguishes north first from east first.

#include <svt/model/building_model.hpp>

namespace svt::readers::georeference {

/// +1 if faces look outward as given, -1 if they do so with x and y swapped: judged by the volumes of solids and by
/// roofs (which face up) and grounds (which face down). 0 if less than nine tenths agree or there is no evidence.
[[nodiscard]] int handedness(const model::BuildingModel& model);

}  // namespace svt::readers::georeference
