#pragma once
/// \file
/// Marks of changes in a drawing: clouds around them, triangles with their numbers, and lines of removed parts.

#include <svt/drawing/section_drawing.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace svt::writers {

/// A rectangle on paper that the numbers of revisions keep clear, such as that of a text.
struct RevisionObstacle {
    drawing::PlanePoint low, high;
};

/// Everything in millimetres on paper from the drawing's zero, y upwards.
struct RevisionMarks {
    using Path = std::vector<drawing::PlanePoint>;
    /// Sagitta of the arcs per half of their chord: the bulge of DXF.
    static constexpr double kBulge = 0.6;

    /// A cloud: the ends of its arcs, counter-clockwise, the first not repeated. Arcs bulge outwards, see cloudPath().
    struct Cloud {
        Path ends;
        std::vector<std::uint32_t> numbers;  ///< of its revisions, ascending
    };
    /// A triangle with the number of a revision.
    struct Tag {
        std::array<drawing::PlanePoint, 3> corners;
        drawing::PlanePoint at;  ///< middle of the baseline of the number
        double size = 2.2;       ///< font size
        std::string text;
    };
    std::vector<drawing::RevisionLines::Line> removed;  ///< dashed
    std::vector<Cloud> clouds;                          ///< they do not overlap
    std::vector<Tag> tags;
};

/// The marks of SectionDrawing::revisions. Changes that are close together share a cloud, which is 4 mm away from their
/// lines. Chords are about 6 mm. Each number has a triangle beside its cloud, where it covers the fewest lines.
/// Cost: O(area of the changes on paper / 0.25 mm2 + length of lines).
/// \param millimetres  on paper per metre
/// \param taken        texts and dimensions
[[nodiscard]] RevisionMarks placeRevisions(const drawing::SectionDrawing& drawing, double millimetres,
                                           std::span<const RevisionObstacle> taken = {});

/// The arcs of a cloud as chords, eight per arc; closed, the first point repeated.
[[nodiscard]] RevisionMarks::Path cloudPath(const RevisionMarks::Cloud& cloud);

}  // namespace svt::writers
