#pragma once
/// \file
/// A field on a section drawing, as the writers show it: bands by a colour map, lines with their values, a legend.

#include <svt/drawing/field_drawing.hpp>
#include <svt/image/color_map.hpp>

namespace svt::writers {

struct FieldLook {
    const drawing::FieldDrawing* field = nullptr;  ///< of the drawing; null: none. Must outlive the call
    image::ColorMap map = image::ColorMap::Viridis;
};

}  // namespace svt::writers
