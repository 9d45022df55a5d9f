#include <svt/image/image.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace svt::image {
namespace {

constexpr std::int32_t kBlock = 8;

// A pixel composited over white, 0..255 * 255.
std::array<int, 3> overWhite(Rgba8 pixel) noexcept {
    const auto blend = [&](int channel) { return channel * pixel.a + 255 * (255 - pixel.a); };
    return {blend(pixel.r), blend(pixel.g), blend(pixel.b)};
}

}  // namespace

ImageDifference compareImages(const Image<Rgba8>& a, const Image<Rgba8>& b) {
    ImageDifference result;
    if (a.width() != b.width() || a.height() != b.height()) {
        result.error = result.mean = result.worstBlock = 1;
        result.largest = 255;
        result.differing = std::max(a.pixels().size(), b.pixels().size());
        return result;
    }
    if (a.pixels().empty()) return result;
    constexpr double kScale = 1.0 / (255.0 * 255.0);
    double sum = 0;
    for (std::int32_t blockY = 0; blockY < a.height(); blockY += kBlock)
        for (std::int32_t blockX = 0; blockX < a.width(); blockX += kBlock) {
            std::array<double, 3> signedSum{};
            std::int32_t pixels = 0;
            for (std::int32_t y = blockY; y < std::min(blockY + kBlock, a.height()); ++y)
                for (std::int32_t x = blockX; x < std::min(blockX + kBlock, a.width()); ++x, ++pixels) {
                    const auto p = overWhite(a.at(x, y)), q = overWhite(b.at(x, y));
                    int most = 0;
                    for (std::size_t channel = 0; channel < 3; ++channel) {
                        most = std::max(most, std::abs(p[channel] - q[channel]));
                        signedSum[channel] += p[channel] - q[channel];
                    }
                    sum += most * kScale;
                    result.largest = std::max(result.largest, (most + 127) / 255);
                    result.differing += a.at(x, y) != b.at(x, y);
                }
            for (const double channel : signedSum)
                result.worstBlock = std::max(result.worstBlock, std::abs(channel) * kScale / pixels);
        }
    result.mean = sum / static_cast<double>(a.pixels().size());
    result.error = std::max(result.mean, result.worstBlock);
    return result;
}

}  // namespace svt::image
