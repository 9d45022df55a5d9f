#pragma once
/// \file
/// What touches what, and what lies between rooms and outside: for energy and acoustic models, and for questions about
/// how a building hangs together.

#include <svt/volume/semantic_volume.hpp>

#include <string>

namespace svt::writers {

/// JSON: "nodes" (outside, and each label with voxels: id, class, name, whether a space, material, m3), "contacts" (a, b,
/// m2; see analyze::findContacts()), "boundaries" (a, b, axis, m2, layers with their thickness in metres; see
/// analyze::findSpaceBoundaries()). Nodes are told by their place in the list; 0 is outside.
/// Cost: that of the two.
[[nodiscard]] std::string makeAdjacencyJson(const volume::SemanticVolume& volume, int threads = 0);

/// The same as GraphML: an undirected edge for each contact and each boundary; the layers of a boundary as text
/// "id:0.24|id:0.015".
[[nodiscard]] std::string makeGraphMl(const volume::SemanticVolume& volume, int threads = 0);

}  // namespace svt::writers
