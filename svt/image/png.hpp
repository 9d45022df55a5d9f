#pragma once
/// \file
/// PNG files (ISO/IEC 15948). Equal images give equal bytes: no timestamps, no metadata.

#include <svt/core/result.hpp>
#include <svt/image/image.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace svt::image {

inline constexpr std::int32_t kMaxPngSize = 16384;  ///< pixels along an axis

/// Encodes an image as RGBA with 8 bits per channel, sRGB.
/// \param dpi  pixels per inch, for print; 0: not stored
/// \return the file's bytes, or BadImage if the image is empty, or wider or higher than kMaxPngSize
[[nodiscard]] Result<std::vector<std::byte>> encodePng(const Image<Rgba8>& image, int dpi = 0);
/// Encodes an image as gray with 16 bits.
[[nodiscard]] Result<std::vector<std::byte>> encodePng(const Image<std::uint16_t>& image);

/// Writes a file atomically: on failure an existing file is unchanged.
/// \return nothing, or BadImage, CannotWrite or DiskFull
Result<void> writePng(const std::filesystem::path& path, const Image<Rgba8>& image, int dpi = 0);
Result<void> writePng(const std::filesystem::path& path, const Image<std::uint16_t>& image);

/// Decodes a PNG of any kind to RGBA with 8 bits per channel, sRGB: a different gamma in the file is converted, 16 bits
/// are truncated to the upper 8, gray is expanded to three equal channels.
/// \param maxSize  pixels along an axis; a larger image is rejected before memory is allocated for it
/// \return the image, or BadImage if the bytes are not a PNG, are damaged, or the image is larger than `maxSize`
[[nodiscard]] Result<Image<Rgba8>> decodePng(std::span<const std::byte> bytes, std::int32_t maxSize = kMaxPngSize);
/// The same for a file; CannotOpen if it is missing or unreadable.
[[nodiscard]] Result<Image<Rgba8>> readPng(const std::filesystem::path& path, std::int32_t maxSize = kMaxPngSize);
/// Reads a PNG with 16 bits gray; BadImage for any other kind.
[[nodiscard]] Result<Image<std::uint16_t>> readGrayPng(const std::filesystem::path& path);

}  // namespace svt::image
