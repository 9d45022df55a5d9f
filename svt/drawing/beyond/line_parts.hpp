#pragma once
/// \file
/// Parts of a line by the parameter along it, 0 at its beginning and 1 at its end: unions and differences.

#include <algorithm>
#include <vector>

namespace svt::drawing {

/// Shorter pieces of lines are omitted, metres.
inline constexpr double kShortestPiece = 5e-4;

/// A part of a line.
struct LinePart {
    double from = 0, to = 1;
};

/// The condition value(t) >= 0 for a value that is linear along a line.
/// \return false if nothing of `part` is left
[[nodiscard]] inline bool clipPart(LinePart& part, double atBegin, double change) noexcept {
    const double atFrom = atBegin + change * part.from, atTo = atBegin + change * part.to;
    if (atFrom < 0 && atTo < 0) return false;
    if (atFrom < 0) part.from = std::min(part.to, -atBegin / change);
    if (atTo < 0) part.to = std::max(part.from, -atBegin / change);
    return true;
}

/// The parts of `part` that `covered` does not cover. They, and the gaps between them, are at least `least` long. Sorts
/// `covered`.
[[nodiscard]] inline std::vector<LinePart> partsLeft(LinePart part, std::vector<LinePart>& covered, double least) {
    std::sort(covered.begin(), covered.end(), [](LinePart a, LinePart b) { return a.from < b.from; });
    std::vector<LinePart> left;
    double from = part.from;
    for (const LinePart& c : covered) {
        if (c.to - c.from < least && c.from > part.from && c.to < part.to) continue;
        if (c.from - from >= least) left.push_back({from, std::min(c.from, part.to)});
        from = std::max(from, c.to);
        if (from >= part.to) break;
    }
    if (part.to - from >= least) left.push_back({from, part.to});
    return left;
}

}  // namespace svt::drawing
