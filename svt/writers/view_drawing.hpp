#pragma once
/// \file
/// Drawings on a page of their own: line drawings in three dimensions as SVG or PDF, and sections as PDF. Cut faces are
/// hatched and have bold outlines, edges are narrow lines, and hidden edges are dashed (ISO 128-2).

#include <svt/core/result.hpp>
#include <svt/drawing/line_view.hpp>
#include <svt/writers/field_look.hpp>
#include <svt/writers/pdf_file.hpp>

#include <string>

namespace svt::writers {

/// \param width  width of the page, millimetres; its height follows from the picture; parts beyond the page are cut off
/// \return the document. Equal views give equal bytes
[[nodiscard]] std::string makeViewSvg(const drawing::LineView& view, const volume::SemanticVolume& volume,
                                      double width);

/// \return the file, or NoCairo or CannotWrite
[[nodiscard]] Result<PdfFile> makeViewPdf(const drawing::LineView& view, const volume::SemanticVolume& volume,
                                          double width);

/// A section on the page of makeSvg(), with layers as in makePdfSheets().
/// \param scale  100 draws 1 m as 10 mm; 0.01 to 10^7
/// \param look   a field on the section
/// \return the file, or BadArgument: a scale out of range, or a page larger than the 5.08 m that PDF allows; NoCairo
///         or CannotWrite
[[nodiscard]] Result<PdfFile> makeSectionPdf(const drawing::SectionDrawing& drawing,
                                             const volume::SemanticVolume& volume, double scale,
                                             const FieldLook& look = {});

}  // namespace svt::writers
