#pragma once
/// \file
/// Reads the command line and runs the command that it names.

#include <apps/cli/options/catalog.hpp>

#include <string>
#include <string_view>

namespace svt::cli {

/// Reads the command line and runs the command that it names; prints help, the version, or a message on a wrong usage.
/// \return the exit code
int runCommandLine(int argc, char** argv);

/// The help text of a command; the list of all commands if `command` is empty.
[[nodiscard]] std::string helpText(std::string_view command);

}  // namespace svt::cli
