#pragma once
/// \file
/// Textures of CityJSON: the members `appearance` of a file and `texture` of a geometry.

#include <svt/readers/cityjson/cityjson_objects.hpp>
#include <svt/readers/textures/texture_set.hpp>

#include <optional>
#include <string_view>

namespace svt::readers::cityjson {

/// Reads the images and texture vertices of an appearance.
[[nodiscard]] TextureSource readTextures(const OptionalElement& appearance);

/// The texture values of a geometry: those of `theme`, else of the theme with the first name.
[[nodiscard]] OptionalElement textureValues(json::object geometry, std::string_view theme);

/// Reads the texture values of a surface, [[image, vertex, ...], ...] with one array per ring.
/// \return nothing for null, or if the image does not exist
[[nodiscard]] std::optional<textures::TextureUse> readTextureUse(const json::element& rings,
                                                                 const TextureSource& source);

}  // namespace svt::readers::cityjson
