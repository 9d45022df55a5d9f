#include <svt/core/file.hpp>
#include <svt/image/png.hpp>
#include <svt/voxelize/patterns.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace svt::voxelize {
namespace {

constexpr std::int32_t kLargestImage = 4096;
constexpr std::int32_t kLargestRaw = 1024;
constexpr std::size_t kMaxPhases = 64;

using Pixel = std::array<std::uint8_t, 3>;

Error badImage(const std::filesystem::path& file, std::string what) {
    return Error(Code::BadImage, std::move(what), {file.string(), 0, 0, {}});
}

// A box of the median cut algorithm: pixels [begin, end) of an index list.
struct ColorBox {
    std::size_t begin, end;
};

// The channel with the largest spread in the box, and that spread.
std::pair<std::size_t, int> widestChannel(const std::vector<Pixel>& colors, const std::vector<std::uint32_t>& order,
                                          const ColorBox& box) {
    std::pair<std::size_t, int> widest{0, 0};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        int low = 255, high = 0;
        for (std::size_t i = box.begin; i < box.end; ++i) {
            low = std::min<int>(low, colors[order[i]][channel]);
            high = std::max<int>(high, colors[order[i]][channel]);
        }
        if (high - low > widest.second) widest = {channel, high - low};
    }
    return widest;
}

// Median cut (Heckbert 1982): splits the widest box at its median until there are enough boxes.
void medianCut(const std::vector<Pixel>& colors, std::size_t wanted, PatternTexels& texels) {
    std::vector<std::uint32_t> order(colors.size());
    std::iota(order.begin(), order.end(), 0u);
    std::vector<ColorBox> boxes{{0, colors.size()}};
    while (boxes.size() < wanted) {
        std::size_t best = 0;
        int spread = 0;
        for (std::size_t b = 0; b < boxes.size(); ++b)
            if (const int s = widestChannel(colors, order, boxes[b]).second; s > spread) {
                spread = s;
                best = b;
            }
        if (spread == 0) break;
        const ColorBox box = boxes[best];
        const std::size_t channel = widestChannel(colors, order, box).first;
        std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(box.begin),
                         order.begin() + static_cast<std::ptrdiff_t>(box.end),
                         [&](std::uint32_t a, std::uint32_t b) { return colors[a][channel] < colors[b][channel]; });
        // Equal values stay together: move the cut to the next change of the channel value.
        std::size_t cut = (box.begin + box.end) / 2;
        while (cut < box.end && colors[order[cut]][channel] == colors[order[cut - 1]][channel]) ++cut;
        if (cut == box.end) {
            cut = (box.begin + box.end) / 2;
            while (cut > box.begin && colors[order[cut]][channel] == colors[order[cut - 1]][channel]) --cut;
        }
        boxes[best] = {box.begin, cut};
        boxes.push_back({cut, box.end});
    }
    texels.phases.resize(colors.size());
    texels.phaseCount = static_cast<std::uint32_t>(boxes.size());
    for (std::size_t b = 0; b < boxes.size(); ++b) {
        std::array<std::uint64_t, 3> sum{};
        for (std::size_t i = boxes[b].begin; i < boxes[b].end; ++i) {
            texels.phases[order[i]] = static_cast<std::uint8_t>(b);
            for (std::size_t channel = 0; channel < 3; ++channel) sum[channel] += colors[order[i]][channel];
        }
        const auto count = static_cast<float>(boxes[b].end - boxes[b].begin) * 255.0f;
        texels.colors.push_back({float(sum[0]) / count, float(sum[1]) / count, float(sum[2]) / count});
    }
}

}  // namespace

Result<std::shared_ptr<const PatternTexels>> readPatternImage(const std::filesystem::path& file, int maxColors) {
    if (maxColors < 2 || maxColors > static_cast<int>(kMaxPhases))
        return Error(Code::BadArgument,
                     fmt::format("{} colours are out of range; 2 to {} are possible", maxColors, kMaxPhases));
    SVT_TRY(image, image::readPng(file, kLargestImage));
    auto texels = std::make_shared<PatternTexels>();
    texels->dimension = {image->width(), image->height(), 1};
    std::vector<Pixel> colors;
    colors.reserve(image->pixels().size());
    // PNG rows run top down, texels bottom up.
    for (std::int32_t y = image->height() - 1; y >= 0; --y)
        for (std::int32_t x = 0; x < image->width(); ++x) {
            const image::Rgba8 pixel = image->at(x, y);
            // Transparent pixels show black behind them.
            const auto over = [&](std::uint8_t channel) { return static_cast<std::uint8_t>(channel * pixel.a / 255); };
            colors.push_back({over(pixel.r), over(pixel.g), over(pixel.b)});
        }
    medianCut(colors, static_cast<std::size_t>(maxColors), *texels);
    return std::shared_ptr<const PatternTexels>(std::move(texels));
}

Result<std::shared_ptr<const PatternTexels>> readPatternRaw(const std::filesystem::path& file, Vec3i dimension) {
    for (int axis = 0; axis < 3; ++axis)
        if (dimension[axis] < 1 || dimension[axis] > kLargestRaw)
            return badImage(file, fmt::format("dimension {} is out of range; 1 to {} cells along an axis are possible",
                                              dimension[axis], kLargestRaw));
    SVT_TRY(mapped, FileBytes::read(file));
    const std::size_t expected = std::size_t(dimension.x) * std::size_t(dimension.y) * std::size_t(dimension.z);
    if (mapped->bytes().size() != expected)
        return badImage(file, fmt::format("{} bytes found, {} x {} x {} = {} expected", mapped->bytes().size(),
                                          dimension.x, dimension.y, dimension.z, expected));
    std::array<bool, 256> isUsed{};
    for (const std::byte byte : mapped->bytes()) isUsed[std::to_integer<std::size_t>(byte)] = true;
    std::array<std::uint8_t, 256> phase{};
    std::size_t count = 0;
    for (std::size_t value = 0; value < 256; ++value)
        if (isUsed[value]) phase[value] = static_cast<std::uint8_t>(count++);
    if (count > kMaxPhases)
        return badImage(file, fmt::format("{} different values found; {} are possible", count, kMaxPhases));
    auto texels = std::make_shared<PatternTexels>();
    texels->dimension = dimension;
    texels->phaseCount = static_cast<std::uint32_t>(count);
    texels->phases.reserve(expected);
    for (const std::byte byte : mapped->bytes()) texels->phases.push_back(phase[std::to_integer<std::size_t>(byte)]);
    return std::shared_ptr<const PatternTexels>(std::move(texels));
}

}  // namespace svt::voxelize
