#pragma once
/// \file
/// Completion of commands, options and their choices in shells.

#include <string>
#include <string_view>

namespace svt::cli {

/// The script that a shell reads: for bash `source <(svt describe bash)`, for zsh a file _svt in $fpath, for fish a file
/// svt.fish in its completions.
/// \param shell  "bash", "zsh" or "fish"
[[nodiscard]] std::string completionScript(std::string_view shell);

}  // namespace svt::cli
