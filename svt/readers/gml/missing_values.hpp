#pragma once
/// \file
/// Numbers that mean "unknown": some programs write -9999 and similar numbers if a height or year is missing.

#include <string_view>

namespace svt::readers::gml {

/// Whether `value` stands for a missing value of the attribute `name`. These are 9999, 99999 and 999999, positive or
/// negative, for heights, diameters, storeys and years. In a name with parts ("height/value"), one part is sufficient.
[[nodiscard]] bool isMissingValue(std::string_view name, double value) noexcept;

}  // namespace svt::readers::gml
