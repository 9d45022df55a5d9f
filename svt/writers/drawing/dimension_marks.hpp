#pragma once
/// \file
/// Marks of chains of dimensions: lines, ticks and numbers on paper. Numbers do not overlap.

#include <svt/drawing/section_drawing.hpp>

#include <string>
#include <utility>
#include <vector>

namespace svt::writers {

/// Millimetres on paper from the drawing's zero, y upwards.
struct MarkLine {
    drawing::PlanePoint from, to;
};
struct MarkText {
    drawing::PlanePoint at;  ///< centre of the baseline
    double size = 2;         ///< font size, millimetres
    std::string text;        ///< UTF-8
    bool isUpright = false;  ///< read from the right
};

/// One dimension of a chain.
struct DimensionMark {
    MarkLine line;                ///< from stop to stop
    std::vector<MarkLine> feet;   ///< across its ends
    std::vector<MarkLine> ticks;  ///< oblique, wide
    MarkText text;                ///< empty if there is no space for it
    double metres = 0;
};

struct DimensionMarks {
    std::vector<DimensionMark> marks;
    std::size_t withoutPlace = 0;  ///< number of omitted texts
};

/// Distance that chains extend beyond the drawing on a side, millimetres; 0: no chains.
[[nodiscard]] double dimensionReach(const drawing::SectionDrawing& drawing, drawing::DimensionSide side) noexcept;

/// Places the chains around `box`, the result of drawnBox().
/// \param millimetres  on paper per metre
[[nodiscard]] DimensionMarks placeDimensions(const drawing::SectionDrawing& drawing,
                                             const std::pair<drawing::PlanePoint, drawing::PlanePoint>& box,
                                             double millimetres);

/// A length as architects write it (DIN 1356-1): metres with two decimals from 1 m, otherwise centimetres; millimetres
/// are superscripts: "3.26", "3.26⁵", "36⁵", "24".
[[nodiscard]] std::string dimensionText(double metres);

}  // namespace svt::writers
