#include <svt/volume_readers/formats/label_formats.hpp>

#include <svt/volume/grid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace svt::volume_readers {
namespace {

constexpr std::uint64_t kMaxStrips = 1u << 24;
constexpr std::uint64_t kMaxTiffText = std::uint64_t{1} << 30;
constexpr std::uint64_t kMaxStripBytes = std::uint64_t{1} << 30;

Error badTiff(std::string message) { return Error(Code::BadImage, std::move(message)); }

struct TiffField {
    std::uint64_t count = 0, offset = 0;  ///< number and position of its values
    std::size_t size = 0;                 ///< of a value; 0: unknown type
};

/// One page: its fields by tag, and where the next one begins (0: it is the last).
struct TiffPage {
    std::map<std::uint16_t, TiffField> fields;
    std::uint64_t next = 0;

    [[nodiscard]] std::uint64_t value(FileNumbers& bytes, std::uint16_t tag, std::uint64_t otherwise,
                                      std::uint64_t index = 0) const {
        const auto found = fields.find(tag);
        if (found == fields.end() || index >= found->second.count || found->second.size == 0) return otherwise;
        return bytes.number(found->second.offset + index * found->second.size, found->second.size);
    }
    [[nodiscard]] std::uint64_t count(std::uint16_t tag) const {
        const auto found = fields.find(tag);
        return found == fields.end() ? 0 : found->second.count;
    }
    [[nodiscard]] std::string text(FileNumbers& bytes, std::uint16_t tag) const {
        const auto found = fields.find(tag);
        if (found == fields.end() || found->second.size != 1 || found->second.count > kMaxTiffText) return {};
        const std::string text = bytes.text(found->second.offset, found->second.count);
        return text.substr(0, text.find('\0'));
    }
    [[nodiscard]] double real(FileNumbers& bytes, std::uint16_t tag, std::uint64_t index) const {
        return std::bit_cast<double>(value(bytes, tag, 0, index));
    }
};

TiffPage readPage(FileNumbers& bytes, std::uint64_t offset, bool isWide) {
    constexpr std::array<std::size_t, 19> kSizes{0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};
    const std::size_t wide = isWide ? 8 : 4, entry = isWide ? 20 : 12, countBytes = isWide ? 8 : 2;
    TiffPage page;
    const std::uint64_t count = std::min<std::uint64_t>(bytes.number(offset, countBytes), 4096);
    for (std::uint64_t e = 0; e < count && !bytes.isCut; ++e) {
        const std::uint64_t at = offset + countBytes + e * entry;
        const auto type = static_cast<std::size_t>(bytes.number(at + 2, 2));
        TiffField field;
        field.size = type < kSizes.size() ? kSizes[type] : 0;
        field.count = bytes.number(at + 4, wide);
        const bool isInside = field.size != 0 && field.count <= wide / field.size;
        field.offset = isInside ? at + 4 + wide : bytes.number(at + 4 + wide, wide);
        page.fields[static_cast<std::uint16_t>(bytes.number(at, 2))] = field;
    }
    page.next = bytes.number(offset + countBytes + count * entry, wide);
    return page;
}

struct TiffStack {
    LabelImage image;
    std::vector<ZlibBlock> strips;
    std::uint64_t storedBytes = 0;
    bool isCompressed = false;
};

Result<void> readFirst(FileNumbers& bytes, const TiffPage& page, TiffStack& stack) {
    LabelImage& image = stack.image;
    const std::uint64_t width = page.value(bytes, 256, 0), height = page.value(bytes, 257, 0),
                        compression = page.value(bytes, 259, 1), format = page.value(bytes, 339, 1);
    if (page.fields.count(322) != 0) return badTiff("the TIFF has tiles; save it with strips");
    if (page.value(bytes, 277, 1) != 1) return badTiff("the TIFF has several values per pixel; one is expected");
    if (compression != 1 && compression != 8 && compression != 32946)
        return badTiff(
            fmt::format("compression {} of the TIFF cannot be read; save it raw or with Deflate", compression));
    if (page.value(bytes, 317, 1) != 1) return badTiff("the TIFF has a predictor; save it without");
    if (format != 1 && format != 2)
        return badTiff("the pixels of the TIFF are not whole numbers; save labels as integers");
    if (width > 1u << 30 || height > 1u << 30) return badTiff("the sizes of the TIFF are impossible");
    stack.isCompressed = compression != 1;
    image.bits = static_cast<int>(std::min<std::uint64_t>(page.value(bytes, 258, 1), 64));
    image.isSigned = format == 2;
    image.dimension = {static_cast<std::int32_t>(width), static_cast<std::int32_t>(height), 0};
    if (page.fields.count(34264) != 0) {
        if (page.count(34264) != 16 || page.fields.at(34264).size != 8)
            return badTiff(fmt::format(
                "the matrix of the GeoTIFF (tag 34264) has {} numbers, 16 of 64 bits are expected", page.count(34264)));
        for (std::uint64_t n = 0; n < 16; ++n)
            if (!std::isfinite(page.real(bytes, 34264, n)) ||
                (n >= 12 && page.real(bytes, 34264, n) != (n == 15 ? 1.0 : 0.0)))
                return badTiff(
                    fmt::format("number {} of the matrix of the GeoTIFF (tag 34264) is {}, which no matrix "
                                "has there; write the file again",
                                n, page.real(bytes, 34264, n)));
        for (int row = 0; row < 3; ++row) {
            const auto first = static_cast<std::uint64_t>(4 * row);
            for (std::size_t c = 0; c < 3; ++c) image.steps[c][row] = page.real(bytes, 34264, first + c);
            image.origin[row] = page.real(bytes, 34264, first + 3);
        }
    }
    image.headerJson = page.text(bytes, 65080);
    image.labelsJson = page.text(bytes, 65081);
    image.seal = page.text(bytes, 65082);
    return {};
}

/// \param sizes  the same file, because the sizes of strips are far from their offsets
Result<void> readStrips(FileNumbers& bytes, FileNumbers& sizes, const TiffPage& page, TiffStack& stack) {
    const LabelImage& image = stack.image;
    const auto width = static_cast<std::uint64_t>(image.dimension.x),
               height = static_cast<std::uint64_t>(image.dimension.y);
    if (page.value(bytes, 256, 0) != width || page.value(bytes, 257, 0) != height ||
        page.value(bytes, 258, 1) != static_cast<std::uint64_t>(image.bits) ||
        (page.value(bytes, 259, 1) != 1) != stack.isCompressed || page.fields.count(322) != 0)
        return badTiff(fmt::format("page {} of the TIFF is of another kind than the first", image.dimension.z));
    const std::uint64_t rows =
        std::clamp<std::uint64_t>(page.value(bytes, 278, height), 1, std::max<std::uint64_t>(height, 1));
    const std::uint64_t strips = height == 0 ? 0 : (height + rows - 1) / rows;
    if (page.count(273) != strips || page.count(279) != strips || stack.strips.size() + strips > kMaxStrips)
        return badTiff(fmt::format("page {} of the TIFF has {} strips, {} are expected", image.dimension.z,
                                   page.count(273), strips));
    for (std::uint64_t s = 0; s < strips; ++s) {
        const std::uint64_t offset = page.value(bytes, 273, 0, s), size = page.value(sizes, 279, 0, s);
        const std::uint64_t unpacked =
            std::min(rows, height - s * rows) * width * static_cast<std::uint64_t>(image.bits / 8);
        if (bytes.isCut || sizes.isCut || offset > bytes.fileSize() || size > bytes.fileSize() - offset)
            return badTiff(fmt::format("a strip of page {} of the TIFF lies outside the file: it is cut short",
                                       image.dimension.z));
        if (unpacked > kMaxStripBytes)
            return badTiff("a strip of the TIFF is larger than 1 GiB; save it with smaller ones");
        if (unpacked / 1032 > size || (!stack.isCompressed && size < unpacked))
            return badTiff(fmt::format("a strip of page {} of the TIFF has {} bytes, which cannot hold its {}",
                                       image.dimension.z, size, unpacked));
        stack.strips.push_back({{offset, stack.isCompressed ? size : unpacked}, unpacked});
        stack.storedBytes += size;
    }
    return {};
}

bool looksLikeTiff(std::string_view text) noexcept {
    constexpr std::string_view kMarks[] = {{"II*\0", 4}, {"II+\0", 4}, {"MM\0*", 4}, {"MM\0+", 4}};
    return std::ranges::any_of(kMarks, [&](std::string_view mark) { return text.starts_with(mark); });
}

Result<void> readPages(const SharedFile& file, FileNumbers& bytes, TiffStack& stack, std::endian order) {
    FileNumbers sizes(file, order);
    const bool isWide = bytes.number(2, 2) == 43;
    std::uint64_t offset = isWide ? bytes.number(8, 8) : bytes.number(4, 4);
    // Pages that refer back to earlier ones end at the limit.
    for (; offset != 0; ++stack.image.dimension.z) {
        if (stack.image.dimension.z == volume::Grid::kMaxDimension)
            return badTiff(fmt::format("the TIFF has more than {} pages", volume::Grid::kMaxDimension));
        const TiffPage page = readPage(bytes, offset, isWide);
        if (bytes.isCut) return badTiff(fmt::format("page {} of the TIFF is cut short", stack.image.dimension.z));
        if (stack.image.dimension.z == 0) SVT_DO(readFirst(bytes, page, stack));
        if (stack.image.bits != 8 && stack.image.bits != 16 && stack.image.bits != 32)
            break;  // checkImage() reports it
        SVT_DO(readStrips(bytes, sizes, page, stack));
        offset = page.next;
    }
    return {};
}

// TIFF and BigTIFF, a page for each slice.
Result<LabelImage> openTiff(const SharedFile& file) {
    const bool isBigEndian = file->head(2) == "MM";
    const std::endian order = isBigEndian ? std::endian::big : std::endian::little;
    FileNumbers bytes(file, order);
    TiffStack stack;
    if (const auto done = readPages(file, bytes, stack, order); !done) return bytes.fault(done.error());
    stack.image.isSwapped = isBigEndian;
    SVT_DO(checkImage(stack.image, stack.storedBytes, stack.isCompressed, Code::BadImage));
    stack.image.read = zlibSamples(file, std::move(stack.strips), stack.isCompressed, Code::BadImage);
    return std::move(stack.image);
}

}  // namespace

extern const LabelFormat kTiff{.name = "tiff",
                               .endings = ".tif|.tiff",
                               .holds = "TIFF and BigTIFF, a page for each slice, raw or Deflate",
                               .looksLike = [](const auto& file, const auto&) { return looksLikeTiff(file->head(4)); },
                               .open = [](const auto& file, const auto&, std::uint64_t) { return openTiff(file); }};

}  // namespace svt::volume_readers
