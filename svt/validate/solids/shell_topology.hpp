#pragma once
/// \file
/// The tests of a shell that depend only on shared points and edges, not on coordinates.

#include <svt/validate/solids/shell.hpp>

namespace svt::validate {

/// Edges used by more than two faces or twice in one direction, points with more than one umbrella (303, 307).
void checkManifold(const Shell& shell, const PointSet& points, const ShellRules& rules, std::vector<Defect>& defects);
/// Faces that are not connected by edges (305).
void checkOnePiece(const Shell& shell, const PointSet& points, std::vector<Defect>& defects);
/// Edges used by one face only (302).
void checkClosed(const Shell& shell, const PointSet& points, std::vector<Defect>& defects);

}  // namespace svt::validate
