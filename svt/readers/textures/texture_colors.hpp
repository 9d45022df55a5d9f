#pragma once
/// \file
/// Colours of surfaces that have a texture and no material.
///
/// An object has one colour for each class of its surfaces: the walls of a building one, its roofs another. It is the
/// mean of the texels on these surfaces in linear light, weighted by the area of the surfaces. So the number of colours
/// does not grow with the number of polygons, and shadows in a photograph do not change one wall of a house.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/read_options.hpp>
#include <svt/readers/textures/texture_set.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::readers::textures {

/// Name of the materials that stand for textures.
inline constexpr std::string_view kTextureName = "texture";

struct MeanColors {
    std::vector<std::optional<Vec3d>> ofUses;  ///< linear light, 0..1; absent: the image cannot be used
    std::size_t images = 0, failed = 0;
    std::string example;  ///< the first that failed, and why
};

/// The mean colours of all uses. Where a use has no coordinates, or covers no visible texel, it gets the mean of its
/// image.
/// \param folder  of the model, see ImageFiles
/// Cost: each image is decoded once, at most 4 at a time, and only one PNG of more than 16 million pixels at a time. So
/// images take at most 512 MiB. The result does not depend on the number of threads.
[[nodiscard]] MeanColors meanColors(const TextureSet& set, const std::string& folder, const ReadOptions& options);

/// Adds one note for all images of a file that could not be used.
void reportImages(const MeanColors& means, std::string_view fileName, Diagnostics& diagnostics);

/// The sRGB colour of linear light, rounded to 32 levels for each channel, so that nearly equal colours become equal.
[[nodiscard]] Vec3f roundedColor(Vec3d linear);

/// Replaces the numbers of uses in Polygon::material by materials of the model, or by TextureUse::otherwise where
/// the image cannot be used.
/// \return nothing, or Cancelled
Result<void> colorTextured(model::BuildingModel& model, const TextureSet& set, std::string_view fileName,
                           const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace svt::readers::textures
