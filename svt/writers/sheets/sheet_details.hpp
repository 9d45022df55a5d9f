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

/// Facts of the model for a title block. Placeholders of templates, such as "Enter address here", count as absent.
struct ModelFacts {
    std::string project;   ///< long name of the project; else the name of the model
    std::string building;  ///< names of the buildings
    std::string address;   ///< of a building, or of the site
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
    const ModelFacts& facts;
};

/// The marks of a view.
struct ViewMarks {
    std::vector<MarkShapes> layers;
    std::vector<std::string> below;  ///< lines beside the caption
    /// The lines of stamps that have no place, or only a part of them.
    std::vector<std::vector<std::string>> withoutStamp;
};

/// The list of rooms without a stamp beside a caption.
struct StampList {
    std::vector<std::string> lines;  ///< empty if each room has its stamp
    bool needsTable = false;         ///< the rooms do not fit: the line refers to stampTable()
};
/// \param width  of the free place beside the caption, millimetres
[[nodiscard]] StampList stampList(const ViewMarks& marks, double width, SheetLanguage language);
/// The same rooms as a table, for sheets of its own.
[[nodiscard]] SheetTable stampTable(const ViewMarks& marks, const std::string& caption, SheetLanguage language);

/// Stamps of rooms, and in plans the marks of openings, stairs and grids.
[[nodiscard]] ViewMarks marksOf(const ViewContext& context);
/// The groups of lines of DIN 1356-1, in the series of ISO 128-2. `scale` is 100 for 1:100.
[[nodiscard]] LineWidths widthsOf(double scale) noexcept;

}  // namespace svt::writers
