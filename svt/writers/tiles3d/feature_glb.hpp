#pragma once
/// \file
/// A tile's content: hulls of labels as one .glb whose vertices reference their features (EXT_mesh_features), and a
/// table with one row per feature (EXT_structural_metadata).

#include <svt/writers/hulls/label_hulls.hpp>
#include <svt/writers/surface_source.hpp>
#include <svt/writers/tiles3d/property_table.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace svt::writers {

/// Texts for the rows of the table, one entry per label.
struct FeatureTexts {
    std::vector<std::string> storeys;  ///< name or id of the storey of a label; may be empty
    std::vector<double> volumes;       ///< m3
};
[[nodiscard]] FeatureTexts featureTexts(const volume::SemanticVolume& volume);

/// The surfaces of all labels with voxels, by MeshChoice and GlbFaces. A label whose faces are all covered has an empty
/// surface. \return the surfaces, or an error of makeLabelHulls()
[[nodiscard]] Result<LabelHulls> makeTileHulls(const volume::SemanticVolume& volume, MeshChoice choice,
                                               const VolumeWriteOptions& options);

/// Surfaces [begin, end) as a .glb, y up, metres from the lower corner of the grid. Feature n is surface begin + n, or
/// the nth building. Shading is flat: a vertex has the normal of its face, and is stored once per face.
/// \return the file, or GridTooLarge if it would reach the limit of 4 GiB
[[nodiscard]] Result<std::string> makeFeatureGlb(const LabelHulls& hulls, std::size_t begin, std::size_t end,
                                                 const FeatureTexts& texts, const TilesetWriteOptions& options = {});

/// The box around surfaces [begin, end), world directions, metres from the lower corner.
[[nodiscard]] Box3d boxOfHulls(const LabelHulls& hulls, std::size_t begin, std::size_t end);

}  // namespace svt::writers
