#pragma once
/// \file
/// Colour maps for values: tables of 256 colours from low to high. Their lightness changes evenly, so that equal steps of
/// a value look equal, also in print and to colour-blind readers (Crameri, Shephard and Heron 2020).

#include <svt/core/names.hpp>
#include <svt/core/vec.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace svt::image {

enum class ColorMap : std::uint8_t {
    Viridis,  ///< violet, green, yellow (van der Walt and Smith 2015)
    Cividis,  ///< blue to yellow, the same to colour-blind readers (Nunez, Anderton and Renslow 2018)
    Inferno,  ///< black, red, yellow: heat and fire
    Batlow,   ///< dark blue, green, orange, pink (Crameri 2018)
    Vik,      ///< blue, white, brown: values on both sides of a middle (Crameri 2018)
    Greys     ///< light to dark grey, for print
};
constexpr auto namesOf(ColorMap) {
    return std::to_array<Name<ColorMap>>({{ColorMap::Viridis, "viridis"},
                                          {ColorMap::Cividis, "cividis"},
                                          {ColorMap::Inferno, "inferno"},
                                          {ColorMap::Batlow, "batlow"},
                                          {ColorMap::Vik, "vik"},
                                          {ColorMap::Greys, "greys"}});
}

/// The colour of a share, linear between the entries of the table.
/// \param share  0 (low) to 1 (high); others are clamped, NaN is low
/// \return sRGB, 0..1. Cost O(1). Any thread.
[[nodiscard]] Vec3f mapColor(ColorMap map, double share) noexcept;

/// The 256 entries of a map, from low to high; sRGB, 0..1.
[[nodiscard]] std::vector<Vec3f> mapColors(ColorMap map);

/// The colour of places without a value, in every map; sRGB.
inline constexpr Vec3f kNoValueColor{0.835f, 0.835f, 0.835f};

}  // namespace svt::image
