#pragma once
/// \file
/// Sheets as one PDF, with the cairo library. Two source files: one calls it, the other is for builds without it.

#include <svt/core/result.hpp>
#include <svt/volume/label_table.hpp>
#include <svt/writers/canvas/sheet_canvas.hpp>
#include <svt/writers/pdf_file.hpp>

#include <memory>

namespace svt::writers {

/// A PDF in memory: one page per sheet, with text as text. Its letters are those of DejaVu Sans; letters that it lacks are
/// those of fonts of the machine. All are embedded as subsets.
class PdfCanvas : public SheetCanvas {
public:
    /// The file; drawing is not possible afterwards. Equal sheets give equal bytes with one release of cairo and the same
    /// fonts.
    /// \return the file, or CannotWrite with the message of cairo
    [[nodiscard]] virtual Result<PdfFile> finish() = 0;
};

/// \param title   title of the document, for its properties
/// \param names   names that show whether Chinese characters take their Japanese or Korean forms; null: Chinese forms
/// \return the canvas, or NoCairo for a build without cairo, or if the library is not installed
[[nodiscard]] Result<std::unique_ptr<PdfCanvas>> makePdfCanvas(const std::string& title,
                                                               const volume::LabelTable* names = nullptr);

}  // namespace svt::writers
