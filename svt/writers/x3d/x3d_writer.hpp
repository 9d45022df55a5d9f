#pragma once
/// \file
/// Writes a semantic volume as X3D 4.0 (ISO/IEC 19775-1, components Texturing3D and VolumeRendering): the 3D texture that
/// the paper calls a semantic volume texture, as the voxels of a SegmentedVolumeData. X_ITE and Castle show it.
///
/// An X3D texture has bytes, so a voxel is a colour: red is the code of its look (3 times its number in the palette), green
/// the low byte of the scalar, blue the high byte. The transfer function, from red to colour and opacity, is the picture of
/// 256 x 1 pixels of an OpacityMapVolumeStyle. Of more than 84 looks, further ones are shown as the nearest.
/// Samples are never interpolated (NEAREST_PIXEL). The volume stands in metres with y up, its lower corner at the origin;
/// the world coordinates of that corner, the CRS and the range of scalars of each feature are metadata.
///
/// The fourth kind is not of the standard: an ImageTextureAtlas, one picture of all slices, which is all that X3DOM shows as a
/// volume. It has colours, not labels, and no features.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/dense/format_options.hpp>
#include <svt/writers/x3d/texture_files.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

/// What is written beside the document: `<stem>.labels.nrrd`, or `<stem>_slices/0000.png` and so on, or
/// `<stem>.atlas.png`.
/// Equal volumes give equal bytes; the document appears when all is written.
/// \param maxVoxels  limit of samples as numbers in the document
/// \return bytes of the document, or BadArgument (too many scalars or voxels), CannotWrite, DiskFull, WouldDestroy,
///         Cancelled
[[nodiscard]] Result<std::uint64_t> writeX3d(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                             TextureKind kind, std::uint64_t maxVoxels,
                                             const DenseOptions& options = {});

}  // namespace svt::writers
