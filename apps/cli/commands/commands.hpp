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
Action connectCityPlan(Command& command);
Action connectCityRun(Command& command);
Action connectCityTask(Command& command);
Action connectCityStatus(Command& command);
Action connectCityMerge(Command& command);
Action connectCityInfo(Command& command);
Action connectCityExtract(Command& command);
Action connectDoctor(Command& command);
Action connectDescribe(Command& command);

/// The version of this program as plans of cities name it.
[[nodiscard]] std::string programOfCity();

}  // namespace svt::cli
