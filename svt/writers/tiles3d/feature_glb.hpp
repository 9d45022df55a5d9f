#pragma once
/// \file
/// A tile's content: hulls of labels as one .glb whose vertices tell which feature they belong to (EXT_mesh_features),
/// and a table with a row for each feature (EXT_structural_metadata).

#include <svt/writers/hulls/label_hulls.hpp>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace svt::writers {

/// What the rows of the table tell, one entry for each label.
struct FeatureTexts {
    std::vector<std::string> storeys;  ///< name or id of the storey that a label belongs to; may be empty
    std::vector<double> volumes;       ///< m3
};
[[nodiscard]] FeatureTexts featureTexts(const volume::SemanticVolume& volume);

/// Surfaces [begin, end) as a .glb, y up, metres from the lower corner of the grid; feature n is surface begin + n. Faces
/// are flat: a vertex has the normal of its face, and is stored for each of them.
/// \return the file; or GridTooLarge where it would reach the limit of 4 GiB
[[nodiscard]] Result<std::string> makeFeatureGlb(const LabelHulls& hulls, std::size_t begin, std::size_t end,
                                                 const FeatureTexts& texts);

/// A .glb of a document and its one buffer, which begins at a multiple of 8 bytes.
[[nodiscard]] std::string asGlbFile(const nlohmann::ordered_json& json, const std::string& binary);

/// The box around surfaces [begin, end), world directions, metres from the lower corner.
[[nodiscard]] Box3d boxOfHulls(const LabelHulls& hulls, std::size_t begin, std::size_t end);

}  // namespace svt::writers
