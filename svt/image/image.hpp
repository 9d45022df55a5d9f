#pragma once
/// \file
/// Images in memory, and the difference between two images.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::image {

/// Red, green, blue as sRGB, 0..255, and alpha, 0..255, not premultiplied.
struct Rgba8 {
    std::uint8_t r = 0, g = 0, b = 0, a = 0;
    friend bool operator==(const Rgba8&, const Rgba8&) = default;
};

/// Pixels in row-major order; row 0 is the top; pixel (x, y) is element x + width * y.
template <class T>
class Image {
public:
    Image() = default;
    /// \param width, height  at least 0; the pixels must fit into memory
    Image(std::int32_t width, std::int32_t height, T value = {})
        : width_(width),
          height_(height),
          pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value) {}

    [[nodiscard]] std::int32_t width() const noexcept { return width_; }
    [[nodiscard]] std::int32_t height() const noexcept { return height_; }
    [[nodiscard]] T& at(std::int32_t x, std::int32_t y) noexcept { return pixels_[offset(x, y)]; }
    [[nodiscard]] const T& at(std::int32_t x, std::int32_t y) const noexcept { return pixels_[offset(x, y)]; }
    [[nodiscard]] std::vector<T>& pixels() noexcept { return pixels_; }
    [[nodiscard]] const std::vector<T>& pixels() const noexcept { return pixels_; }

    friend bool operator==(const Image&, const Image&) = default;

private:
    [[nodiscard]] std::size_t offset(std::int32_t x, std::int32_t y) const noexcept {
        return static_cast<std::size_t>(x) + static_cast<std::size_t>(width_) * static_cast<std::size_t>(y);
    }

    std::int32_t width_ = 0, height_ = 0;
    std::vector<T> pixels_;
};

/// Difference between two images. Both are composited over white first, so the colour of transparent pixels is ignored.
struct ImageDifference {
    /// The larger of `mean` and `worstBlock`, so that small changes everywhere and changes of a small detail both
    /// count:
    ///
    ///     0         Equal, except for the colour of transparent pixels.
    ///     < 0.005   Invisible: rounding, one step of 255.
    ///     < 0.05    Visible only side by side: a border moved by part of a pixel, slightly stronger light.
    ///     < 0.2     Visible: a part moved by a pixel or more, or has another colour.
    ///     <= 1      A different image; 1: black against white in some block, or different sizes.
    double error = 0;
    double mean = 0;              ///< mean over pixels of the largest channel difference, 0..1
    double worstBlock = 0;        ///< largest difference of the mean colours of a block of 8 x 8 pixels, 0..1
    int largest = 0;              ///< largest channel difference of any pixel, 0..255
    std::uint64_t differing = 0;  ///< number of pixels that differ at all
};

/// Compares pixel by pixel and block by block. Images of different sizes have error 1. Cost: O(pixels).
[[nodiscard]] ImageDifference compareImages(const Image<Rgba8>& a, const Image<Rgba8>& b);

}  // namespace svt::image
