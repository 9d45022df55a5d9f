#pragma once
/// \file
/// The parts of lines that a drawing has and another one lacks.

#include <svt/drawing/section_drawing.hpp>

#include <span>
#include <vector>

namespace svt::compare {

using Line = drawing::RevisionLines::Line;

/// The parts of `line` that are farther than `tolerance` from every line of `others` with its direction. Parts that are
/// shorter than the tolerance are dropped.
void addMissingParts(const Line& line, std::span<const Line> others, double tolerance, std::vector<Line>& parts);

}  // namespace svt::compare
