#pragma once
/// \file
/// Colours as people write them.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <string>
#include <string_view>

namespace svt::image {

/// "#c8b49b", "#fff" or a basic CSS colour name ("tomato", "steelblue") -> sRGB, or BadStyle that lists the names.
[[nodiscard]] Result<Vec3f> parseColor(std::string_view text);

/// "#c8b49b", of sRGB 0..1.
[[nodiscard]] std::string colorText(Vec3f color);

}  // namespace svt::image
