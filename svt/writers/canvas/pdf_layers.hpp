#pragma once
/// \file
/// Layers of a PDF (optional content). Cairo does not support layers, so each part of a sheet is drawn onto a page of
/// its own. Then qpdf merges the pages of a sheet into one page, each in its layer.
///
///     pages of cairo    Cut | Outlines | Names | Frame | Cut | Frame        pages of the file    sheet 1 | sheet 2
///                       `------ sheet 1 ------------´   `- sheet 2 -´

#include <svt/core/result.hpp>

#include <span>
#include <string>

namespace svt::writers {

/// The content of a page of cairo.
struct PdfPart {
    bool beginsSheet = false;
    std::string layer{};  ///< empty: always visible
};

/// Merges the pages of each sheet into one page. Layers with the same name become one, initially visible, in the order
/// of first use. Text, fonts, outline and properties are kept; equal files give equal bytes with one release of qpdf.
/// \param parts  one per page of `pdf`; the first begins a sheet
/// \return the bytes, or CannotWrite with missingPdfLayers() or the message of qpdf
[[nodiscard]] Result<std::string> joinPdfLayers(const std::string& pdf, std::span<const PdfPart> parts);

}  // namespace svt::writers
