#pragma once
/// \file
/// Contacts of components, and the layers between rooms and outside: for energy and acoustic models, and for analyses
/// of the structure of a building.

#include <svt/volume/semantic_volume.hpp>

#include <string>

namespace svt::writers {

/// The graph as JSON:
///
///     nodes       outside, and each label with voxels: id, class, name, whether it is a space, material, m3.
///     contacts    a, b, m2; see analyze::findContacts().
///     boundaries  a, b, axis, m2, layers with their thickness in metres; see analyze::findSpaceBoundaries().
///
/// Nodes are referenced by their index in the list; 0 is outside.
/// Cost: that of both functions.
[[nodiscard]] std::string makeAdjacencyJson(const volume::SemanticVolume& volume, int threads = 0);

/// The same as GraphML: an undirected edge per contact and per boundary; the layers of a boundary as text
/// "id:0.24|id:0.015".
[[nodiscard]] std::string makeGraphMl(const volume::SemanticVolume& volume, int threads = 0);

}  // namespace svt::writers
