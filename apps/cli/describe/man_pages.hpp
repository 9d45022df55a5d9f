#pragma once
/// \file
/// Manual pages (roff, macro package man).

#include <optional>
#include <string>
#include <string_view>

namespace svt::cli {

/// The page of a command, svt-build(1), or of svt(1) itself where `command` is empty; nothing where there is none.
[[nodiscard]] std::optional<std::string> manPage(std::string_view command);

}  // namespace svt::cli
