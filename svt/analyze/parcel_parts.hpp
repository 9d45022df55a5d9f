#pragma once
/// \file
/// The parts of features in parcels: exact where the feature and the parcel are closed meshes, else counted in voxels.
///
///     volume of a flat in a parcel = the sum over its labels of (own volume of the label) and (parcel)
///
/// Own volumes add up: space that several labels claim belongs to one of them, as in exclusive_volumes.hpp.

#include <svt/analyze/known_volumes.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace svt::analyze {

struct ParcelPart {
    std::uint32_t label = 0;                   ///< of the feature
    std::uint32_t parcel = volume::kNoLabel;   ///< label in the volume of the parcels; kNoLabel: outside of all
    std::uint64_t voxels = 0;                  ///< all that are shared
    double volume = 0;                         ///< m3
    double part = 0;                           ///< of the feature; the parts of a feature add up to 1
    std::optional<double> bound;               ///< m3 by which `volume` may be off; empty: unknown
    VolumeSource source = VolumeSource::None;  ///< Both: meshes, and voxels for labels without a closed mesh
};

/// Divides features, each with all its parts, by parcels. Figures are exact if all parcels are closed meshes that do not
/// overlap. The bound of counted voxels is half a voxel along each counted surface and along the borders of the
/// parcels in it, and at most the counted volume.
/// \param features  labels of `volume`, ascending
/// \param parcels   a volume on the same grid
/// \param work      maximum number of steps, see SolidOverlapOptions; the function counts the rest
/// \return the parts by feature, then parcel, kNoLabel last; or BadArgument if the grids differ
/// Cost: that of sharedVoxels() and exclusiveMeasures(), and per label and parcel whose boxes overlap, of the pairs of
/// their triangles.
[[nodiscard]] Result<std::vector<ParcelPart>> partsInParcels(const volume::SemanticVolume& volume,
                                                             std::span<const std::uint32_t> features,
                                                             const volume::SemanticVolume& parcels, int threads = 0,
                                                             std::uint64_t work = std::uint64_t{1} << 28);

}  // namespace svt::analyze
