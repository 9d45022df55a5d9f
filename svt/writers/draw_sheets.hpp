#pragma once
/// \file
/// Draws a set of sheets: its views, or automatically selected views, and its tables.

#include <svt/drawing/sheet_set.hpp>
#include <svt/writers/sheet_writer.hpp>

#include <string>
#include <vector>

namespace svt::writers {

/// Scale, paper, language and title of a set.
[[nodiscard]] SheetOptions sheetOptionsOf(const drawing::SheetSet& set);

/// Draws all views of a set, and its tables of areas and openings. Bricks are made once, with the first view that needs them.
/// \param set      if it has no sheets, chooseSheetViews() adds them
/// \param threads  0: all cores; the result does not depend on it
/// \param nothing  if given, receives the queries of the set that select nothing
/// \param before   an old state, which is drawn by the planes of the views, too; see SheetContent::before
/// \return the content of the sheets, or an error of viewsOfSet(), chooseSheetViews(), drawSection() or
///         measureFloorAreas()
[[nodiscard]] Result<SheetContent> drawSheets(drawing::SheetSet& set, const volume::SemanticVolume& volume,
                                              int threads = 0, std::vector<std::string>* nothing = nullptr,
                                              const volume::SemanticVolume* before = nullptr);

}  // namespace svt::writers
