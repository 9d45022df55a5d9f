#pragma once
/// \file
/// Values between two values of JSON.

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace svt::illustrate {

/// The value at `share` (0..1) between two members of a scene.
/// \param pointer  of the member: colours are texts of members called "color" or "background", regions those of "cut"
///                 and "keep"
/// \return `from` as it is where nothing lies between
[[nodiscard]] nlohmann::ordered_json valueBetween(const nlohmann::ordered_json& from, const nlohmann::ordered_json& to,
                                                  double share, std::string_view pointer);

/// Two texts that are the same but for their numbers, with the numbers between; `from` if they are not.
[[nodiscard]] std::string textBetween(const std::string& from, const std::string& to, double share);

}  // namespace svt::illustrate
