#pragma once
/// \file
/// The ground floor among the levels of a building.

#include <svt/drawing/building_levels.hpp>

#include <string_view>

namespace svt::drawing {

/// Whether the name of a storey has a word for basements or foundations.
[[nodiscard]] bool isNamedBelowGround(std::string_view name);

/// The index of the ground floor, see findLevels(). There must be levels.
[[nodiscard]] std::size_t groundFloorOf(const std::vector<BuildingLevel>& levels, const volume::SemanticVolume& volume);

}  // namespace svt::drawing
