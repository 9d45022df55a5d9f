#pragma once
/// \file
/// Finds the objects of two volumes that are the same one.

#include <svt/analyze/common_spaces.hpp>
#include <svt/compare/comparison.hpp>
#include <svt/compare/match/voxel_overlaps.hpp>
#include <svt/compare/shape/shapes.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::compare {

/// Indices of shapes that belong together. One old and one new: a pair; none: added or removed; several: merged, split.
struct Match {
    std::vector<std::uint32_t> was, is;
};

struct Sides {
    const volume::SemanticVolume &was, &is;
    std::span<const Shape> wasShapes, isShapes;
};

/// Matches the shapes of both sides; each is in one match. In this order, among those not yet matched:
/// 1. shapes at one place, the pair with the same id, class and name first
/// 2. splits and merges: parts that lie in the whole, and fill it; with ids, no part whose id and class go on elsewhere
/// 3. ids
/// 4. most common space per united space
/// 5. closed meshes with a name that no other open shape has, whose boxes share most of their space
/// 6. shapes that are alike elsewhere, the nearest first
/// 7. closed meshes that are alike after a rotation, within the size of the object
/// \param spaces  exact common volumes
/// \param voxels  common voxels, for shapes without a closed mesh
[[nodiscard]] std::vector<Match> matchObjects(const Sides& sides, const CompareOptions& options,
                                              analyze::CommonSpaces& spaces, const VoxelOverlaps& voxels);

}  // namespace svt::compare
