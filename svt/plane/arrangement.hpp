#pragma once
/// \file
/// Segments to edges that meet in their end points only: the ground for exact borders between all labels.
///
///     segments, each with a claim      edges between nodes (o)
///
///        +-----------+                    o-----------o
///        | A   +-----+---+                | A   o-----o---o       A and B overlap; the parts of their
///        |     | B   |   |        -->     |     |  AB | B |       common border lie on each other, exactly
///        +-----+-----+   |                o-----o-----o   |
///              +---------+                      o---------o
///
/// Points within the tolerance of each other become one node, and a segment that passes a node within half the tolerance
/// is led through it; crossings become nodes. This is repeated until nothing is left to do (iterated snap rounding: Hobby
/// 1999, Halperin and Packer 2002). Each closed ring of segments stays closed, so that counts of what encloses a place
/// stay consistent however points move.

#include <svt/plane/point.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace svt::plane {

/// A segment of the border of a claim.
struct ClaimSegment {
    Point from, to;
    std::uint32_t claim = 0;
    /// 1: the claim's inside is to the left; 0: a line without inside.
    std::int32_t winding = 1;
};

/// What an edge changes: the claim's winding number to its left is that to its right plus `winding`; 0: a line.
struct EdgeMark {
    std::uint32_t claim = 0;
    std::int32_t winding = 0;
};

struct ArrangementEdge {
    Point from, to;                            ///< from < to
    std::uint32_t firstMark = 0, endMark = 0;  ///< range of Arrangement::marks, by claim
};

struct Arrangement {
    std::vector<ArrangementEdge> edges;  ///< by from, then to; no two are equal
    std::vector<EdgeMark> marks;
};

/// Cuts `segments` where they meet. Where borders of one claim cancel, no edge remains.
/// \param segments   coordinates at most 2^29 from 0
/// \param tolerance  steps of the grid, >= 2: no point moves further in one step
/// \return the arrangement, or nothing where it was not done after 40 steps (points chase each other; not seen yet)
/// Cost: O(n log n) for segments that are spread over the plane.
[[nodiscard]] std::optional<Arrangement> arrangeSegments(std::span<const ClaimSegment> segments,
                                                         std::int32_t tolerance);

}  // namespace svt::plane
