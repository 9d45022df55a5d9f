#pragma once
/// \file
/// Parts of sheets beside the drawings, in millimetres on paper: stamps and marks, line widths, the title block and the
/// legend.

#include <svt/writers/canvas/drawing_painter.hpp>
#include <svt/writers/sheet_writer.hpp>
#include <svt/writers/sheets/sheet_layout.hpp>

#include <string>
#include <vector>

namespace svt::writers {

/// A view on its sheet.
struct ViewContext {
    const SheetContent& content;
    const volume::SemanticVolume& volume;
    const SheetOptions& options;
    const DrawnView& view;
    const PlacedView& placed;
    const SheetLayout& layout;
    const Sheet& sheet;
    const RoomNotes& floors;  ///< heights of finished floors, by room
};

/// The sheet around its views.
struct BlockContext {
    const SheetContent& content;
    const volume::SemanticVolume& volume;
    const SheetOptions& options;
    const SheetLayout& layout;
    const Sheet& sheet;
    std::size_t number;         ///< of the sheet, from 0
    const std::string& title;   ///< of its drawings
    const std::string& source;  ///< file and CRS of the model
};

/// The marks of a view.
struct ViewMarks {
    std::vector<MarkShapes> layers;
    std::vector<std::string> below;  ///< lines beside the caption: rooms without a stamp, an assumed ground
};

/// Stamps of rooms, and in plans the marks of openings, stairs and grids.
[[nodiscard]] ViewMarks marksOf(const ViewContext& context);
/// The groups of lines of DIN 1356-1, in the series of ISO 128-2. `scale` is 100 for 1:100.
[[nodiscard]] LineWidths widthsOf(double scale) noexcept;

}  // namespace svt::writers
