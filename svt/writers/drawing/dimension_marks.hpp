#pragma once
/// \file
/// Marks of dimensions: lines, ticks and numbers on paper. Numbers do not overlap. A number that is wider than its part
/// stands beside the chain, with a leader.

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

/// One dimension of a chain, or of a room.
struct DimensionMark {
    MarkLine line;                ///< from stop to stop
    std::vector<MarkLine> feet;   ///< thin: across its ends, and the leader to a text beside the chain
    std::vector<MarkLine> ticks;  ///< oblique, wide
    MarkText text;
    double metres = 0;
};

struct DimensionMarks {
    std::vector<DimensionMark> marks;  ///< of chains, in their order, then of rooms
    std::vector<MarkText> heights;     ///< sills and heads of openings
    std::size_t withoutPlace = 0;      ///< number of dimensions of rooms and heights that are omitted: too small
};

/// The letters before the heights of an opening.
struct OpeningWords {
    std::string sill = "SH", head = "HH";
};

/// Whether there are chains, dimensions of rooms, or heights of openings.
[[nodiscard]] inline bool hasDimensions(const drawing::SectionDrawing& drawing) noexcept {
    return !drawing.dimensions.empty() || !drawing.roomDimensions.empty() || !drawing.openings.empty();
}

/// Distance that chains extend beyond the drawing on a side, millimetres; 0: no chains.
[[nodiscard]] double dimensionReach(const drawing::SectionDrawing& drawing, drawing::DimensionSide side) noexcept;

/// Places the chains around `box`, the result of drawnBox(). Every number of a chain finds a place. Dimensions of rooms
/// that are narrower than 18 mm are omitted, as are heights that would cover others. Scales below 1:100 have only
/// chains.
/// \param millimetres  on paper per metre
[[nodiscard]] DimensionMarks placeDimensions(const drawing::SectionDrawing& drawing,
                                             const std::pair<drawing::PlanePoint, drawing::PlanePoint>& box,
                                             double millimetres, const OpeningWords& words = {});

/// A length as architects write it.
///
///     m-cm    "3.26", "3.26⁵", "36⁵", "24": metres with two decimals from 1 m, otherwise centimetres;
///             millimetres are superscripts (DIN 1356-1)
///     mm      "3265", "365"
///     cm      "326.5", "24"
///     m       "3.26⁵", "0.24"
///     ft-in   "10'-8 1/2\"", "9 7/16\"": to the sixteenth of an inch
[[nodiscard]] std::string dimensionText(double metres,
                                        drawing::DimensionUnit unit = drawing::DimensionUnit::MetresCentimetres);

}  // namespace svt::writers
