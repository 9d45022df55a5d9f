#pragma once
/// \file
/// Colours of components by their data: a ramp for numbers, a palette for words.

#include <svt/core/diagnostics.hpp>
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

/// The meaning of the colours of a picture: the content of its legend.
struct ColorScale {
    struct Entry {
        std::string text;
        Vec3f color;  ///< sRGB, 0..1
        std::size_t count = 0;
    };
    std::string title;               ///< the key, with the unit of its values: "volume (m3)"
    bool isRamp = false;             ///< numbers from `low` to `high`; false: the entries
    double low = 0, high = 0;        ///< low <= high
    std::vector<Entry> entries;      ///< palette: by text, or by count if there are more than colours; then the others
    std::size_t missing = 0;         ///< components without a value: gray
    std::vector<Vec3f> ramp;         ///< colours of a ramp at equal steps from `low` to `high`; empty: viridis
    std::string missingText;         ///< beside the gray box; empty: by `missing`
    std::vector<std::string> notes;  ///< further lines at the end
};

/// Colours for rows of labels.
struct Coloring {
    std::vector<Vec3f> colors;  ///< by row, sRGB; gray for rows without a value
    ColorScale scale;
};

/// Colours the rows with `isShown` by a key of the query language: class, id, name, storey, volume, area, voxels, or an
/// attribute. A row without the attribute inherits it from the nearest feature above it. If all values are numbers,
/// they get viridis, which grows lighter evenly and is safe for colour-blind readers (van der Walt and Smith 2015).
/// Other values, among them up to 18 codes that look like numbers, get the palette "muted" (Tol 2021), and lighter
/// shades of it from the tenth value on. Values beyond the 18th, and rows without a value, are gray. `volume` counts
/// m3.
/// \param isShown   by row: 1 if it gets a colour, and counts in the legend
/// \param areas     by row: m2, for the key `area`, or 0 if only an attribute may contain it; empty: all unknown
/// \param isHidden  by row: 1 if it is not shown, but has a part in the choice of colours and in the ends of the ramp.
///                  So hiding a component does not change the colours of others. Empty: none.
/// \return the colours; BadArgument if no shown row has the key (the message lists the available keys)
/// Cost: O(rows * (attributes + depth of the tree)).
[[nodiscard]] Result<Coloring> colorBy(std::string_view key, std::span<const model::QueryRow> rows,
                                       std::span<const std::uint8_t> isShown, std::span<const double> areas = {},
                                       std::span<const std::uint8_t> isHidden = {});

/// The areas that colorBy() needs for the key `area`, by label: floor areas of rooms, see measureFloorAreas(). Empty
/// for other keys, or an error of findLevels() or measureFloorAreas().
[[nodiscard]] Result<std::vector<double>> areasFor(std::string_view key, const volume::SemanticVolume& volume);

/// Gives each label its owner as an attribute `owner`, for colours and queries. Labels in the table get the listed
/// owners, separated by commas. A wall or slab that belongs to only one owner gets this owner, one that several owners
/// share gets "shared".
/// \param table    CSV, see analyze::parseOwners()
/// \param file     file name of the table, for messages
/// \param unknown  receives a warning for each row that names no feature
/// \return an error of parseOwners()
[[nodiscard]] Result<void> addOwnerAttributes(volume::SemanticVolume& volume, std::string_view table,
                                              std::string_view file, Diagnostics& unknown, int threads = 0);

/// Colour of a ramp's value, as in colorBy(); sRGB.
[[nodiscard]] Vec3f rampColor(const ColorScale& scale, double value);

/// Colour of labels without a value; sRGB.
[[nodiscard]] Vec3f missingColor() noexcept;

}  // namespace svt::illustrate
