#pragma once
/// \file
/// Sheets as one PDF, with the cairo library. Two source files: one calls it, the other is for builds without it.

#include <svt/core/result.hpp>
#include <svt/writers/canvas/sheet_canvas.hpp>

#include <memory>

namespace svt::writers {

/// A PDF in memory: one page per sheet, with text as text in DejaVu Sans, which is embedded.
class PdfCanvas : public SheetCanvas {
public:
    /// The bytes of the file; drawing is not possible afterwards. Equal sheets give equal bytes with one release of
    /// cairo.
    /// \return the bytes, or CannotWrite with the message of cairo
    [[nodiscard]] virtual Result<std::string> finish() = 0;
};

/// \param title   title of the document, for its properties
/// \return the canvas, or NoCairo for a build without cairo, or if the library is not installed
[[nodiscard]] Result<std::unique_ptr<PdfCanvas>> makePdfCanvas(const std::string& title);

}  // namespace svt::writers
