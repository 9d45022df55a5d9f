#pragma once
/// \file
/// Marks of doors and windows in plans, which match the schedule, and windows drawn by their panes where the scale is too
/// small for their frames.

#include <svt/drawing/opening_schedule.hpp>
#include <svt/writers/marks/free_space.hpp>

namespace svt::writers {

/// A mark beside each opening that the plan cuts: doors in a circle, windows in a hexagon. Each finds a place that is
/// clear of lines, near the opening; a thin line leads to it. Without a clear place, the mark covers lines.
/// \param millimetres  on paper per metre
[[nodiscard]] MarkShapes placeOpeningMarks(const drawing::SectionDrawing& drawing,
                                           const drawing::OpeningSchedule& schedule, double millimetres,
                                           FreeSpace& space);

/// Windows whose frame is less than 1.2 mm deep on paper, as one pane between two thin ends; without it their lines merge
/// to a bar. A window that is drawn as one block gets its pane in the middle.
[[nodiscard]] MarkShapes drawPanes(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                   const drawing::OpeningSchedule& schedule, double millimetres);

}  // namespace svt::writers
