#pragma once
/// \file
/// The files of a plan: plan.json, tiles.bin, features.bin.

#include <svt/city/city_plan.hpp>

#include <string>

namespace svt::city {

inline constexpr std::size_t kTileBytes = 40, kFeatureBytes = 32;

[[nodiscard]] std::string tileBytes(const PlanTile& tile);
[[nodiscard]] std::string featureBytes(const PlanFeature& feature);
/// plan.json with the digest `digest`.
[[nodiscard]] std::string planJson(const Plan& plan, const std::string& digest);

}  // namespace svt::city
