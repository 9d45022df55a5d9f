#pragma once
/// \file
/// Sheets as one PDF, by the cairo library. Two sources: one that calls it, one for builds without it.

#include <svt/core/result.hpp>
#include <svt/writers/sheets/sheet_canvas.hpp>

#include <memory>

namespace svt::writers {

/// A PDF in memory: a page for each sheet, with text as text in DejaVu Sans, which is embedded.
class PdfCanvas : public SheetCanvas {
public:
    /// The bytes of the file; nothing may be drawn any more. Equal sheets give equal bytes with one release of cairo.
    /// \return the bytes, or CannotWrite with what cairo says
    [[nodiscard]] virtual Result<std::string> finish() = 0;
};

/// \param title   of the document, for its properties
/// \return the canvas, or NoCairo: a build without cairo, or the library is not installed
[[nodiscard]] Result<std::unique_ptr<PdfCanvas>> makePdfCanvas(const std::string& title);

}  // namespace svt::writers
