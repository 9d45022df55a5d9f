#pragma once
/// \file
/// Reads the command line and runs the command that it names.

namespace svt::cli {

/// Reads the command line and runs the command that it names; prints help, the version, or a message on a wrong usage.
/// \return the exit code
int runCommandLine(int argc, char** argv);

}  // namespace svt::cli
