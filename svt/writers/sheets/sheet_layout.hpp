#pragma once
/// \file
/// Which view stands where on which sheet, at which scale.

#include <svt/writers/sheet_writer.hpp>
#include <svt/writers/sheets/drawing_painter.hpp>

#include <string>
#include <utility>
#include <vector>

namespace svt::writers {

/// A paper of ISO 216, landscape, with the frame of ISO 5457, millimetres.
struct SheetPaper {
    std::string name;
    double width = 420, height = 297;
    double left = 20, top = 10, right = 410, bottom = 287;  ///< of the frame
    /// The block stands at the lower right; views stand above the strip beside it.
    static constexpr double kTitleWidth = 180, kTitleHeight = 36;
};

struct PlacedView {
    std::size_t view = 0;  ///< of SheetContent
    DrawingPlace place;
    double width = 0, height = 0;  ///< of the drawing, millimetres
};
struct Sheet {
    illustrate::ViewKind kind = illustrate::ViewKind::Plan;
    std::vector<PlacedView> views;
};
struct SheetLayout {
    SheetPaper paper;
    double scale = 100;
    std::vector<Sheet> sheets;
};

/// Lays out views in rows, each kind on sheets of its own. Views without lines are left out.
/// \return the layout, or BadArgument, see makeSvgSheets()
[[nodiscard]] Result<SheetLayout> layOutSheets(const SheetContent& content, const SheetOptions& options);

}  // namespace svt::writers
