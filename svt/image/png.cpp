#include <svt/core/file.hpp>
#include <svt/image/png.hpp>

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <string>

namespace svt::image {
namespace {

// State of libpng's callbacks. libpng reports errors by longjmp, so owners of memory must live outside the functions
// that call it.
struct Stream {
    std::vector<std::byte> written;
    std::span<const std::byte> rest;
    std::string message;
    bool isOutOfMemory = false;
};

void onError(png_structp png, png_const_charp message) {
    static_cast<Stream*>(png_get_error_ptr(png))->message = message;
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

void onWrite(png_structp png, png_bytep bytes, std::size_t count) {
    auto* stream = static_cast<Stream*>(png_get_io_ptr(png));
    try {  // no exception may pass through libpng
        const auto* first = reinterpret_cast<const std::byte*>(bytes);
        stream->written.insert(stream->written.end(), first, first + count);
        return;
    } catch (const std::bad_alloc&) {
        stream->isOutOfMemory = true;
    }
    png_error(png, "out of memory");
}

void onFlush(png_structp) {}

void onRead(png_structp png, png_bytep bytes, std::size_t count) {
    auto* stream = static_cast<Stream*>(png_get_io_ptr(png));
    if (stream->rest.size() < count) png_error(png, "the file ends too early");
    std::memcpy(bytes, stream->rest.data(), count);
    stream->rest = stream->rest.subspan(count);
}

struct Pixels {
    std::int32_t width, height;
    const void* data;
    std::size_t rowBytes;
    int bits, colorType;
    int dpi;  // 0: none
};

bool write(Stream& stream, const Pixels& pixels) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &stream, onError, onWarning);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    if (info == nullptr || setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return false;
    }
    png_set_write_fn(png, &stream, onWrite, onFlush);
    // Images with flat colours gain little from the slow levels.
    png_set_compression_level(png, 5);
    png_set_IHDR(png, info, static_cast<png_uint_32>(pixels.width), static_cast<png_uint_32>(pixels.height),
                 pixels.bits, pixels.colorType, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (pixels.bits == 8) png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    const auto perMetre = static_cast<png_uint_32>(pixels.dpi / 0.0254 + 0.5);
    if (pixels.dpi > 0) png_set_pHYs(png, info, perMetre, perMetre, PNG_RESOLUTION_METER);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_write_info(png, info);
    if (pixels.bits == 16 && std::endian::native == std::endian::little) png_set_swap(png);
    const auto* row = static_cast<const png_byte*>(pixels.data);
    for (std::int32_t y = 0; y < pixels.height; ++y, row += pixels.rowBytes) png_write_row(png, row);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return true;
}

Result<std::vector<std::byte>> encode(const Pixels& pixels) {
    if (pixels.width < 1 || pixels.height < 1 || pixels.width > kMaxPngSize || pixels.height > kMaxPngSize)
        return Error(Code::BadImage, fmt::format("a PNG of {} x {} pixels is out of range; 1 to {} are possible",
                                                 pixels.width, pixels.height, kMaxPngSize));
    Stream stream;
    if (write(stream, pixels)) return std::move(stream.written);
    if (stream.isOutOfMemory) throw std::bad_alloc();
    return Error(Code::BadImage, fmt::format("the PNG cannot be made: {}", stream.message));
}

// The pixel format that a reader wants, and its images, allocated once the size is known.
struct Target {
    bool wantsGray16;
    std::int32_t maxSize = kMaxPngSize;
    Image<Rgba8> color{};
    Image<std::uint16_t> gray{};
    std::vector<png_bytep> rows{};
};

// Allocates the target's image; if that is impossible, the stream's message says why.
bool allocate(Stream& stream, Target& target, png_uint_32 width, png_uint_32 height) {
    try {
        stream.message =
            fmt::format("{} x {} pixels are over the limit of {} x {}", width, height, target.maxSize, target.maxSize);
        const auto limit = static_cast<png_uint_32>(target.maxSize);
        if (width > limit || height > limit) return false;
        stream.message = "out of memory";
        const auto w = static_cast<std::int32_t>(width), h = static_cast<std::int32_t>(height);
        if (target.wantsGray16)
            target.gray = Image<std::uint16_t>(w, h);
        else
            target.color = Image<Rgba8>(w, h);
        for (std::int32_t y = 0; y < h; ++y)
            target.rows.push_back(target.wantsGray16 ? reinterpret_cast<png_bytep>(&target.gray.at(0, y))
                                                     : reinterpret_cast<png_bytep>(&target.color.at(0, y)));
        return true;
    } catch (const std::bad_alloc&) {
        return false;
    }
}

bool read(Stream& stream, Target& target) {
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &stream, onError, onWarning);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    if (info == nullptr || setjmp(png_jmpbuf(png))) {
        png_destroy_read_struct(&png, &info, nullptr);
        return false;
    }
    png_set_read_fn(png, &stream, onRead);
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // allocate() checks the limit
    png_set_chunk_malloc_max(png, 16u << 20);
    png_read_info(png, info);
    const bool isGray16 = png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY && png_get_bit_depth(png, info) == 16;
    if (target.wantsGray16) {
        if (!isGray16) png_error(png, "not 16 bits gray");
        if (std::endian::native == std::endian::little) png_set_swap(png);
    } else {
        png_set_expand(png);
        png_set_strip_16(png);
        png_set_gray_to_rgb(png);
        png_set_add_alpha(png, 0xFF, PNG_FILLER_AFTER);
        png_set_alpha_mode(png, PNG_ALPHA_PNG, PNG_DEFAULT_sRGB);
    }
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    if (!allocate(stream, target, png_get_image_width(png, info), png_get_image_height(png, info))) png_longjmp(png, 1);
    png_read_image(png, target.rows.data());
    png_read_end(png, nullptr);
    png_destroy_read_struct(&png, &info, nullptr);
    return true;
}

Result<void> decode(std::span<const std::byte> bytes, Target& target) {
    if (bytes.size() < 8 || png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, 8) != 0)
        return Error(Code::BadImage, "this is not a PNG; save the image as one");
    Stream stream;
    stream.rest = bytes;
    if (read(stream, target)) return {};
    return Error(Code::BadImage, fmt::format("the PNG cannot be read: {}", stream.message));
}

Result<void> writeBytes(const std::filesystem::path& path, const Result<std::vector<std::byte>>& bytes) {
    if (!bytes) return bytes.error();
    SVT_TRY(written, writeFileAtomically(path, std::span<const std::byte>(*bytes)));
    return {};
}

Result<void> readFile(const std::filesystem::path& path, Target& target) {
    SVT_TRY(file, FileBytes::read(path));
    if (auto decoded = decode(file->bytes(), target); !decoded)
        return Error(decoded.error().code(), decoded.error().message(), Place{path.string(), 0, 0, {}});
    return {};
}

}  // namespace

Result<std::vector<std::byte>> encodePng(const Image<Rgba8>& image, int dpi) {
    static_assert(sizeof(Rgba8) == 4);
    return encode({image.width(), image.height(), image.pixels().data(), 4 * static_cast<std::size_t>(image.width()), 8,
                   PNG_COLOR_TYPE_RGB_ALPHA, dpi});
}

Result<std::vector<std::byte>> encodePng(const Image<std::uint16_t>& image) {
    return encode({image.width(), image.height(), image.pixels().data(), 2 * static_cast<std::size_t>(image.width()),
                   16, PNG_COLOR_TYPE_GRAY, 0});
}

Result<void> writePng(const std::filesystem::path& path, const Image<Rgba8>& image, int dpi) {
    return writeBytes(path, encodePng(image, dpi));
}

Result<void> writePng(const std::filesystem::path& path, const Image<std::uint16_t>& image) {
    return writeBytes(path, encodePng(image));
}

Result<Image<Rgba8>> decodePng(std::span<const std::byte> bytes, std::int32_t maxSize) {
    Target target{false, maxSize};
    SVT_DO(decode(bytes, target));
    return std::move(target.color);
}

Result<Image<Rgba8>> readPng(const std::filesystem::path& path, std::int32_t maxSize) {
    Target target{false, maxSize};
    SVT_DO(readFile(path, target));
    return std::move(target.color);
}

Result<Image<std::uint16_t>> readGrayPng(const std::filesystem::path& path) {
    Target target{true};
    SVT_DO(readFile(path, target));
    return std::move(target.gray);
}

}  // namespace svt::image
