#pragma once
/// \file
/// JPEG files (ISO/IEC 10918-1), read row by row, so that large photographs need little memory. Not in the WebAssembly
/// module.

#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace svt::image {

/// A progressive image is in memory as a whole, so it has a limit of its own.
inline constexpr std::uint64_t kMaxProgressivePixels = std::uint64_t{4096} * 4096;

/// Receives the rows of an image from the top.
struct JpegRows {
    std::function<void(std::int32_t width, std::int32_t height)> begin;          ///< called once, before the first row
    std::function<void(std::int32_t y, std::span<const std::uint8_t> rgb)> add;  ///< 3 bytes per pixel, sRGB
};

/// Decodes a baseline or progressive JPEG, gray or in colour.
/// \param maxPixels  width times height; a larger image is rejected before memory is allocated for it
/// \return nothing; BadImage if the bytes are not a JPEG, are damaged or cut off, have the colours of a printer (CMYK), or
///         the image is too large. Rows may have been added before an error
/// Cost: O(pixels). Memory: a few rows; for progressive images 6 bytes per pixel.
Result<void> decodeJpeg(std::span<const std::byte> bytes, std::uint64_t maxPixels, const JpegRows& rows);

}  // namespace svt::image
