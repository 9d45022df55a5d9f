#pragma once
/// \file
/// Lines and triangles of meshes, by label, stored alongside the voxels.

#include <svt/core/result.hpp>
#include <svt/mesh/mesh_set.hpp>
#include <svt/volume/grid.hpp>
#include <svt/volume/vector_parts.hpp>

#include <cstdint>
#include <span>

namespace svt::pipeline {

/// The parts to store.
struct VectorChoice {
    bool edges = false;      ///< feature edges, see mesh::findFeatureEdges()
    bool meshes = false;     ///< all triangles
    bool isRequired = true;  ///< false: nothing is stored if points are too far away
    [[nodiscard]] bool isNone() const noexcept { return !edges && !meshes; }
};

/// Lines of a model, each with its label. Lines with one point are ignored.
struct LabelledLines {
    std::span<const model::Polyline> lines;
    std::span<const std::uint32_t> labels;  ///< per line
};

/// \param labelOfObject  per meshes.objects
/// \param lines          stored together with edges
/// \return the parts, in label order, or GridTooLarge if a point is over 200 km from the grid's origin
/// Cost: that of the feature edges, parallel. The result does not depend on `threads`.
[[nodiscard]] Result<volume::VectorParts> makeVectorParts(const mesh::MeshSet& meshes,
                                                          std::span<const std::uint32_t> labelOfObject,
                                                          const volume::Grid& grid, VectorChoice choice,
                                                          LabelledLines lines = {}, int threads = 0);

}  // namespace svt::pipeline
