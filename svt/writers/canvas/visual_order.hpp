#pragma once
/// \file
/// Arabic and Hebrew text in the order and the forms in which it is drawn from left to right.

#include <optional>
#include <string>
#include <string_view>

namespace svt::writers {

/// Whether a text has letters of scripts that run from right to left; false for invalid UTF-8.
[[nodiscard]] bool hasRightToLeft(std::string_view text) noexcept;

/// The letters from left to right by the bidirectional algorithm of Unicode, and Arabic letters in the forms that join
/// them. The first letter with a direction decides that of the whole text.
/// \return nothing if the FriBidi library is missing
[[nodiscard]] std::optional<std::string> visualOrder(std::string_view text);

}  // namespace svt::writers
