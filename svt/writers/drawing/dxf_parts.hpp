#pragma once
/// \file
/// Names of layers and patterns of hatches in DXF drawings.

#include <svt/drawing/hatches.hpp>
#include <svt/volume/label_table.hpp>

#include <span>
#include <string>
#include <string_view>

namespace svt::writers {

/// One family of parallel lines of a hatch, metres in the drawing at a scale of 1:100.
struct DxfHatchLine {
    double degrees;
    double x, y;       ///< a point of one of the lines
    double distance;   ///< between lines
    double dash, gap;  ///< 0: continuous
};
struct DxfHatch {
    render::Hatch hatch;
    const char* name;
    std::span<const DxfHatchLine> lines;
};
/// The pattern for a hatch; nullptr for none.
[[nodiscard]] const DxfHatch* dxfHatchOf(render::Hatch hatch) noexcept;

/// The content of a layer, as in the names of ISO 13567-2: the field "presentation".
enum class DxfContent : char { Element = 'E', Hatch = 'H', Text = 'T', Dimension = 'D' };

/// The layer of a component: its `ifcType`, otherwise its class, with its function if that is a word: `IfcWall`,
/// `BuildingConstructiveElement_wall`, `Door`.
[[nodiscard]] std::string dxfLayerOf(const volume::Label& label);

/// The layer of a component according to ISO 13567-2, ten characters: agent `A-`, element by the table of CI/SfB
/// (`21----` external walls), presentation (`E-`).
/// \param isExternal  of walls and doors, see drawing::findExternalParts()
/// \param field  the user-defined field, eight characters behind the empty optional fields: lines beyond the cut
[[nodiscard]] std::string isoLayerOf(const volume::Label& label, bool isExternal, DxfContent content,
                                     std::string_view field = {});
/// The same for content that does not belong to a component: texts, dimensions.
[[nodiscard]] std::string isoLayerOf(DxfContent content);

}  // namespace svt::writers
