#pragma once
/// \file
/// The places of values along lines, and the legend of a field, the same for SVG and PDF.

#include <svt/writers/field_look.hpp>

#include <string>
#include <vector>

namespace svt::writers {

/// A value on its line.
struct FieldLabel {
    drawing::PlanePoint at;
    double degrees = 0;  ///< of the line there, counter-clockwise, -90 to 90
    double size = 1.8;   ///< font size, millimetres
    std::string text;
};
/// Values along the lines: in the middle of each line that is long enough, and every 80 mm along longer ones. Labels do
/// not overlap each other.
/// \param millimetres  on paper per metre
[[nodiscard]] std::vector<FieldLabel> placeFieldLabels(const drawing::FieldDrawing& field, double millimetres);

/// The head of an arrow: three points around its end.
[[nodiscard]] std::vector<drawing::PlanePoint> arrowHead(const drawing::FieldArrow& arrow);

/// Millimetres on paper, from the upper left corner of the page.
struct FieldLegend {
    struct Box {
        double x, y, width, height;
        std::string color;  ///< "#rrggbb"
        bool hasOutline;
    };
    struct Text {
        double x, y, size;  ///< on the baseline
        std::string text;
        bool isCentred;
    };
    std::vector<Box> boxes;
    std::vector<Text> texts;
};
/// The title, a bar with round values, and the grey box of places without a value.
[[nodiscard]] FieldLegend makeFieldLegend(const FieldLook& look, double left, double top, double width);

/// "#rrggbb" of a band: the colour of its middle.
[[nodiscard]] std::string bandColor(const FieldLook& look, const drawing::FieldBand& band);
/// "#rrggbb" of places without a value.
[[nodiscard]] std::string noValueColor();
/// The nearest of AutoCAD's colours 10 to 255, by distance in sRGB: 24 hues in five shades, pure and pale, and six greys.
/// \param color  "#rrggbb"
[[nodiscard]] int autocadColor(const std::string& color);

}  // namespace svt::writers
