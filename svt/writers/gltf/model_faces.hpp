#pragma once
/// \file
/// The triangles of the model that are drawn: those of the chosen labels, each face once.
///
///     building   +----+   its solid, and its roof and walls as sheets, have the same faces:
///     roof       +====+   those of the sheets are drawn

#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/surface_source.hpp>

#include <cstdint>
#include <vector>

namespace svt::writers {

enum class TriangleUse : std::uint8_t {
    None,    ///< of a label that has the surface of its voxels, or no voxels
    Drawn,   ///< part of the surface of its label
    Covered  ///< of a chosen label, but not drawn, see drawnTriangles()
};

/// Labels whose triangles are their surface, if they have any; 1 per label.
[[nodiscard]] std::vector<char> chosenLabels(const volume::LabelTable& labels, MeshChoice choice);

/// The use of each of the volume's triangles. Two kinds are covered, except with MeshChoice::All: a triangle that a
/// label below its own has, too (spaces keep theirs), and one that two closed parts of a building have in opposite directions.
/// Cost: O(n log n) for n triangles. Memory: 16 bytes per triangle.
[[nodiscard]] std::vector<TriangleUse> drawnTriangles(const volume::SemanticVolume& volume, MeshChoice choice);

}  // namespace svt::writers
