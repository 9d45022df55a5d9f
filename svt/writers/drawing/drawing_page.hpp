#pragma once
/// \file
/// The page of a single section drawing: the drawing with its dimensions, margins, and a title below it.

#include <svt/core/result.hpp>
#include <svt/drawing/field_drawing.hpp>
#include <svt/drawing/section_drawing.hpp>

#include <cstddef>
#include <vector>

namespace svt::writers {

/// Millimetres on paper, from the upper left corner.
struct DrawingPage {
    static constexpr double kMargin = 10, kTitleHeight = 24, kLegendHeight = 14;
    drawing::PlanePoint low, high;         ///< corners of the drawn area, in the drawing
    double scale = 100, millimetres = 10;  ///< 100 draws 1 m as 10 mm; millimetres on paper per metre
    double width = 0, height = 0;          ///< of the page
    double left = 0, top = 0;              ///< of the drawing without dimensions
    /// Fields of the scale bar: four of a rounded length, 5 to 12.5 mm each.
    double field = 1;  ///< metres
    [[nodiscard]] double titleTop() const noexcept { return height - kTitleHeight - 2; }
    /// Upper edge of the legend of a field, after addField().
    [[nodiscard]] double legendTop() const noexcept { return titleTop() - kLegendHeight; }
    static constexpr std::size_t kMostRevisions = 60;  ///< rows of the list of revisions
    double revisionsHeight = 0;                        ///< of this list above the title; 0: none
    [[nodiscard]] double revisionsTop() const noexcept { return titleTop() - revisionsHeight; }
};

/// \return the page, or BadArgument: a scale out of 1:0.01 to 1:10000000
[[nodiscard]] Result<DrawingPage> makeDrawingPage(const drawing::SectionDrawing& drawing, double scale);

/// The revisions of a drawing, for makeRevisionList().
[[nodiscard]] std::vector<drawing::Revision> revisionsOf(const drawing::SectionDrawing& drawing);

/// Widens a page by the parts of a field beyond the section, and by its legend above the title.
void addField(const drawing::FieldDrawing& field, DrawingPage& page);

}  // namespace svt::writers
