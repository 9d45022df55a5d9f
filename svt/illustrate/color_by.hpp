#pragma once
/// \file
/// Colours of components by what is known of them: a ramp for numbers, a palette for words.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/model/query.hpp>
#include <svt/volume/semantic_volume.hpp>

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

/// Colours the rows where `isShown` by a key of the query language: class, id, name, storey, volume, area, voxels, or an
/// attribute, which a row without it has from the nearest feature above it. Values that are all numbers get viridis,
/// which grows lighter evenly and is told apart by all eyes (van der Walt and Smith 2015); others, among them up to 18
/// codes that read like numbers, the palette "muted" (Tol 2021), and lighter shades of it from the tenth value on; values
/// beyond the 18th, and rows without a value, are gray. `volume` counts m3.
/// \param isShown  by row: 1 if it takes part; colours and ends of the ramp are chosen for these alone
/// \param areas    by row: m2, for the key `area`, or 0 where only an attribute may say it; empty: nowhere known
/// \return the colours; BadArgument if no shown row has the key, naming those that there are
/// Cost: O(rows * (attributes + depth of the tree)).
[[nodiscard]] Result<Coloring> colorBy(std::string_view key, std::span<const model::QueryRow> rows,
                                       std::span<const std::uint8_t> isShown, std::span<const double> areas = {});

/// The areas that colorBy() wants for its key, by label: floor areas of rooms, see measureFloorAreas(). Empty for other
/// keys, or an error of findLevels() or measureFloorAreas().
[[nodiscard]] Result<std::vector<double>> areasFor(std::string_view key, const volume::SemanticVolume& volume);

/// Gives each label its owner as an attribute `owner`, for colours and queries: what the table lists has the owner that it
/// says, a wall or slab that belongs to one owner alone has that one, and what several divide is "shared".
/// \param table  CSV, see analyze::parseOwners()
/// \param file   name of the table, for messages
/// \return an error of parseOwners()
[[nodiscard]] Result<void> addOwnerAttributes(volume::SemanticVolume& volume, std::string_view table,
                                              std::string_view file, int threads = 0);

/// Colour of a ramp's value, as colorBy() gives it; sRGB.
[[nodiscard]] Vec3f rampColor(const ColorScale& scale, double value);

/// Colour of what has no value; sRGB.
[[nodiscard]] Vec3f missingColor() noexcept;

}  // namespace svt::illustrate
