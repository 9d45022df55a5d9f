#pragma once
/// \file
/// The take-off of `svt quantities`, which the page makes as well.

#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/table.hpp>

#include <svt/frontend/measure_take_off.hpp>
#include <svt/frontend/take_off.hpp>

namespace svt::cli {

using frontend::chosenTable, frontend::takeOffTable, frontend::takeOffSums, frontend::statedTable,
    frontend::statedFigures;
using frontend::selectedLabels, frontend::completeTakeOff, frontend::measureTakeOff;
using frontend::TakeOff, frontend::TakeOffQuestion, frontend::TakeOffTotals, frontend::StatedFigure;
using frontend::takeOffAssumptions, frontend::takeOffNotes;
using frontend::takeOffJson, frontend::takeOffFile, frontend::takeOffRowJson, frontend::takeOffExteriorJson;

}  // namespace svt::cli
