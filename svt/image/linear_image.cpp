#include <svt/image/linear_image.hpp>

#include <svt/image/color.hpp>
#include <svt/image/jpeg.hpp>
#include <svt/image/png.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::image {
namespace {

using std::string_view;

constexpr string_view kPngStart = "\x89PNG\r\n\x1A\n";

// Linear light of each byte, 0..65535.
const std::array<std::uint16_t, 256>& linearBytes() {
    static const auto kTable = [] {
        std::array<std::uint16_t, 256> table{};
        for (std::size_t i = 0; i < table.size(); ++i)
            table[i] = static_cast<std::uint16_t>(std::lround(linearFromSrgb(static_cast<float>(i) / 255) * 65535));
        return table;
    }();
    return kTable;
}

// Adds rows of pixels up to means of blocks. Whole numbers, so that the means do not depend on any order.
class BlockMeans {
public:
    void begin(std::int32_t width, std::int32_t height) {
        result_.width = width;
        result_.height = height;
        side_ = std::max((std::max(width, height) + kMaxLinearSize - 1) / kMaxLinearSize, 1);
        result_.pixels = Image<LinearPixel>((width + side_ - 1) / side_, (height + side_ - 1) / side_);
        sums_.assign(static_cast<std::size_t>(result_.pixels.width()), {});
    }

    // \param channels  bytes per pixel: 3 or 4, the last one alpha
    void add(std::int32_t y, const std::uint8_t* pixel, std::size_t channels) {
        const auto& linear = linearBytes();
        std::size_t block = 0;
        for (std::int32_t x = 0, inBlock = 0; x < result_.width; ++x, pixel += channels) {
            const std::uint64_t alpha = channels == 4 ? pixel[3] : 255;
            std::array<std::uint64_t, 4>& sum = sums_[block];
            for (std::size_t c = 0; c < 3; ++c) sum[c] += linear[pixel[c]] * alpha;
            sum[3] += alpha;
            if (++inBlock == side_) inBlock = 0, ++block;
        }
        if ((y + 1) % side_ == 0 || y + 1 == result_.height) finishBlocks(y / side_, y % side_ + 1);
    }

    LinearImage take() { return std::move(result_); }

private:
    void finishBlocks(std::int32_t y, std::int32_t rows) {
        for (std::int32_t x = 0; x < result_.pixels.width(); ++x) {
            const std::int32_t columns = std::min(side_, result_.width - x * side_);
            const std::uint64_t count = static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows);
            std::array<std::uint64_t, 4>& sum = sums_[static_cast<std::size_t>(x)];
            const auto mean = [&](std::uint64_t total) {
                return static_cast<std::uint16_t>((total + 255 * count / 2) / (255 * count));
            };
            result_.pixels.at(x, y) = {mean(sum[0]), mean(sum[1]), mean(sum[2]), mean(sum[3] * 65535)};
            sum = {};
        }
    }

    LinearImage result_;
    std::int32_t side_ = 1;
    std::vector<std::array<std::uint64_t, 4>> sums_;  // of the current row of blocks: colours times alpha, alpha
};

string_view asChars(std::span<const std::byte> bytes) noexcept {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// The kind of an image that is neither a PNG nor a JPEG.
string_view kindOf(string_view bytes) noexcept {
    constexpr std::pair<string_view, string_view> kKinds[] = {{"GIF8", "a GIF"},
                                                              {"BM", "a BMP"},
                                                              {string_view("II*\0", 4), "a TIFF"},
                                                              {"DDS ", "a DDS"},
                                                              {"\xFF\x4F\xFF\x51", "a JPEG 2000"},
                                                              {string_view("MM\0*", 4), "a TIFF"},
                                                              {string_view("\0\0\0\x0CjP  ", 8), "a JPEG 2000"}};
    for (const auto& [start, kind] : kKinds)
        if (bytes.starts_with(start)) return kind;
    if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "a WebP";
    return "not an image that is known";
}

}  // namespace

std::uint64_t pngPixels(std::span<const std::byte> bytes) noexcept {
    if (!asChars(bytes).starts_with(kPngStart) || bytes.size() < 24) return 0;
    const auto number = [&](std::size_t at) {
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<std::uint64_t>(bytes[at + i]);
        return value;
    };
    return number(16) * number(20);
}

Result<LinearImage> decodeLinear(std::span<const std::byte> bytes) {
    BlockMeans means;
    if (asChars(bytes).starts_with("\xFF\xD8\xFF")) {
        const JpegRows rows{[&](std::int32_t width, std::int32_t height) { means.begin(width, height); },
                            [&](std::int32_t y, std::span<const std::uint8_t> rgb) { means.add(y, rgb.data(), 3); }};
        SVT_DO(decodeJpeg(bytes, kMaxLinearSource, rows));
        return means.take();
    }
    if (!asChars(bytes).starts_with(kPngStart))
        return Error(Code::BadImage, fmt::format("this is {}; save it as a PNG or JPEG",
                                                 bytes.empty() ? "empty" : kindOf(asChars(bytes))));
    if (const std::uint64_t pixels = pngPixels(bytes); pixels > kMaxLinearSource)
        return Error(Code::BadImage, fmt::format("the PNG has {} pixels, more than {}", pixels, kMaxLinearSource));
    SVT_TRY(image, decodePng(bytes, 1 << 24));
    means.begin(image->width(), image->height());
    for (std::int32_t y = 0; y < image->height(); ++y) means.add(y, &image->at(0, y).r, 4);
    return means.take();
}

}  // namespace svt::image
