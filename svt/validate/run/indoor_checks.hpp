#pragma once
/// \file
/// The tests of cell spaces (IndoorGML) against each other and against the graph of states and transitions.

#include <svt/validate/run/geometry_checks.hpp>

#include <vector>

namespace svt::validate {

/// True for features that readers made from cell spaces.
[[nodiscard]] bool isCellSpace(const model::Feature& feature);

/// Tests that cell spaces of one layer do not overlap (701), that states lie in their cell spaces or on their surface
/// (702), and that cell spaces joined by a transition touch (704). Cell spaces of different layers may overlap; those
/// in no layer are in all of them. Links are tested by the reader (703).
/// \param cells  bodies of the cell spaces whose geometry is valid, in tree order; others are not tested
/// \return findings on cell spaces; `features` has those that have one
/// Cost: O(n log n) in the cells, plus pairs whose boxes meet.
[[nodiscard]] GroupReport checkCells(const model::BuildingModel& model, const Lattice& lattice,
                                     const ValidateOptions& options, const std::vector<SolidBodies>& cells);

}  // namespace svt::validate
