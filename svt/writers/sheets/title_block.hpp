#pragma once
/// \file
/// The title block of a sheet with the fields of ISO 7200, and the legend of hatches beside or above it.

#include <svt/writers/sheets/sheet_details.hpp>

#include <string>

namespace svt::writers {

/// The facts of a model. Cost: O(labels).
[[nodiscard]] ModelFacts modelFacts(const volume::SemanticVolume& volume);

/// The block of 180 x 36 mm at the lower right. Unknown fields have a dash.
void paintTitleBlock(const BlockContext& context, SheetCanvas& canvas);

/// The hatches that the views of the sheet use, with their names; nothing without hatches.
void paintLegend(const BlockContext& context, SheetCanvas& canvas);

/// The revisions that the views of the sheet show, above the block and the legend; nothing without revisions.
void paintRevisionList(const BlockContext& context, SheetCanvas& canvas);

}  // namespace svt::writers
