#pragma once
/// \file
/// Values between two values of JSON.

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace svt::illustrate {

/// The value at `share` (0..1) between two members of a scene.
/// \param pointer  of the member: colours are texts of members named "color" or "background", regions those of "cut"
///                 and "keep"
/// \return the value, or `from` if the values cannot be interpolated
[[nodiscard]] nlohmann::ordered_json valueBetween(const nlohmann::ordered_json& from, const nlohmann::ordered_json& to,
                                                  double share, std::string_view pointer);

/// Interpolates the numbers of two texts that are otherwise equal; `from` for other texts.
[[nodiscard]] std::string textBetween(const std::string& from, const std::string& to, double share);

}  // namespace svt::illustrate
