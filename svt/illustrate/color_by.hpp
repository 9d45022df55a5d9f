#pragma once
/// \file
/// Colours of components by what is known of them: a ramp for numbers, a palette for words.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/model/query.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::illustrate {

/// What the colours of a picture mean: the content of its legend.
struct ColorScale {
    struct Entry {
        std::string text;
        Vec3f color;  ///< sRGB, 0..1
        std::size_t count = 0;
    };
    std::string title;           ///< the key, with the unit of its values: "volume (m3)"
    bool isRamp = false;         ///< numbers from `low` to `high`; else the entries
    double low = 0, high = 0;    ///< low <= high
    std::vector<Entry> entries;  ///< palette: by text, or by count where there are more than colours; then the others
    std::size_t missing = 0;     ///< components without a value: gray
};

/// Colours for rows of labels.
struct Coloring {
    std::vector<Vec3f> colors;  ///< by row, sRGB; gray for rows without a value
    ColorScale scale;
};

/// Colours the rows where `isShown` by a key of the query language: class, id, name, storey, volume, voxels, or an
/// attribute, which a row without it has from the nearest feature above it. Values that are all numbers get viridis,
/// which grows lighter evenly and is told apart by all eyes (van der Walt and Smith 2015); others, among them up to 18
/// codes that read like numbers, the palette "muted" (Tol 2021), and lighter shades of it from the tenth value on; values
/// beyond the 18th, and rows without a value, are gray. `volume` counts m3.
/// \param isShown  by row: 1 if it takes part; colours and ends of the ramp are chosen for these alone
/// \return the colours; BadArgument if no shown row has the key, naming those that there are
/// Cost: O(rows * (attributes + depth of the tree)).
[[nodiscard]] Result<Coloring> colorBy(std::string_view key, std::span<const model::QueryRow> rows,
                                       std::span<const std::uint8_t> isShown);

/// Colour of a ramp's value, as colorBy() gives it; sRGB.
[[nodiscard]] Vec3f rampColor(const ColorScale& scale, double value);

/// Colour of what has no value; sRGB.
[[nodiscard]] Vec3f missingColor() noexcept;

}  // namespace svt::illustrate
