#pragma once
/// \file
/// Joints of walls in a drawing: cut walls of one material join without a line between them.

#include <svt/drawing/drawing_tables.hpp>
#include <svt/drawing/section_drawing.hpp>

namespace svt::drawing {

/// Removes the borders between walls of one building that have the same hatch from the same material. Layers of
/// different walls join like walls. Layers of one wall keep the line between them. Polygons and areas do not change.
///
/// Call it last: dimensions and lines beyond the cut need all borders.
/// \param tables  of the volume
/// Cost: O(borders), and the hatches if two walls meet.
void joinWalls(SectionDrawing& drawing, const volume::LabelTable& table, const DrawingTables& tables);

}  // namespace svt::drawing
