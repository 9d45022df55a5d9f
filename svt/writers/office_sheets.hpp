#pragma once
/// \file
/// Sheets as an architect's office exchanges them: the schedule of doors and windows, the choice of paper, and DXF with
/// layouts.

#include <svt/writers/dxf_drawing.hpp>
#include <svt/writers/sheet_writer.hpp>
#include <svt/writers/table.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace svt::writers {

/// The schedule of doors and windows: one row per mark and level. Sizes in metres; empty cells are not known.
[[nodiscard]] Table openingTable(const drawing::OpeningSchedule& schedule,
                                 const std::vector<drawing::BuildingLevel>& levels, const volume::LabelTable& labels);

/// The smallest paper from A4 to A0 on which every view fits at the scale of the options.
/// \return its name, or BadArgument: A0 is too small; the message suggests a scale
[[nodiscard]] Result<std::string> smallestPaper(const SheetContent& content, const volume::SemanticVolume& volume,
                                                const SheetOptions& options);

/// A view as DXF with a layout: model space has the drawing in metres, and paper space a sheet of the options' paper with
/// frame, title block, marks, and a viewport at the scale. A file in world coordinates has no layout.
/// \param view      index into content.views
/// \param isAround  of drawing::labelsAroundBuilding(), which is the same for all views
/// \return the text, or an error of makeSvgSheets() for that view
[[nodiscard]] Result<std::string> makeSheetDxf(const SheetContent& content, std::size_t view,
                                               const volume::SemanticVolume& volume, const SheetOptions& options,
                                               const DxfOptions& dxf, std::span<const std::uint8_t> isAround);

/// The options of the title block that are empty: `--creator`, ...
[[nodiscard]] std::vector<std::string> emptyBlockOptions(const drawing::TitleBlock& block);

}  // namespace svt::writers
