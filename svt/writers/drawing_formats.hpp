#pragma once
/// \file
/// Section drawings in all formats: one call for the command, the page and Python.

#include <svt/core/result.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/writers/dxf_drawing.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace svt::writers {

struct DrawingOptions {
    double scale = 100;  ///< SVG and PDF: 100 draws 1 m as 10 mm; 0.01 to 10^7
    DxfOptions dxf{};
    FieldLook field{};  ///< for all formats with a drawing; replaces that of `dxf`
};

/// The drawing as text. `volume` is the volume from which the drawing was made. Equal drawings give equal bytes.
/// \param format  svg, dxf or geojson; csv or json give the table of its areas
/// \return the text, or BadArgument for another format, or a scale out of range
[[nodiscard]] Result<std::string> makeDrawing(const drawing::SectionDrawing& drawing,
                                              const volume::SemanticVolume& volume, std::string_view format,
                                              const DrawingOptions& options = {});

/// Writes the drawing as a file, all or nothing. The ending of the name selects the format: those of makeDrawing(), and
/// `.pdf`.
/// \return bytes written, or the errors of makeDrawing() and makeSectionPdf(), CannotWrite or DiskFull
[[nodiscard]] Result<std::uint64_t> writeDrawing(const drawing::SectionDrawing& drawing,
                                                 const volume::SemanticVolume& volume,
                                                 const std::filesystem::path& path, const DrawingOptions& options = {});

}  // namespace svt::writers
