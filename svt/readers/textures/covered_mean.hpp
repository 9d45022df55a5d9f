#pragma once
/// \file
/// Mean colours of parts of images.

#include <svt/core/vec.hpp>
#include <svt/image/linear_image.hpp>
#include <svt/readers/textures/texture_set.hpp>

#include <cstdint>
#include <optional>
#include <span>

namespace svt::readers::textures {

/// The part of an image that a use covers, in pixels of the reduced image: u to the right, v down.
struct CoveredRings {
    std::span<const TexturePoint> points;
    std::span<const std::uint32_t> ringEnds;
    Wrap wrap = Wrap::Repeat;
    bool areSeparate = false;  ///< see TextureUse
};

/// The mean over the texels within rings (even-odd rule), in linear light, weighted by alpha. At most 64 x 64 places are
/// looked at for all rings, or for each ring if these are separate. Rings without an area give the mean at their points.
/// \return nothing if no place has a colour, or the rings repeat the image too often or have coordinates that are not
///         finite
/// Cost: O(64 * points + places).
[[nodiscard]] std::optional<Vec3d> coveredMean(const image::LinearImage& image, const CoveredRings& rings);

/// The mean of the whole image; nothing if it is invisible.
[[nodiscard]] std::optional<Vec3d> wholeMean(const image::LinearImage& image);

}  // namespace svt::readers::textures
