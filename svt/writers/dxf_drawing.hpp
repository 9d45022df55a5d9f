#pragma once
/// \file
/// A section drawing as DXF (ASCII, version 2000), in metres of the drawing's plane: x is the frame's u, y its v.
///
/// One layer per class, named as the class, and one for names, TEXT. Each ring is a closed LWPOLYLINE, holes too; room
/// names are TEXT. The frame that leads back to the model's CRS stands in comments (group 999) at the top. Texts are in
/// the code page that the header names, 1252; characters beyond it are written as \U+XXXX. Version 2000 is the oldest
/// one that names its unit, and what all programs read.

#include <svt/core/result.hpp>
#include <svt/illustrate/section_drawing.hpp>

#include <cstdint>
#include <filesystem>
#include <string>

namespace svt::writers {

/// The drawing as DXF text. `volume` is what the drawing was made from. Equal drawings give equal bytes.
[[nodiscard]] std::string dxfOf(const illustrate::SectionDrawing& drawing, const volume::SemanticVolume& volume);

/// The same as a file, all or nothing. \return bytes written, or CannotWrite or DiskFull
[[nodiscard]] Result<std::uint64_t> writeDxf(const illustrate::SectionDrawing& drawing,
                                             const volume::SemanticVolume& volume, const std::filesystem::path& path);

}  // namespace svt::writers
