#pragma once
/// \file
/// Whether the peers found the same: voxel by voxel, pixel by pixel.

#include <bench/peers.hpp>
#include <svt/image/image.hpp>
#include <svt/volume/column_volume.hpp>

#include <array>
#include <cstdint>
#include <span>
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
[[nodiscard]] double agreeingShare(const image::Image<volume::Scalar>& ours, const image::Image<image::Rgba8>& theirs);

/// How far colors are apart, in levels of 255, over the pixels where either picture is not black.
struct ColorComparison {
    std::uint64_t pixels = 0;
    std::array<double, 3> mean{};  ///< of the difference, per channel
    int largest = 0;               ///< of any channel
    double over2 = 0, over8 = 0;   ///< share of these pixels, 0..1, with a channel more than 2, more than 8 levels off
};

/// Sizes must agree.
[[nodiscard]] ColorComparison compareColors(const image::Image<image::Rgba8>& ours,
                                            const image::Image<image::Rgba8>& theirs);

/// The picture without light of opaque labels: each pixel has the color of its label's style, black without a label.
[[nodiscard]] image::Image<image::Rgba8> flatPicture(const image::Image<volume::Scalar>& labels,
                                                     std::span<const render::Style> styles);

/// `picture` in linear light, times `factor`: what a renderer makes that blends linear numbers.
[[nodiscard]] image::Image<image::Rgba8> linearPicture(const image::Image<image::Rgba8>& picture, float factor);

}  // namespace svt::bench
