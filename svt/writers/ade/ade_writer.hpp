#pragma once
/// \file
/// Writes a semantic volume into a CityGML document, as the paper defines it: a VolumeTexture in an Appearance, by an
/// application domain extension (docs/formats/citygml/svt-ade-2.0.xsd and -3.0.xsd).
///
/// The document is that of the model, byte for byte, with one appearance of the theme "SVT" in front of its last end tag;
/// CityGML 1.0 is written as 2.0, which it is but for its namespaces. Where there is no document, features stand as
/// buildings and generic objects without geometry. The texture has scalar type, dimension, spacing, envelope (from the
/// first to the last sample: `node`), and for each feature its gml:id with the range of scalars that it and all below it
/// own. Its metadata hold `svt.json` and `labels.json` of a `.svt`, so that the document can become the same volume again.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

/// What is written beside the document: `<stem>.labels.nrrd`, or `<stem>_slices/0000.png` and so on.
/// \return bytes of the document, or BadArgument (a turned grid, which the extension cannot say; another version than the
///         model's; a model with a volume; too many voxels), CannotOpen, UnknownFormat (a model that is no CityGML in
///         UTF-8), CannotWrite, DiskFull, WouldDestroy, Cancelled
[[nodiscard]] Result<std::uint64_t> writeAde(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                             const VolumeWriteOptions& options);

}  // namespace svt::writers
