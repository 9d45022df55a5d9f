/// \file
/// Writes a semantic volume as a TIFF stack (.tif, .ome.tif), which Fiji/ImageJ, tifffile, napari and GDAL read.
///
/// A page is a slice k; its rows are j, its pixels i. Rows are not reversed, so viewers show north at the bottom.
/// Samples are unsigned, with 8, 16 or 32 bits. Files from 4 GB are BigTIFF. The first page states spacing and unit: as
/// ImageJ's text, or as OME-XML if the name ends in .ome.tif. ImageJ does not support 32-bit integers, so files with
/// these have no ImageJ text. The matrix of GeoTIFF (ModelTransformation, tag 34264) maps pixel (i, j, k) to world
/// space, where a sample is a point. Private tags 65080, 65081 and 65082 contain `svt.json` and `labels.json` of a
/// `.svt` and their seal, so that the file can become a volume again.

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::writers {
namespace {

enum class TiffMetadata : std::uint8_t { ImageJ, Ome };

constexpr std::uint64_t kStripBytes = std::uint64_t{1} << 20;
constexpr std::uint64_t kClassicLimit = 0xFFFF0000u;

enum TiffType : std::uint16_t { kAscii = 2, kShort = 3, kLong = 4, kRational = 5, kDouble = 12, kLong8 = 16 };

void appendTiff(std::string& out, std::uint64_t value, std::size_t bytes) {
    for (std::size_t b = 0; b < bytes; ++b) out += static_cast<char>(value >> 8 * b & 0xFF);
}

/// A field of a page: its value as bytes, as many as its type and count say.
struct TiffField {
    std::uint16_t tag = 0, type = 0;
    std::uint64_t count = 0;
    std::string value;
};

TiffField numberField(std::uint16_t tag, TiffType type, std::initializer_list<std::uint64_t> values) {
    TiffField field{tag, type, values.size(), {}};
    for (const std::uint64_t value : values) appendTiff(field.value, value, type == kShort ? 2 : 4);
    return field;
}

TiffField textField(std::uint16_t tag, std::string text) {
    text += '\0';
    return {tag, kAscii, text.size(), std::move(text)};
}

TiffField doubleField(std::uint16_t tag, std::span<const double> values) {
    TiffField field{tag, kDouble, values.size(), std::string(values.size() * sizeof(double), '\0')};
    std::memcpy(field.value.data(), values.data(), field.value.size());
    return field;
}

/// Pixels per metre.
TiffField resolutionField(std::uint16_t tag, double spacing) {
    TiffField field{tag, kRational, 1, {}};
    constexpr double kParts = 1e6;
    const double parts = std::clamp(std::round(spacing * kParts), 1.0, 4e9);
    appendTiff(field.value, static_cast<std::uint64_t>(kParts), 4);
    appendTiff(field.value, static_cast<std::uint64_t>(parts), 4);
    return field;
}

std::string omeXml(const volume::SemanticVolume& volume, int bits) {
    const Vec3i dimension = volume.grid.dimension();
    const Vec3d spacing = volume.grid.spacing();
    // Names are valid UTF-8 in a volume; readers look for an XML declaration of the encoding.
    return fmt::format(
        R"(<?xml version="1.0" encoding="UTF-8"?><OME xmlns="http://www.openmicroscopy.org/Schemas/OME/2016-06" )"
        R"(xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:schemaLocation="http://www.openmicroscopy.org/)"
        R"(Schemas/OME/2016-06 http://www.openmicroscopy.org/Schemas/OME/2016-06/ome.xsd">)"
        R"(<Image ID="Image:0" Name="{}"><Pixels ID="Pixels:0" DimensionOrder="XYZCT" Type="uint{}" BigEndian="false" )"
        R"(SizeX="{}" SizeY="{}" SizeZ="{}" SizeC="1" SizeT="1" PhysicalSizeX="{}" PhysicalSizeXUnit="m" )"
        R"(PhysicalSizeY="{}" PhysicalSizeYUnit="m" PhysicalSizeZ="{}" PhysicalSizeZUnit="m">)"
        R"(<Channel ID="Channel:0:0" SamplesPerPixel="1"/><TiffData IFD="0" PlaneCount="{}"/></Pixels></Image></OME>)",
        xmlAttribute(volume.modelName), bits, dimension.x, dimension.y, dimension.z, spacing.x, spacing.y, spacing.z,
        dimension.z);
}

std::string imageJText(const volume::SemanticVolume& volume) {
    const int slices = volume.grid.dimension().z;
    return fmt::format("ImageJ=1.53t\nimages={0}\nslices={0}\nunit=m\nspacing={1}\nloop=false\nmin=0.0\nmax={2}.0\n",
                       slices, volume.grid.spacing().z, volume.labels.scalarCount() - 1);
}

/// Additional fields of the first page.
std::vector<TiffField> volumeFields(const volume::SemanticVolume& volume, TiffMetadata metadata, int bits) {
    std::vector<TiffField> fields;
    if (metadata == TiffMetadata::Ome) fields.push_back(textField(270, omeXml(volume, bits)));
    if (metadata == TiffMetadata::ImageJ && bits < 32) fields.push_back(textField(270, imageJText(volume)));
    const volume::Grid& grid = volume.grid;
    const Vec3d x = grid.worldFromIndexDirection({1, 0, 0}), y = grid.worldFromIndexDirection({0, 1, 0}),
                z = grid.worldFromIndexDirection({0, 0, 1}), o = grid.origin();
    const std::array<double, 16> matrix{x.x, y.x, z.x, o.x, x.y, y.y, z.y, o.y, x.z, y.z, z.z, o.z, 0, 0, 0, 1};
    fields.push_back(doubleField(34264, matrix));
    // GeoKeys 1.1.0: user-defined projected model, a sample is a point.
    fields.push_back(numberField(34735, kShort, {1, 1, 0, 2, 1024, 0, 1, 1, 1025, 0, 1, 2}));
    fields.push_back(textField(65080, volume::writeHeaderJson(volume)));
    fields.push_back(textField(65081, volume::writeLabelsJson(volume.labels)));
    fields.push_back(textField(65082, volume::sealText(volume, volume.columns)));
    return fields;
}

/// The layout of the file: head, pages, values that do not fit into the pages' fields, strips.
class TiffLayout {
public:
    TiffLayout(const volume::SemanticVolume& volume, int bits, TiffMetadata metadata, std::uint64_t rowsPerStrip,
               const std::vector<std::uint64_t>* compressedSizes)
        : volume_(volume),
          bits_(bits),
          rowsPerStrip_(rowsPerStrip),
          compressedSizes_(compressedSizes),
          first_(volumeFields(volume, metadata, bits)) {
        const Vec3i dimension = volume.grid.dimension();
        rowBytes_ = static_cast<std::uint64_t>(dimension.x) * static_cast<std::uint64_t>(bits / 8);
        stripsPerPage_ = (static_cast<std::uint64_t>(dimension.y) + rowsPerStrip - 1) / rowsPerStrip;
        std::uint64_t data = 0;
        for (std::uint64_t s = 0; s < stripsPerPage_ * static_cast<std::uint64_t>(dimension.z); ++s)
            data += stripSize(s);
        isBig_ = measure(false) + data > kClassicLimit;
        dataOffset_ = measure(isBig_);
    }

    /// All in front of the strips.
    [[nodiscard]] Result<void> write(AtomicFile& file) const {
        std::string head = "II";
        appendTiff(head, isBig_ ? 43 : 42, 2);
        if (isBig_) appendTiff(head, 8, 4);
        appendTiff(head, isBig_ ? 16 : 8, isBig_ ? 8 : 4);
        SVT_DO(file.write(head));
        std::uint64_t at = head.size(), data = dataOffset_;
        for (std::int32_t page = 0; page < volume_.grid.dimension().z; ++page) {
            const std::string text = pageText(page, at, data, isBig_);
            SVT_DO(file.write(text));
            at += text.size();
        }
        return {};
    }

private:
    [[nodiscard]] std::uint64_t stripSize(std::uint64_t strip) const {
        if (compressedSizes_ != nullptr) return (*compressedSizes_)[strip];
        const auto rows = static_cast<std::uint64_t>(volume_.grid.dimension().y);
        return std::min(rowsPerStrip_, rows - strip % stripsPerPage_ * rowsPerStrip_) * rowBytes_;
    }

    /// Bytes in front of the strips.
    [[nodiscard]] std::uint64_t measure(bool isBig) const {
        std::uint64_t data = 0;
        const std::uint64_t first = pageText(0, 0, data, isBig).size();
        const std::uint64_t other = volume_.grid.dimension().z > 1 ? pageText(1, 0, data, isBig).size() : 0;
        return (isBig ? 16 : 8) + first + other * static_cast<std::uint64_t>(volume_.grid.dimension().z - 1);
    }

    /// A page at `offset` with its values behind it; its strips begin at `data`, which is moved behind them.
    [[nodiscard]] std::string pageText(std::int32_t page, std::uint64_t offset, std::uint64_t& data, bool isBig) const {
        std::vector<TiffField> fields = page == 0 ? first_ : std::vector<TiffField>();
        const Vec3i dimension = volume_.grid.dimension();
        const auto width = static_cast<std::uint64_t>(dimension.x), height = static_cast<std::uint64_t>(dimension.y);
        fields.push_back(numberField(254, kLong, {0}));
        fields.push_back(numberField(256, kLong, {width}));
        fields.push_back(numberField(257, kLong, {height}));
        fields.push_back(numberField(258, kShort, {static_cast<std::uint64_t>(bits_)}));
        fields.push_back(numberField(259, kShort, {compressedSizes_ != nullptr ? 8u : 1u}));
        fields.push_back(numberField(262, kShort, {1}));
        fields.push_back(numberField(277, kShort, {1}));
        fields.push_back(numberField(278, kLong, {rowsPerStrip_}));
        fields.push_back(resolutionField(282, volume_.grid.spacing().x));
        fields.push_back(resolutionField(283, volume_.grid.spacing().y));
        fields.push_back(numberField(296, kShort, {1}));
        fields.push_back(numberField(339, kShort, {1}));
        const std::size_t wide = isBig ? 8 : 4;
        TiffField offsets{273, isBig ? kLong8 : kLong, stripsPerPage_, {}}, sizes = offsets;
        sizes.tag = 279;
        for (std::uint64_t s = 0; s < stripsPerPage_; ++s) {
            const std::uint64_t size = stripSize(static_cast<std::uint64_t>(page) * stripsPerPage_ + s);
            appendTiff(offsets.value, data, wide);
            appendTiff(sizes.value, size, wide);
            data += size;
        }
        fields.push_back(std::move(offsets));
        fields.push_back(std::move(sizes));
        std::sort(fields.begin(), fields.end(), [](const TiffField& a, const TiffField& b) { return a.tag < b.tag; });
        return directoryText(fields, offset, page + 1 < dimension.z, isBig);
    }

    [[nodiscard]] static std::string directoryText(const std::vector<TiffField>& fields, std::uint64_t offset,
                                                   bool hasNext, bool isBig) {
        const std::size_t wide = isBig ? 8 : 4, entry = isBig ? 20 : 12, countBytes = isBig ? 8 : 2;
        std::string directory, values;
        const std::uint64_t behind = offset + countBytes + fields.size() * entry + wide;
        appendTiff(directory, fields.size(), countBytes);
        for (const TiffField& field : fields) {
            appendTiff(directory, field.tag, 2);
            appendTiff(directory, field.type, 2);
            appendTiff(directory, field.count, wide);
            if (field.value.size() <= wide) {
                directory += field.value;
                directory.append(wide - field.value.size(), '\0');
            } else {
                appendTiff(directory, behind + values.size(), wide);
                values += field.value;
                values.append((8 - values.size() % 8) % 8, '\0');  // every value at a multiple of 8 from the first
            }
        }
        // The whole page takes a multiple of 8, so that the next one is aligned, too.
        values.append((16 - (countBytes + fields.size() * entry + wide + values.size()) % 8) % 8, '\0');
        appendTiff(directory, hasNext ? behind + values.size() : 0, wide);
        return directory + values;
    }

    const volume::SemanticVolume& volume_;
    int bits_;
    std::uint64_t rowsPerStrip_, stripsPerPage_ = 0, rowBytes_ = 0, dataOffset_ = 0;
    const std::vector<std::uint64_t>* compressedSizes_;  // null: raw
    std::vector<TiffField> first_;
    bool isBig_ = false;
};

/// Writes one file, all or nothing, in strips of about 1 MiB by Deflate, or raw with one strip per page. Equal volumes
/// give equal bytes. Cost: O(samples); memory: about 150 MB at most, besides the label table.
/// \return bytes written, or CannotWrite, DiskFull, Cancelled; BadArgument as checkedSampleBits()
template <TiffMetadata metadata>
Result<std::uint64_t> writeTiff(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                const VolumeWriteOptions& options) {
    SVT_TRY(bits, checkedSampleBits(volume));
    SVT_TRY(file, AtomicFile::create(path));
    const Vec3i dimension = volume.grid.dimension();
    const StreamOptions stream = writeStream(options);
    if (!options.isCompressed) {
        const TiffLayout layout(volume, *bits, metadata, static_cast<std::uint64_t>(dimension.y), nullptr);
        SVT_DO(layout.write(*file));
        SVT_DO(streamSamples(volume.columns, *bits, stream, [&](auto bytes) { return file->write(bytes); }));
        return file->commit();
    }
    const std::uint64_t rowBytes = sampleBytes({dimension.x, 1, 1}, *bits);
    const std::uint64_t rows = std::clamp<std::uint64_t>(kStripBytes / rowBytes, 1, std::uint64_t(dimension.y));
    ZlibBlocks strips(volume.columns, *bits, {rowBytes * std::uint64_t(dimension.y), rowBytes * rows}, stream);
    SVT_DO(strips.compress());
    const TiffLayout layout(volume, *bits, metadata, rows, &strips.sizes());
    SVT_DO(layout.write(*file));
    SVT_DO(strips.write(*file));
    return file->commit();
}

}  // namespace

extern const VolumeFormat kTiff{.name = "tiff",
                                .endings = ".tif|.tiff",
                                .holds = "TIFF stack: a page per slice, with ImageJ's metadata",
                                .readers = "Fiji/ImageJ, tifffile, napari, GDAL",
                                .content = FileContent::Tiff,
                                .isDense = true,
                                .write = writeTiff<TiffMetadata::ImageJ>};

extern const VolumeFormat kOmeTiff{.name = "ometiff",
                                   .endings = ".ome.tif|.ome.tiff",
                                   .holds = "TIFF stack with OME-XML",
                                   .readers = "Bio-Formats, tifffile, napari, QuPath",
                                   .content = FileContent::Tiff,
                                   .isDense = true,
                                   .write = writeTiff<TiffMetadata::Ome>};

}  // namespace svt::writers
