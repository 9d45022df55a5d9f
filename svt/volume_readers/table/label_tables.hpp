#pragma once
/// \file
/// From values to labels: the table that `svt convert` wrote, a table that a person wrote, what the format tells, or a label
/// per value.

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
/// where `value` is a number, a range [first, last], or absent for a label without voxels; all but `value` may be absent.
/// \return what is told, values in `first` and `count`; or CannotOpen, BadJson with what is wrong, InputTooBig
struct UserTable {
    std::string labelsJson;                          ///< where the file is a labels.json
    std::vector<ToldLabel> told;                     ///< else
    std::vector<std::vector<Attribute>> attributes;  ///< of each told label
    std::vector<float> opacities;
};
[[nodiscard]] Result<UserTable> readUserTable(const std::filesystem::path& path);
/// The same from text. \return as above, without a place
[[nodiscard]] Result<UserTable> parseUserTable(std::string_view text);

struct MadeVolume {
    volume::SemanticVolume volume;
    std::vector<std::string> warnings;
};

/// The volume of an image whose samples are read.
/// \param values  columns whose scalars are the values of the samples
/// \return the volume, or BadVolume (a table that does not fit the values), BadChecksum (another table or other samples
///         than were written), BadJson, BadImage (a grid that is mirrored or sheared), TooManyLabels, BadDimension,
///         GridTooLarge
[[nodiscard]] Result<MadeVolume> makeVolume(const LabelImage& image, volume::ColumnVolume values,
                                            const UserTable* table, const std::filesystem::path& path);

}  // namespace svt::volume_readers
