#pragma once
/// \file
/// A section drawing as DXF (ASCII, version 2000), in metres of the drawing's plane (u of its axes is x, v is y) or of the
/// world.
///
/// Layers by IFC type, else class and function, or after ISO 13567-2. Each ring is a closed LWPOLYLINE, including holes, and
/// a HATCH fills them; room names are TEXT entities, doors blocks, dimensions DIMENSION entities with blocks. The transform back
/// to the model's CRS is given in comments (group 999) at the start. Text is in the code page named in the header,
/// 1252; other characters are written as \U+XXXX. Version 2000 is the oldest that states its unit, and all programs
/// read it.

#include <svt/drawing/section_drawing.hpp>
#include <svt/record/members.hpp>

#include <string>

namespace svt::writers {

struct DxfOptions {
    bool isoLayers = false;  ///< names of layers after ISO 13567-2: `A-21----E-`
    /// Coordinates of the model's CRS, also of upright drawings, which then stand in space. Dimensions are left in plans alone.
    bool world = false;
};

/// The options that a user can set.
record::Members<DxfOptions> membersOf(const DxfOptions*) noexcept;

/// The drawing as DXF text. `volume` is the volume the drawing was made from. Equal drawings give equal bytes.
[[nodiscard]] std::string makeDxf(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                  const DxfOptions& options = {});

}  // namespace svt::writers
