#pragma once
/// \file
/// PNG files (ISO/IEC 15948). The same picture gives the same bytes: no times, no metadata.

#include <svt/core/result.hpp>
#include <svt/image/image.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace svt::image {

/// The file's bytes: 8 bits RGBA, sRGB.
/// \param dpi  pixels an inch, for print; 0: none is said
/// \return the bytes, or BadImage where the picture is empty or wider or higher than kMaxPngSize
[[nodiscard]] Result<std::vector<std::byte>> encodePng(const Image<Rgba8>& image, int dpi = 0);
/// The file's bytes: 16 bits gray.
[[nodiscard]] Result<std::vector<std::byte>> encodePng(const Image<std::uint16_t>& image);

/// Writes a file, all or nothing: a failure leaves an old file as it was.
/// \return nothing, or BadImage, CannotWrite or DiskFull
Result<void> writePng(const std::filesystem::path& path, const Image<Rgba8>& image, int dpi = 0);
Result<void> writePng(const std::filesystem::path& path, const Image<std::uint16_t>& image);

/// Reads a PNG of any kind as 8 bits RGBA; 16 bits keep their upper half, gray becomes three equal channels.
/// \return the picture, or BadImage where the bytes are no PNG, are damaged, or are over kMaxPngSize
[[nodiscard]] Result<Image<Rgba8>> decodePng(std::span<const std::byte> bytes);
/// The same for a file; CannotOpen where it is missing or unreadable.
[[nodiscard]] Result<Image<Rgba8>> readPng(const std::filesystem::path& path);
/// Reads a PNG of 16 bits gray; BadImage for any other kind.
[[nodiscard]] Result<Image<std::uint16_t>> readGrayPng(const std::filesystem::path& path);

inline constexpr std::int32_t kMaxPngSize = 16384;  ///< pixels along an axis

}  // namespace svt::image
