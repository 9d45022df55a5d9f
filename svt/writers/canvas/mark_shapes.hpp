#pragma once
/// \file
/// Marks on a drawing, such as stamps of rooms: lines, fills and texts in one layer.

#include <svt/writers/drawing/dimension_marks.hpp>

#include <string>
#include <vector>

namespace svt::writers {

/// Millimetres on paper from the drawing's zero, y upwards.
using MarkPath = std::vector<drawing::PlanePoint>;

struct MarkShapes {
    std::string layer;
    std::vector<MarkPath> masks;  ///< closed; white, over the drawing and below the rest
    std::vector<MarkPath> thin, medium, bold;
    std::vector<MarkPath> axes;    ///< thin, long dashes and dots
    std::vector<MarkPath> filled;  ///< closed; black
    std::vector<MarkText> texts;
};

/// A rectangle on paper, millimetres.
struct MarkBox {
    drawing::PlanePoint low, high;
};

}  // namespace svt::writers
