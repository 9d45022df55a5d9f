#pragma once
/// \file
/// A comparison of two volumes as one HTML file.

#include <apps/cli/diff/changed_storeys.hpp>
#include <apps/cli/diff/compared.hpp>

#include <string>

namespace svt::cli {

/// The page of `-o report.html`: inputs, grid, sums, a table of the rows that differ with the largest change first, and
/// two pictures of each changed storey. It loads no other files and has no scripts.
/// \param pictures      null: none can be drawn
/// \param noPictures    the reason, as a clause without a full stop; used if `pictures` is null and rows differ
/// \return the page, or an error of ChangePictures
/// Cost: that of changedStoreys() and of two pictures per storey.
[[nodiscard]] Result<std::string> comparisonPage(const Compared& compared, ChangePictures* pictures,
                                                 const std::string& noPictures);

}  // namespace svt::cli
