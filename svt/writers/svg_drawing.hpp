#pragma once
/// \file
/// Writes a section drawing as SVG to scale, in millimetres on paper: construction hatches (as in ISO 128-3 and
/// DIN 1356-1), bold outlines of cut parts, names and areas of rooms in plans, scale bar and title.
///
///     <g class="WallSurface">                          one group per class.
///       <path class="WallSurface" data-id="wall-1" data-area="1.23" d="..."><title>wall-1: Outer wall</title></path>
///     </g>
///     <g class="field">                                bands and lines of a field, if there is one, with their values.
///     <g class="thin">, <g class="bold">               lines between components, each once.
///     <g class="names">                                rooms.
///     <g class="title">                                model, plane, scale, scale bar.

#include <svt/core/result.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/writers/field_look.hpp>

#include <string>

namespace svt::writers {

struct SvgOptions {
    double scale = 100;  ///< 100 draws 1 m as 10 mm; 0.01 to 10^7
    FieldLook field{};   ///< drawn over the cut components
};

/// The drawing as SVG text. `volume` is the volume from which the drawing was made. Equal drawings give equal bytes.
/// \return the text, or BadArgument if the scale is out of range
[[nodiscard]] Result<std::string> makeSvg(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                          const SvgOptions& options = {});

}  // namespace svt::writers
