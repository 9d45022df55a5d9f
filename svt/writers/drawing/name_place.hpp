#pragma once
/// \file
/// Where the name of a room stands in a drawing: within its largest polygon, and beside lines where there is room.

#include <svt/drawing/section_drawing.hpp>

#include <optional>

namespace svt::writers {

struct NamePlace {
    drawing::PlanePoint center;
    double size = 2.5;  ///< font size, millimetres on paper
};

/// \param millimetres  on paper per metre
/// \param width        of the widest line of the text at font size 1, millimetres
/// \param lines        height of the text in font sizes
/// \return the place, or nothing where the text would be smaller than 1.2 mm
/// Cost: O(lines beyond the cut + points), 400 places tried at most.
[[nodiscard]] std::optional<NamePlace> placeName(const drawing::SectionComponent& component,
                                                 const drawing::SectionDrawing& drawing, double millimetres,
                                                 double width, double lines);

}  // namespace svt::writers
