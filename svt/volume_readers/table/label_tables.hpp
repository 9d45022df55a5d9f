#pragma once
/// \file
/// Converts values to labels: by the table that `svt convert` wrote, a table of the user, labels that the format
/// describes, or one label per value.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/volume_readers/samples/label_image.hpp>

#include <filesystem>
#include <string_view>

namespace svt::volume_readers {

/// Reads a table of labels (JSON): `labels.json` of a .svt, or
///
///     {"labels": [{"value": 17, "id": "R1", "class": "BuildingRoom", "name": "Kitchen", "parent": "B1",
///                  "color": "#d8c8a0", "opacity": 0.3, "attributes": {"usage": "1000"}}, ...]}
///
/// where `value` is a number, a range [first, last], or absent for a label without voxels, which then needs an `id`.
/// All other members are optional.
/// \return the labels, values in `first` and `count`; or CannotOpen, BadJson with the problem, InputTooBig
struct UserTable {
    std::string labelsJson;                          ///< if the file is a labels.json
    std::vector<ToldLabel> told;                     ///< else
    std::vector<std::vector<Attribute>> attributes;  ///< of each told label
    std::vector<float> opacities;
};
[[nodiscard]] Result<UserTable> readUserTable(const std::filesystem::path& path);
/// Like readUserTable(), but from text. \return as above; errors have no place
[[nodiscard]] Result<UserTable> parseUserTable(std::string_view text);

struct MadeVolume {
    volume::SemanticVolume volume;
    std::vector<std::string> warnings;
};

/// Creates the volume of an image from the values of its samples.
/// \param values  columns whose scalars are the values of the samples
/// \return the volume, or BadVolume (a table that does not fit the values), BadChecksum (table or samples differ from
///         those that were written), BadJson, BadImage (a mirrored or sheared grid), TooManyLabels, BadDimension,
///         GridTooLarge
[[nodiscard]] Result<MadeVolume> makeVolume(const LabelImage& image, volume::ColumnVolume values,
                                            const UserTable* table, const std::filesystem::path& path);

}  // namespace svt::volume_readers
