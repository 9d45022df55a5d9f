#pragma once
/// \file
/// Numbers that mean "not known": producers write -9999 and the like where a height or year is missing.

#include <string_view>

namespace svt::readers::gml {

/// Whether `value` stands for a missing value of the attribute `name`: 9999, 99999 or 999999, or one of them negative,
/// of heights, diameters, storeys and years; of a name with parts ("height/value") one part decides.
[[nodiscard]] bool isMissingValue(std::string_view name, double value) noexcept;

}  // namespace svt::readers::gml
