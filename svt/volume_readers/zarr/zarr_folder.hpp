#pragma once
/// \file
/// Label volumes in folders of Zarr: one of `svt convert`, an image of OME-NGFF (its finest level), or an array alone.

#include <svt/volume_readers/samples/label_image.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::volume_readers {

/// Whether it is a folder with metadata of Zarr.
[[nodiscard]] bool looksLikeZarr(const std::filesystem::path& folder);

/// Reads the metadata. Samples come by bands of chunks, which are unpacked on the way; what leads out of the folder, by a
/// name or a link, is not followed.
/// \param maxBytes  of memory; a band of chunks may take half of it
/// \return the image, or CannotOpen, BadJson, BadImage with what cannot be read, InputTooBig
[[nodiscard]] Result<LabelImage> openZarr(const std::filesystem::path& folder, std::uint64_t maxBytes);

}  // namespace svt::volume_readers
