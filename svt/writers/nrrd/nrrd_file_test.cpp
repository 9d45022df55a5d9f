#include <svt/core/deflate.hpp>
#include <svt/core/file.hpp>
#include <svt/writers/nrrd/nrrd_file_test.hpp>

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <new>
#include <utility>

namespace svt::writers {
namespace {

constexpr std::uint64_t kMaxSamplesPerAxis = 1u << 30;
/// Maximum compression ratio of deflate; a header that claims more is invalid.
constexpr std::uint64_t kMaxGzipRatio = 1032;

Error bad(std::string message) { return Error(Code::BadNrrd, std::move(message)); }

std::string_view trimmed(std::string_view text) noexcept {
    constexpr std::string_view kBlank = " \t\r";
    const std::size_t begin = text.find_first_not_of(kBlank);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

/// Header fields that determine how the data are read.
struct Header {
    NrrdImage image;
    std::string encoding;
    std::string endian;
    bool hasDimension = false;
    bool hasSizes = false;
    std::size_t dataOffset = 0;
};

std::string unescaped(std::string_view value) {
    std::string text;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const bool isEscape = value[i] == '\\' && i + 1 < value.size() && (value[i + 1] == '\\' || value[i + 1] == 'n');
        text += !isEscape ? value[i] : value[++i] == 'n' ? '\n' : '\\';
    }
    return text;
}

int bitsOfType(std::string_view type) noexcept {
    for (const std::string_view name : {"uchar", "unsigned char", "uint8", "uint8_t"})
        if (type == name) return 8;
    for (const std::string_view name : {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"})
        if (type == name) return 16;
    for (const std::string_view name : {"uint", "unsigned int", "uint32", "uint32_t"})
        if (type == name) return 32;
    return 0;
}

/// Removes and returns the next number of `text`; separators are blanks, commas and parentheses.
template <class T>
bool takeNumber(std::string_view& text, T& number) noexcept {
    const std::size_t begin = text.find_first_not_of(" \t,()");
    if (begin == std::string_view::npos) return false;
    const auto [end, error] = std::from_chars(text.data() + begin, text.data() + text.size(), number);
    if (error != std::errc()) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return true;
}

bool takeVector(std::string_view& text, Vec3d& v) noexcept {
    return takeNumber(text, v.x) && takeNumber(text, v.y) && takeNumber(text, v.z) && isFinite(v);
}

/// Reads one `field: value`. Irrelevant fields are skipped.
Result<void> readField(Header& header, std::string_view field, std::string_view value) {
    if (field == "type") {
        header.image.bits = bitsOfType(value);
        if (header.image.bits == 0)
            return bad(fmt::format("type '{}' cannot be read; unsigned 8, 16 or 32 bit samples are expected", value));
    } else if (field == "dimension") {
        if (value != "3") return bad(fmt::format("the image has {} axes, 3 are expected", value));
        header.hasDimension = true;
    } else if (field == "sizes") {
        std::string_view rest = value;
        for (int axis = 0; axis < 3; ++axis) {
            std::uint64_t size = 0;
            if (!takeNumber(rest, size) || size < 1 || size > kMaxSamplesPerAxis)
                return bad(fmt::format("sizes '{}' are not three numbers from 1 to {}", value, kMaxSamplesPerAxis));
            header.image.dimension[axis] = static_cast<std::int32_t>(size);
        }
        if (!trimmed(rest).empty()) return bad(fmt::format("sizes '{}' are more than three numbers", value));
        header.hasSizes = true;
    } else if (field == "encoding") {
        header.encoding = value == "gz" ? "gzip" : value;
    } else if (field == "endian") {
        header.endian = value;
    } else if (field == "space origin") {
        std::string_view rest = value;
        if (!takeVector(rest, header.image.origin)) return bad(fmt::format("space origin '{}' is no vector", value));
    } else if (field == "space directions") {
        std::string_view rest = value;
        for (Vec3d& direction : header.image.directions)
            if (!takeVector(rest, direction))
                return bad(fmt::format("space directions '{}' are not three vectors", value));
    } else if (field == "spacings") {
        std::string_view rest = value;
        for (int axis = 0; axis < 3; ++axis)
            if (!takeNumber(rest, header.image.directions[static_cast<std::size_t>(axis)][axis]))
                return bad(fmt::format("spacings '{}' are not three numbers", value));
    } else if (field == "data file" || field == "datafile") {
        return bad("the samples stand in another file, which is not followed; save the image as one attached .nrrd");
    } else if ((field == "line skip" || field == "lineskip" || field == "byte skip" || field == "byteskip") &&
               value != "0") {
        return bad(fmt::format("'{}' is not supported; save the image as a plain attached .nrrd", field));
    }
    return {};
}

Result<Header> readHeader(std::string_view text) {
    if (!text.starts_with("NRRD000") || text.size() < 9 || text[7] < '1' || text[7] > '5')
        return bad("the file does not begin with NRRD0001 to NRRD0005");
    Header header;
    bool isFirst = true;
    for (std::size_t at = 0;;) {
        const std::size_t end = text.find('\n', at);
        if (end == std::string_view::npos)
            return bad("the header does not end with an empty line: the file is cut short");
        std::string_view line = text.substr(at, end - at);
        if (line.ends_with('\r')) line.remove_suffix(1);
        at = end + 1;
        if (line.empty()) {
            header.dataOffset = at;
            break;
        }
        if (std::exchange(isFirst, false) || line.front() == '#') continue;
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos)
            return bad(fmt::format("header line '{}' has no colon", line.substr(0, 80)));
        if (line.substr(colon).starts_with(":=")) {
            header.image.keyValues.emplace_back(unescaped(line.substr(0, colon)), unescaped(line.substr(colon + 2)));
            continue;
        }
        SVT_DO(readField(header, trimmed(line.substr(0, colon)), trimmed(line.substr(colon + 1))));
    }
    if (!header.hasDimension || !header.hasSizes || header.image.bits == 0 || header.encoding.empty())
        return bad("one of the fields type, dimension, sizes and encoding is missing");
    if (header.encoding != "raw" && header.encoding != "gzip")
        return bad(fmt::format("encoding '{}' cannot be read; save the image as raw or gzip", header.encoding));
    if (header.image.bits > 8 && header.endian != "little" && header.endian != "big")
        return bad("the field endian is missing or neither little nor big");
    return header;
}

Result<NrrdImage> readImage(std::span<const std::byte> bytes, std::string_view text, const NrrdReadOptions& options) {
    SVT_TRY(header, readHeader(text));
    NrrdImage& image = header->image;
    const std::span<const std::byte> stored = bytes.subspan(header->dataOffset);
    // Two sizes of 2^30 and a sample of 4 bytes fit into 64 bits; the third is checked before multiplication.
    const std::uint64_t slice = std::uint64_t(image.dimension.x) * std::uint64_t(image.dimension.y) *
                                (static_cast<std::uint64_t>(image.bits) / 8);
    const auto slices = static_cast<std::uint64_t>(image.dimension.z);
    if (slice > options.maxDataBytes / slices)
        return Error(Code::InputTooBig,
                     fmt::format("{} x {} x {} samples of {} bits are over the limit of {} bytes", image.dimension.x,
                                 image.dimension.y, image.dimension.z, image.bits, options.maxDataBytes));
    const std::uint64_t size = slice * slices;
    if (header->encoding == "raw" && stored.size() != size)
        return bad(fmt::format("{} bytes of samples found, {} expected", stored.size(), size));
    if (header->encoding == "gzip" && size / kMaxGzipRatio > stored.size())
        return bad(fmt::format("{} bytes of compressed samples cannot hold the {} bytes that the sizes say",
                               stored.size(), size));
    if (header->encoding == "raw") {
        image.data.assign(stored.begin(), stored.end());
    } else {
        Inflated unpacked = inflateBytes(stored, DeflateFormat::Gzip, size, size);
        if (unpacked.status == InflateStatus::TooLong) return bad("the compressed samples are more than the sizes say");
        if (unpacked.status != InflateStatus::Done || unpacked.taken != stored.size())
            return bad("the compressed samples are damaged or cut short");
        if (unpacked.bytes.size() != size)
            return bad(fmt::format("the compressed samples are {} bytes fewer than the sizes say",
                                   size - unpacked.bytes.size()));
        image.data = std::move(unpacked.bytes);
    }
    constexpr bool kIsLittle = std::endian::native == std::endian::little;
    if (image.bits > 8 && (header->endian == "little") != kIsLittle) {
        const std::ptrdiff_t width = image.bits / 8;
        for (auto sample = image.data.begin(); sample != image.data.end(); sample += width)
            std::reverse(sample, sample + width);
    }
    return std::move(image);
}

}  // namespace

const std::string* NrrdImage::find(std::string_view key) const noexcept {
    for (const auto& [known, value] : keyValues)
        if (known == key) return &value;
    return nullptr;
}

std::uint32_t NrrdImage::sample(std::size_t index) const noexcept {
    const std::size_t width = static_cast<std::size_t>(bits) / 8;
    std::uint32_t value = 0;
    if (bits == 8) return static_cast<std::uint32_t>(data[index]);
    if (bits == 16) {
        std::uint16_t half = 0;
        std::memcpy(&half, data.data() + index * width, width);
        return half;
    }
    std::memcpy(&value, data.data() + index * width, width);
    return value;
}

Result<NrrdImage> readNrrd(const std::filesystem::path& path, const NrrdReadOptions& options) {
    SVT_TRY(file, FileBytes::read(path));
    auto image = readImage(file->bytes(), file->text(), options);
    if (!image) return Error(image.error().code(), image.error().message(), Place{path.string(), 0, 0, {}});
    return image;
}

}  // namespace svt::writers
