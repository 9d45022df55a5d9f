#pragma once
/// \file
/// Photographs in linear light, reduced in size, to take means of colours. Not in the WebAssembly module.

#include <svt/core/result.hpp>
#include <svt/image/image.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace svt::image {

/// Red, green and blue in linear light, multiplied by alpha; each 0..65535.
struct LinearPixel {
    std::uint16_t r = 0, g = 0, b = 0, a = 0;
    friend bool operator==(const LinearPixel&, const LinearPixel&) = default;
};

struct LinearImage {
    Image<LinearPixel> pixels;
    std::int32_t width = 0, height = 0;  ///< pixels of the file
};

inline constexpr std::int32_t kMaxLinearSize = 1024;                           ///< pixels along an axis of the result
inline constexpr std::uint64_t kMaxLinearSource = std::uint64_t{8192} * 8192;  ///< pixels of the file

/// Decodes a PNG or JPEG. Each pixel of the result is the mean of a square block of pixels of the file, 1 x 1 for files
/// of at most kMaxLinearSize pixels along each axis.
/// \return the image; BadImage if the bytes are neither, or damaged, or hold more than kMaxLinearSource pixels
/// Cost: O(pixels of the file). Memory: 8 bytes per pixel of the result (8 MiB), and while it runs 4 bytes per pixel of
/// the file for a PNG, 6 for a progressive JPEG.
[[nodiscard]] Result<LinearImage> decodeLinear(std::span<const std::byte> bytes);

/// Pixels of the file as its header states, to plan memory; 0 if that is not known.
[[nodiscard]] std::uint64_t pngPixels(std::span<const std::byte> bytes) noexcept;

}  // namespace svt::image
