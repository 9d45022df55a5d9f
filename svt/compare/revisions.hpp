#pragma once
/// \file
/// The changes between two states in drawings of the new one: for revision clouds, dashed lines of removed parts, and a
/// table of revisions.

#include <svt/compare/compared.hpp>
#include <svt/drawing/section_drawing.hpp>

#include <span>
#include <vector>

namespace svt::compare {

/// Fills SectionDrawing::revisions. Lines within the tolerance of the comparison are the same. Lines of an object count as changed where its drawings of the two states have no common
/// line. Rows whose space is the same, or belongs to another object, do not count. Rooms, units, buildings and
/// surfaces are not marked where all of their lines lie at those of a changed component, since such a change is that of
/// the component.
/// \param before    drawings of the old state, by the planes and the options of `drawings`
/// \param drawings  of the new state; as many
/// \return the revisions: those that a drawing shows, numbered from 1 in the order of rows, then components that none shows
/// Cost: O(n m) for an object with n lines before and m after, about 100 ns each.
[[nodiscard]] std::vector<drawing::Revision> markRevisions(const Compared& states,
                                                           std::span<const drawing::SectionDrawing> before,
                                                           std::span<drawing::SectionDrawing* const> drawings);

}  // namespace svt::compare
