#pragma once
/// \file
/// Whether the peers found the same: voxel by voxel, pixel by pixel.

#include <bench/peers.hpp>
#include <svt/render/image.hpp>
#include <svt/volume/column_volume.hpp>

#include <cstdint>
#include <vector>

namespace svt::bench {

struct VoxelComparison {
    std::uint64_t filledOurs = 0;
    std::uint64_t filledTheirs = 0;
    std::uint64_t differing = 0;  ///< voxels with another label
    /// Of these, in the outermost layer of the grid: samples there lie exactly on the model's hull, where inside and
    /// outside are a matter of convention.
    std::uint64_t differingOnBorder = 0;

    [[nodiscard]] double differingPercent() const;  ///< inside of the border layer, of the voxels that ours fills
};

/// Dimensions must agree.
[[nodiscard]] VoxelComparison compareVoxels(const volume::ColumnVolume& ours, const DenseLabels& theirs);

/// Colors that tell labels apart in a picture of another renderer: steps of 28 per channel, for up to 728 labels,
/// then again from the start. Scalar 0 is black.
[[nodiscard]] Vec3f telltaleColor(std::uint32_t scalar);

/// Share of pixels, 0..1, whose color is (nearest to) the telltale color of our label, of those where either picture
/// shows anything.
[[nodiscard]] double agreeingShare(const render::Image<volume::Scalar>& ours,
                                   const render::Image<render::Rgba8>& theirs);

}  // namespace svt::bench
