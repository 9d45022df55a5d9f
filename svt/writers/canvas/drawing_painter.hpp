#pragma once
/// \file
/// Paints a section drawing onto a sheet: hatched parts, lines beyond, outlines, names of rooms.

#include <svt/writers/canvas/mark_shapes.hpp>
#include <svt/writers/canvas/sheet_canvas.hpp>
#include <svt/writers/field_look.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace svt::writers {

/// The place of a drawing on its sheet.
struct DrawingPlace {
    PaperPoint corner;        ///< position of the drawing's lower left corner
    drawing::PlanePoint low;  ///< that corner, in the drawing
    double millimetres = 10;  ///< millimetres on paper per metre

    [[nodiscard]] PaperPoint onPaper(drawing::PlanePoint p) const noexcept {
        return {corner.x + (p.u - low.u) * millimetres, corner.y - (p.v - low.v) * millimetres};
    }
};

/// A further line below the name and the area of a room, by label.
using RoomNotes = std::map<std::uint32_t, std::string>;

/// Widths of lines of ISO 128-2, millimetres.
struct LineWidths {
    double bold = 0.5;     ///< outlines of cut parts
    double leaf = 0.25;    ///< doors, and the medium lines of marks
    double beyond = 0.18;  ///< lines beyond the cut
    double thin = 0.13;    ///< other outlines, dimensions
};

struct PaintOptions {
    RoomNotes notes{};                               ///< a note is left out if it does not fit into its room
    const std::vector<MarkShapes>* marks = nullptr;  ///< instead of the names of rooms, one layer each
    LineWidths widths{};
    OpeningWords openings{};  ///< letters before the heights of openings
    FieldLook field{};        ///< over the cut components, without a legend
};

void paintDrawing(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                  const DrawingPlace& place, SheetCanvas& canvas, const PaintOptions& options = {});

}  // namespace svt::writers
