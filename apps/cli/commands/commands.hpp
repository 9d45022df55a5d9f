#pragma once
/// \file
/// The commands. Each connects its options with variables of its own and returns what to run.

#include <apps/cli/options/command_line.hpp>

namespace svt::cli {

Action connectSample(Command& command);
Action connectSampleCity(Command& command);
Action connectBuild(Command& command);
Action connectInfo(Command& command);
Action connectCheck(Command& command);
Action connectRender(Command& command);
Action connectSection(Command& command);
Action connectSheets(Command& command);
Action connectQuery(Command& command);
Action connectShell(Command& command);
Action connectConvert(Command& command);
Action connectServe(Command& command);
Action connectView(Command& command);
Action connectPublish(Command& command);
Action connectDoctor(Command& command);
Action connectDescribe(Command& command);

}  // namespace svt::cli
