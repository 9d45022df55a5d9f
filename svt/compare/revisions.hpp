#pragma once
/// \file
/// The changes between two states in drawings of the new one: for revision clouds, dashed lines of removed parts, and a
/// table of revisions.

#include <svt/compare/comparison.hpp>
#include <svt/drawing/section_drawing.hpp>

#include <span>
#include <vector>

namespace svt::compare {

/// Two volumes and their comparison, which markRevisions() draws.
struct RevisedStates {
    const volume::SemanticVolume &was, &is;
    const Comparison& comparison;
    double tolerance = 0.01;  ///< metres: lines within this distance are the same
};

/// Fills SectionDrawing::revisions. Lines of an object count as changed where its drawings of the two states have no common
/// line. Rows whose space is the same, or belongs to another object, do not count. Rooms, units, buildings and
/// surfaces are not marked where all of their lines lie at those of a changed component, since such a change is that of
/// the component.
/// \param before    drawings of the old state, by the planes and the options of `drawings`
/// \param drawings  of the new state; as many
/// \return the revisions: those that a drawing shows, numbered from 1 in the order of rows, then components that none shows
/// Cost: O(n m) for an object with n lines before and m after, about 100 ns each.
[[nodiscard]] std::vector<drawing::Revision> markRevisions(const RevisedStates& states,
                                                           std::span<const drawing::SectionDrawing> before,
                                                           std::span<drawing::SectionDrawing* const> drawings);

}  // namespace svt::compare
