#include <bench/compare.hpp>

#include <svt/image/color.hpp>
#include <svt/volume/dense.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace svt::bench {
namespace {

constexpr std::uint32_t kSteps = 9;                               // per channel
constexpr std::uint32_t kLabelColors = kSteps * kSteps * kSteps;  // including black
constexpr double kStepSize = 28;

std::array<std::uint32_t, 3> digitsOf(std::uint32_t scalar) {
    constexpr std::uint32_t kSpread = 275;  // coprime to 728: neighbours get different colors
    const std::uint32_t number = scalar == 0 ? 0 : 1 + (scalar - 1) % (kLabelColors - 1) * kSpread % (kLabelColors - 1);
    return {number % kSteps, number / kSteps % kSteps, number / kSteps / kSteps};
}

std::uint32_t digitOf(std::uint8_t channel) {
    return std::min(kSteps - 1, static_cast<std::uint32_t>(std::lround(channel / kStepSize)));
}

}  // namespace

double VoxelComparison::differingPercent() const {
    return filledOurs == 0 ? 0 : 100 * double(differing - differingOnBorder) / double(filledOurs);
}

VoxelComparison compareVoxels(const volume::ColumnVolume& ours, const DenseLabels& theirs) {
    constexpr std::int32_t kSlab = 32;
    const Vec3i n = ours.dimension();
    const std::size_t layer = static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y);
    std::vector<std::uint16_t> slab;
    VoxelComparison result;
    for (std::int32_t k = 0; k < n.z; k += kSlab) {
        const std::int32_t kEnd = std::min(n.z, k + kSlab);
        slab.resize(layer * static_cast<std::size_t>(kEnd - k));
        volume::copyBox<std::uint16_t>(ours, {0, n.y, k, kEnd}, slab);
        const std::uint16_t* other = theirs.scalars.data() + layer * static_cast<std::size_t>(k);
        std::size_t v = 0;
        for (std::int32_t slabK = k; slabK < kEnd; ++slabK)
            for (std::int32_t j = 0; j < n.y; ++j)
                for (std::int32_t i = 0; i < n.x; ++i, ++v) {
                    result.filledOurs += slab[v] != 0;
                    result.filledTheirs += other[v] != 0;
                    if (slab[v] == other[v]) continue;
                    const bool isBorder =
                        i == 0 || j == 0 || slabK == 0 || i == n.x - 1 || j == n.y - 1 || slabK == n.z - 1;
                    ++result.differing;
                    result.differingOnBorder += isBorder;
                }
    }
    return result;
}

Vec3f labelColor(std::uint32_t scalar) {
    const auto digits = digitsOf(scalar);
    const auto channel = [&](std::size_t c) { return static_cast<float>(digits[c] * kStepSize / 255); };
    return {channel(0), channel(1), channel(2)};
}

double agreeingShare(const image::Image<volume::Scalar>& ours, const image::Image<image::Rgba8>& theirs) {
    std::uint64_t shown = 0, agreeing = 0;
    for (std::int32_t y = 0; y < ours.height(); ++y)
        for (std::int32_t x = 0; x < ours.width(); ++x) {
            const volume::Scalar scalar = ours.at(x, y);
            const image::Rgba8 pixel = theirs.at(x, y);
            const std::array<std::uint32_t, 3> seen{digitOf(pixel.r), digitOf(pixel.g), digitOf(pixel.b)};
            const bool isShown = scalar != 0 || seen != std::array<std::uint32_t, 3>{};
            shown += isShown;
            agreeing += isShown && seen == digitsOf(scalar);
        }
    return shown == 0 ? 0 : double(agreeing) / double(shown);
}

ColorComparison compareColors(const image::Image<image::Rgba8>& ours, const image::Image<image::Rgba8>& theirs) {
    ColorComparison result;
    std::uint64_t over2 = 0, over8 = 0;
    for (std::size_t p = 0; p < ours.pixels().size(); ++p) {
        const image::Rgba8 a = ours.pixels()[p], b = theirs.pixels()[p];
        if ((a.r | a.g | a.b | b.r | b.g | b.b) == 0) continue;
        const std::array<int, 3> difference{std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)};
        for (std::size_t c = 0; c < 3; ++c) result.mean[c] += difference[c];
        const int most = *std::max_element(difference.begin(), difference.end());
        result.largest = std::max(result.largest, most);
        over2 += most > 2;
        over8 += most > 8;
        ++result.pixels;
    }
    if (result.pixels == 0) return result;
    for (double& mean : result.mean) mean /= double(result.pixels);
    result.over2 = double(over2) / double(result.pixels);
    result.over8 = double(over8) / double(result.pixels);
    return result;
}

image::Image<image::Rgba8> flatPicture(const image::Image<volume::Scalar>& labels,
                                       std::span<const render::Style> styles) {
    const auto byte = [](float channel) { return static_cast<std::uint8_t>(std::lround(255 * channel)); };
    image::Image<image::Rgba8> picture(labels.width(), labels.height(), {0, 0, 0, 255});
    for (std::size_t p = 0; p < labels.pixels().size(); ++p) {
        const volume::Scalar scalar = labels.pixels()[p];
        if (scalar == 0 || scalar >= styles.size()) continue;
        const Vec3f color = styles[scalar].color;
        picture.pixels()[p] = {byte(color.x), byte(color.y), byte(color.z), 255};
    }
    return picture;
}

image::Image<image::Rgba8> linearPicture(const image::Image<image::Rgba8>& picture, float factor) {
    std::array<std::uint8_t, 256> linear{};
    for (std::size_t level = 0; level < linear.size(); ++level) {
        const float light = factor * image::linearFromSrgb(static_cast<float>(level) / 255);
        linear[level] = static_cast<std::uint8_t>(std::lround(255 * std::min(1.0f, light)));
    }
    image::Image<image::Rgba8> result = picture;
    for (image::Rgba8& pixel : result.pixels()) pixel = {linear[pixel.r], linear[pixel.g], linear[pixel.b], 255};
    return result;
}

}  // namespace svt::bench
