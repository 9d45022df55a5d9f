#pragma once
/// \file
/// Layers of a PDF (optional content): cairo has none, so each part of a sheet is drawn onto a page of its own, and qpdf
/// puts the pages of a sheet onto one again, each in its layer.
///
///     pages of cairo    Cut | Outlines | Names | Frame | Cut | Frame        pages of the file    sheet 1 | sheet 2
///                       `------ sheet 1 ------------´   `- sheet 2 -´

#include <svt/core/result.hpp>

#include <span>
#include <string>

namespace svt::writers {

/// What a page of cairo shows.
struct PdfPart {
    bool beginsSheet = false;
    std::string layer{};  ///< empty: always seen
};

/// Makes one page of the pages of each sheet. Layers of the same name are one, seen at first, in the order in which they
/// are met. Text, fonts, outline and properties stay; equal files give equal bytes with one release of qpdf.
/// \param parts  one for each page of `pdf`; the first begins a sheet
/// \return the bytes, or CannotWrite: missingPdfLayers(), or what qpdf says
[[nodiscard]] Result<std::string> joinPdfLayers(const std::string& pdf, std::span<const PdfPart> parts);

}  // namespace svt::writers
