#pragma once
/// \file
/// Agreement with the peers: voxel by voxel, pixel by pixel.

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
    std::uint64_t differing = 0;  ///< voxels with different labels
    /// Those among them in the outermost layer of the grid: samples there lie exactly on the model's hull, where
    /// inside and outside are a matter of convention.
    std::uint64_t differingOnBorder = 0;

    [[nodiscard]] double differingPercent() const;  ///< without the border layer, of the voxels that ours fills
};

/// Dimensions must be equal.
[[nodiscard]] VoxelComparison compareVoxels(const volume::ColumnVolume& ours, const DenseLabels& theirs);

/// Colors that identify labels in pictures of other renderers: steps of 28 per channel, for up to 728 labels,
/// then repeating. Scalar 0 is black.
[[nodiscard]] Vec3f labelColor(std::uint32_t scalar);

/// Fraction of pixels, 0..1, whose color is nearest to the identifying color of our label, among those where either
/// picture is not empty.
[[nodiscard]] double agreeingShare(const image::Image<volume::Scalar>& ours, const image::Image<image::Rgba8>& theirs);

/// Difference between colors, in levels of 255, over the pixels where either picture is not black.
struct ColorComparison {
    std::uint64_t pixels = 0;
    std::array<double, 3> mean{};  ///< of the difference, per channel
    int largest = 0;               ///< of any channel
    double over2 = 0, over8 = 0;   ///< fraction of these pixels, 0..1, with a channel over 2, over 8 levels off
};

/// Sizes must be equal.
[[nodiscard]] ColorComparison compareColors(const image::Image<image::Rgba8>& ours,
                                            const image::Image<image::Rgba8>& theirs);

/// The unlit picture of opaque labels: each pixel has the color of its label's style, black without a label.
[[nodiscard]] image::Image<image::Rgba8> flatPicture(const image::Image<volume::Scalar>& labels,
                                                     std::span<const render::Style> styles);

/// `picture` in linear light, times `factor`: the result of a renderer that blends linear values.
[[nodiscard]] image::Image<image::Rgba8> linearPicture(const image::Image<image::Rgba8>& picture, float factor);

}  // namespace svt::bench
