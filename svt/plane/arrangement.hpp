#pragma once
/// \file
/// Cuts segments into edges that meet only in their end points: the basis of exact borders between all labels.
///
///     segments, each with a claim      edges between nodes (o)
///
///        +-----------+                    o-----------o
///        | A   +-----+---+                | A   o-----o---o       A and B overlap; the common parts of
///        |     | B   |   |        -->     |     |  AB | B |       their borders coincide exactly
///        +-----+-----+   |                o-----o-----o   |
///              +---------+                      o---------o
///
/// Points within the tolerance of each other become one node. A segment that passes a node within half the tolerance is
/// routed through it, and crossings become nodes. These steps are repeated until nothing changes (iterated snap
/// rounding: Hobby 1999, Halperin and Packer 2002). Each closed ring of segments stays closed, so winding numbers stay
/// consistent however points move.

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
    /// 1: the inside of the claim is to the left; 0: a line without inside.
    std::int32_t winding = 1;
};

/// The change of a claim's winding number at an edge: to its left, the number is that to its right plus `winding`; 0: a
/// line.
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
/// \param tolerance  in units of the grid, >= 2: no point moves further in one round
/// \return the arrangement, or nothing if 40 rounds and 20 million pieces of segments, all rounds together, do not
///         suffice (not observed)
/// Cost: O(n log n) for segments that are spread over the plane, in a few rounds. Long segments that cross at a very
///       small angle take more: a crossing moves them by up to the tolerance, so that they cross again further on.
[[nodiscard]] std::optional<Arrangement> arrangeSegments(std::span<const ClaimSegment> segments,
                                                         std::int32_t tolerance);

}  // namespace svt::plane
