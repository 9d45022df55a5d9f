#pragma once
/// \file
/// A section drawing as DXF (ASCII, version 2000), in metres. Coordinates are those of the drawing's plane (u of its
/// axes is x, v is y) or of the world.
///
/// Layers are named by IFC type, otherwise by class and function, or according to ISO 13567-2. Each ring, including
/// holes, is a closed LWPOLYLINE, and a HATCH fills them. Room names are TEXT entities, doors are blocks, dimensions
/// are DIMENSION entities with blocks. Comments (group 999) at the start contain the transform back to the model's CRS,
/// and with ISO layers the source of external walls.
/// Text is in the code page named in the header, 1252; other characters are written as \U+XXXX. Version 2000 is the
/// oldest that states its unit, and all programs read it.

#include <svt/drawing/external_parts.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/record/members.hpp>
#include <svt/writers/field_look.hpp>

#include <string>
#include <vector>

namespace svt::writers {

struct DxfOptions {
    bool isoLayers = false;  ///< names of layers according to ISO 13567-2: `A-21----E-`
    /// Coordinates of the model's CRS. Vertical drawings then stand in space. Only plans keep their dimensions.
    bool world = false;
    /// External walls and doors for ISO layers, for several drawings of a volume; null: they are found.
    const std::vector<drawing::ExternalPart>* externals = nullptr;
    /// A field: lines and their values on layers FIELD_LINES and FIELD_TEXT, each band as solid hatches on a layer of its
    /// own in the nearest of AutoCAD's 255 colours, and a legend beside the drawing.
    FieldLook field{};
};

/// The options that a user can set.
record::Members<DxfOptions> membersOf(const DxfOptions*) noexcept;

/// The drawing as DXF text. `volume` is the volume from which the drawing was made. Equal drawings give equal bytes.
[[nodiscard]] std::string makeDxf(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                  const DxfOptions& options = {});

}  // namespace svt::writers
