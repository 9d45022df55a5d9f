#pragma once
/// \file
/// Textures of a model as its file states them: images, and the parts of them that lie on polygons.

#include <svt/model/building_model.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace svt::readers::textures {

/// The WebAssembly module has no files beside the model, and no code for images.
#ifdef __EMSCRIPTEN__
inline constexpr bool kReadsTextures = false;
#else
inline constexpr bool kReadsTextures = true;
#endif

/// A point of a texture: u to the right, v up, both 0..1 within the image. For a georeferenced image it is a place on the
/// map.
struct TexturePoint {
    double u = 0, v = 0;
};

/// The meaning of coordinates outside the image.
enum class Wrap : std::uint8_t {
    Repeat,
    Mirror,
    Clamp,
    None  ///< no colour
};

/// x = a * column + b * row + x0, y = d * column + e * row + y0: the place on the map of the centre of a pixel.
struct WorldPlace {
    double a = 0, b = 0, d = 0, e = 0, x0 = 0, y0 = 0;
};

struct TextureImage {
    std::string file;                   ///< as the model names it, or a name for messages
    std::vector<std::byte> content{};   ///< the file itself, if the model holds it; else empty
    bool isGeoreferenced = false;       ///< coordinates are places on the map
    std::optional<WorldPlace> world{};  ///< of a georeferenced image; absent: in the world file beside it
};

/// The part of an image that lies on one or more polygons.
struct TextureUse {
    std::uint32_t image = 0;
    Wrap wrap = Wrap::Repeat;
    std::int32_t otherwise = -1;  ///< material of the polygons if the image cannot be used
    /// The rings belong to different polygons, so none is a hole in another.
    bool hasSeparateRings = false;
    std::vector<TexturePoint> points{};     ///< of all rings; empty: the whole image
    std::vector<std::uint32_t> ringEnds{};  ///< index behind the last point of each ring
};

struct TextureSet {
    std::vector<TextureImage> images;
    std::vector<TextureUse> uses;
};

/// Whether a texture of the same surface takes precedence: an opaque grey, black or white material, as exporters write it
/// below a texture.
[[nodiscard]] inline bool isPlainGrey(const model::Material& material) noexcept {
    const auto [least, most] = std::minmax({material.diffuse.x, material.diffuse.y, material.diffuse.z});
    return material.hasColor && material.transparency <= 0 && most - least < 0.02f;
}

// While a file is read, Polygon::material refers to a texture by a number below -1.

/// Most uses that have a number.
inline constexpr std::size_t kMaxUses = std::size_t{1} << 30;
[[nodiscard]] constexpr std::int32_t materialOfUse(std::size_t use) noexcept {
    return -2 - static_cast<std::int32_t>(use);
}
[[nodiscard]] constexpr bool isUse(std::int32_t material) noexcept { return material < -1; }
[[nodiscard]] constexpr std::size_t useOf(std::int32_t material) noexcept {
    return static_cast<std::size_t>(-2 - material);
}

}  // namespace svt::readers::textures
