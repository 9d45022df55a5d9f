#pragma once
/// \file
/// Parts of sheets that only some programs draw: stamps and marks, the title block with all its fields, a legend. Sheets
/// call them by this interface, so a program that does not need them does not contain their code (the page).

#include <svt/writers/sheet_writer.hpp>
#include <svt/writers/sheets/drawing_painter.hpp>
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
    std::vector<std::string> below;  ///< lines beside the caption: rooms without a stamp
};

class SheetDetails {
public:
    virtual ~SheetDetails() = default;
    [[nodiscard]] virtual ViewMarks marksOf(const ViewContext& context) const = 0;
    [[nodiscard]] virtual LineWidths widthsOf(double scale) const = 0;
    /// The title block, and the legend beside or above it.
    virtual void paintBlock(const BlockContext& context, SheetCanvas& canvas) const = 0;
};

}  // namespace svt::writers
