#pragma once
/// \file
/// Line drawings in three dimensions on a page of their own, as SVG or PDF: what is cut is hatched and has bold outlines,
/// edges are narrow lines, hidden ones dashed (ISO 128-2).

#include <svt/core/result.hpp>
#include <svt/illustrate/line_view.hpp>

#include <string>

namespace svt::writers {

/// \param width  of the page, millimetres; its height follows from the picture. What is beyond the page is cut off
/// \return the document. Equal views give equal bytes
[[nodiscard]] std::string makeViewSvg(const illustrate::LineView& view, const volume::SemanticVolume& volume,
                                      double width);

/// \return the bytes, or NoCairo or CannotWrite
[[nodiscard]] Result<std::string> makeViewPdf(const illustrate::LineView& view, const volume::SemanticVolume& volume,
                                              double width);

}  // namespace svt::writers
