#pragma once
/// \file
/// Features in time: CityGML and CityJSON state when a feature begins and ends.

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>

#include <string>
#include <string_view>

namespace svt::readers {

/// Whether a text is a day as YYYY-MM-DD.
[[nodiscard]] bool isDay(std::string_view text) noexcept;

/// Removes features that do not exist on a day, with all features below them. A feature ends with its attribute
/// terminationDate or validTo, and begins with creationDate or validFrom; on the day of its end it no longer exists.
/// \param date         YYYY-MM-DD; empty: today in UTC, and beginnings do not count; "all": nothing is removed
/// \param diagnostics  receives one finding FeatureEnded with the number of removed features and their first ids; may be
///                     null
/// \return number of features with such dates that were removed. Cost: O(features).
std::size_t removeEnded(model::BuildingModel& model, const std::string& date, Diagnostics* diagnostics);

}  // namespace svt::readers
