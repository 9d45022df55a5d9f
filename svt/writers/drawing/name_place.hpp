#pragma once
/// \file
/// The place of the name of a room in a drawing: within its largest polygon, and away from lines if possible.

#include <svt/drawing/section_drawing.hpp>

#include <optional>

namespace svt::writers {

struct NamePlace {
    drawing::PlanePoint center;
    double size = 2.5;  ///< font size, millimetres on paper
};

/// \param millimetres  on paper per metre
/// \param width        width of the widest line of the text at font size 1, millimetres
/// \param lines        height of the text in font sizes
/// \return the place, or nothing if the text would be smaller than 1.2 mm
/// Cost: O(lines beyond the cut + points); up to 400 places are tried.
[[nodiscard]] std::optional<NamePlace> placeName(const drawing::SectionComponent& component,
                                                 const drawing::SectionDrawing& drawing, double millimetres,
                                                 double width, double lines);

}  // namespace svt::writers
