#pragma once
/// \file
/// The place of each view: its sheet, position and scale.

#include <svt/writers/canvas/drawing_painter.hpp>
#include <svt/writers/sheet_writer.hpp>

#include <string>
#include <utility>
#include <vector>

namespace svt::writers {

/// A paper of ISO 216, landscape, with the frame of ISO 5457, millimetres.
struct SheetPaper {
    std::string name;
    double width = 420, height = 297;
    double left = 20, top = 10, right = 410, bottom = 287;  ///< of the frame
    /// The block is at the lower right; views are above the strip beside it.
    static constexpr double kTitleWidth = 180, kTitleHeight = 36;
    double legend =
        0;  ///< height of a strip for the legend above the block, on paper too narrow for it beside the block
    /// Height of a strip above that one for the list of revisions; 0 where it would make the views smaller.
    double revisions = 0;
    static constexpr std::size_t kRevisionRows = 6;  ///< of a column of this list
};

/// Space for dimensions around a drawing, millimetres.
struct ViewMargins {
    double left = 0, right = 0, above = 0, below = 0;
};

/// Names of storeys at their floors, left of a section.
struct LevelNames {
    static constexpr double kText = 2;     ///< font size, millimetres
    static constexpr double kBeside = 11;  ///< space beside every view, millimetres
    static constexpr double kMost = 30;    ///< longer names are shortened, millimetres
};
/// Width of the lines below these names, millimetres; at least LevelNames::kBeside.
[[nodiscard]] double levelNameWidth(const std::vector<drawing::BuildingLevel>& levels);

struct PlacedView {
    std::size_t view = 0;  ///< index into SheetContent::views
    DrawingPlace place;
    double width = 0, height = 0;  ///< of the drawing, millimetres
    ViewMargins margins;
};
/// Rows of a table on a sheet, below its title and headings.
struct PlacedTable {
    std::size_t table = 0;  ///< index into SheetContent::tables
    std::size_t firstRow = 0, endRow = 0;
    double left = 0, top = 0;     ///< position of the title, millimetres
    std::vector<double> columns;  ///< widths, millimetres
    static constexpr double kTitle = 8, kRow = 5, kText = 2.5, kTitleText = 3.5;
    [[nodiscard]] double width() const noexcept;
};

struct Sheet {
    drawing::ViewKind kind = drawing::ViewKind::Plan;
    int group = -1;  ///< see DrawnView
    double scale = 100;
    std::vector<PlacedView> views;
    std::vector<PlacedTable> tables;  ///< instead of views
};
struct SheetLayout {
    SheetPaper paper;
    double scale = 100;  ///< scale of views whose group does not set one
    std::vector<Sheet> sheets;
};

/// Lays out views in rows, each kind or group on separate sheets. Views without lines are omitted. Tables follow from
/// the top in columns; long tables continue in the next column or on the next sheet.
/// \return the layout, or BadArgument, see makeSvgSheets()
[[nodiscard]] Result<SheetLayout> layOutSheets(const SheetContent& content, const SheetOptions& options);

}  // namespace svt::writers
