#pragma once
/// \file
/// Colours as text.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <string>
#include <string_view>

namespace svt::image {

/// Parses "#c8b49b", "#fff" or a basic CSS colour name ("tomato", "steelblue").
/// \return sRGB, 0..1, or BadStyle; the message lists the names
[[nodiscard]] Result<Vec3f> parseColor(std::string_view text);

/// Formats sRGB, 0..1, as "#c8b49b".
[[nodiscard]] std::string colorText(Vec3f color);

}  // namespace svt::image
