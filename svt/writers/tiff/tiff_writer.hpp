#pragma once
/// \file
/// Writes a semantic volume as a TIFF stack (.tif, .ome.tif), which Fiji/ImageJ, tifffile, napari and GDAL read.
///
/// A page is a slice k; its rows are j, its pixels i: the page is the array as it is, so that north is at the bottom of
/// what a viewer shows. Samples of 8, 16 or 32 bits, unsigned; BigTIFF from 4 GB on. The first page tells spacing and
/// unit: as ImageJ's text, or as OME-XML where the name ends in .ome.tif; ImageJ itself has no whole numbers of 32 bits,
/// so for these its text is left out. The matrix of GeoTIFF (ModelTransformation, tag 34264) leads from pixel (i, j, k) to
/// world space, where a sample is a point. Private tags 65080, 65081 and 65082 hold `svt.json` and `labels.json` of a `.svt`
/// and their seal, so that the file can become a volume again.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/dense/format_options.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

enum class TiffMetadata : std::uint8_t { ImageJ, Ome };

/// Writes one file, all or nothing, in strips of about 1 MiB by Deflate, or raw with one strip per page. Equal volumes
/// give equal bytes. Cost: O(samples); memory: about 150 MB at most, besides the label table.
/// \return bytes written, or CannotWrite, DiskFull, Cancelled; BadArgument as checkedSampleBits()
[[nodiscard]] Result<std::uint64_t> writeTiff(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                              TiffMetadata metadata, const DenseOptions& options = {});

}  // namespace svt::writers
