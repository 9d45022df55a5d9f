#pragma once
/// \file
/// The views of a report about a unit: plan and section with the unit lit, and the unit in the lines of its building.

#include <svt/analyze/legal_spaces.hpp>
#include <svt/drawing/line_view.hpp>
#include <svt/writers/canvas/sheet_canvas.hpp>

#include <cstdint>
#include <vector>

namespace svt::writers {

/// A part of the paper, millimetres from its upper left corner.
struct PaperBox {
    double left = 0, top = 0, right = 0, bottom = 0;
};

class ReportViews {
public:
    /// Cuts the volume 1.1 m above the lowest point of the unit, and upright through its middle.
    /// \return the views, or an error of drawSection()
    [[nodiscard]] static Result<ReportViews> make(const analyze::LegalSpaces& spaces, std::uint32_t space,
                                                  const volume::SemanticVolume& volume, int threads);

    void paintPlan(const PaperBox& box, SheetCanvas& canvas) const { paint(plan_, "Plan", box, canvas); }
    void paintSection(const PaperBox& box, SheetCanvas& canvas) const { paint(section_, "Section", box, canvas); }

private:
    explicit ReportViews(const volume::SemanticVolume& volume) : volume_(volume) {}
    void paint(const drawing::SectionDrawing& drawing, const char* title, const PaperBox& box,
               SheetCanvas& canvas) const;

    const volume::SemanticVolume& volume_;
    std::vector<std::uint32_t> extent_;  // of the unit, ascending
    drawing::SectionDrawing plan_, section_;
};

/// Paints the faces of a unit that look at the camera, in front of them the lines of the building.
/// \param view  of a parallel camera
void paintUnitInLines(const analyze::LegalSpaces& spaces, std::uint32_t space, const drawing::LineView& view,
                      const PaperBox& box, SheetCanvas& canvas);

}  // namespace svt::writers
