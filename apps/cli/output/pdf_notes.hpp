#pragma once
/// \file
/// Notes on a PDF that the command writes.

#include <svt/writers/pdf_file.hpp>

namespace svt::cli {

/// Prints a note for each thing that the PDF cannot show: layers, letters without a font, and Arabic or Hebrew text in its
/// order. Each has a remedy.
void notePdf(const writers::PdfFile& pdf);

}  // namespace svt::cli
