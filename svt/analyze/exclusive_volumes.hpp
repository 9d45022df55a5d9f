#pragma once
/// \file
/// Volumes of labels that add up to the volume of their union: each cubic metre counts once, exact from closed meshes.

#include <svt/analyze/extents.hpp>
#include <svt/analyze/label_measures.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace svt::analyze {

/// ownMeasures() with exact volumes where meshes give them. A label with a closed mesh has the volume of its mesh without
/// the space that other labels have, however thin. Where three or more labels have one place, convex cells of meshes of up
/// to 256 triangles give the volume; of larger ones, or of meshes that cover themselves, at most kMostClaims labels do.
/// If a label with space in the mesh has no closed mesh, or if the work does not suffice, the volume stays that of
/// ownMeasures().
/// Measure::countedVolume is 0 for exact volumes. A hull and the bodies in it (volume::Filling::Body) have an exact sum, which
/// their voxels divide.
/// \param work  maximum number of steps, see SolidOverlapOptions
/// Cost: that of solidOverlaps(), and for each place that n labels claim, of the tuples of their triangles there.
[[nodiscard]] std::vector<Measure> exclusiveMeasures(const volume::SemanticVolume& volume,
                                                     std::uint64_t work = std::uint64_t{1} << 28);
inline constexpr std::size_t kMostClaims = 8;

/// A volume of some labels, without voxels, for exclusiveMeasures() and sections: as if it had nothing else. Voxels that
/// other labels took belong to the kept ones again.
/// \param isKept  by label
/// Cost: O(points and triangles of all labels).
[[nodiscard]] volume::SemanticVolume keepLabels(const volume::SemanticVolume& volume, const std::vector<char>& isKept);

/// The feature that each label counts to: the finest of `features` whose extent contains it, and itself if it is one of
/// them. kNoLabel outside of all extents. So each label counts once, however features contain each other: a wall and its
/// layers, a storey and its rooms.
/// Cost: O(labels of all extents).
[[nodiscard]] std::vector<std::uint32_t> finestFeatures(const Extents& extents, std::span<const std::uint32_t> features,
                                                        std::size_t labelCount);

}  // namespace svt::analyze
