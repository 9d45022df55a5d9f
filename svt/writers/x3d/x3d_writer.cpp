/// \file
/// Writes a semantic volume as X3D 4.0 (ISO/IEC 19775-1, components Texturing3D and VolumeRendering): the 3D texture
/// that the paper calls a semantic volume texture, as the voxels of a SegmentedVolumeData. X_ITE and Castle show it.
///
/// An X3D texture has bytes, so a voxel is a colour: red is the code of its look (3 times its number in the palette),
/// green the low byte of the scalar, blue the high byte. The transfer function, from red to colour and opacity, is the
/// picture of 256 x 1 pixels of an OpacityMapVolumeStyle. Looks beyond 84 are replaced by the nearest. Samples are
/// never interpolated (NEAREST_PIXEL). Coordinates are metres with y up, and the lower corner of the volume is at the
/// origin. The world coordinates of this corner, the CRS and the range of scalars of each feature are metadata.
///
/// The fourth kind is not part of the standard: an ImageTextureAtlas, one picture of all slices, the only form of
/// volume that X3DOM shows. It has colours instead of labels, and no features.

#include <svt/core/text.hpp>
#include <svt/writers/dense/gzip_writer.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/volume_formats.hpp>
#include <svt/writers/x3d/texture_files.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

namespace svt::writers {
namespace {

constexpr const char* kNearest =
    "<TextureProperties magnificationFilter='NEAREST_PIXEL' minificationFilter='NEAREST_PIXEL' generateMipMaps='false' "
    "boundaryModeS='CLAMP_TO_EDGE' boundaryModeT='CLAMP_TO_EDGE' boundaryModeR='CLAMP_TO_EDGE'/>";

/// The looks of labels, 0xRRGGBBAA, and which one each scalar has.
struct Palette {
    std::vector<std::uint32_t> looks{0};  ///< entry 0: background
    std::vector<std::uint32_t> lookOfScalar;

    /// The code of a look: three apart, so that a viewer that interpolates on the way to the transfer function, as
    /// X_ITE does with its own one in front, still meets the right entry.
    static constexpr std::uint32_t kStep = 3;
    static constexpr std::size_t kMaxLooks = 85;  // codes 0, 3, ..., 252
};

int distance(std::uint32_t a, std::uint32_t b) {
    int sum = 0;
    for (int shift = 0; shift < 32; shift += 8) {
        const int d = static_cast<int>(a >> shift & 255) - static_cast<int>(b >> shift & 255);
        sum += d * d;
    }
    return sum;
}

Palette paletteOf(const volume::LabelTable& labels) {
    Palette palette;
    palette.lookOfScalar.assign(labels.scalarCount(), 0);
    for (const volume::Label& label : labels.labels)
        for (volume::Scalar s = label.first; s < label.first + label.count; ++s) {
            const std::uint32_t look = lookOf(labels, label, s);
            auto found = std::find(palette.looks.begin() + 1, palette.looks.end(), look);
            if (found == palette.looks.end() && palette.looks.size() < Palette::kMaxLooks) {
                palette.looks.push_back(look);
                found = palette.looks.end() - 1;
            } else if (found == palette.looks.end()) {
                found = std::min_element(palette.looks.begin() + 1, palette.looks.end(),
                                         [&](auto a, auto b) { return distance(a, look) < distance(b, look); });
            }
            palette.lookOfScalar[s] = static_cast<std::uint32_t>(found - palette.looks.begin());
        }
    return palette;
}

/// The colour of a voxel of each scalar: red is the code of its look, green the low byte of the scalar, blue the high
/// byte.
std::vector<std::uint32_t> codesOf(const Palette& palette) {
    std::vector<std::uint32_t> codes;
    for (std::uint32_t s = 0; s < palette.lookOfScalar.size(); ++s)
        codes.push_back(palette.lookOfScalar[s] * Palette::kStep << 16 | (s & 0xFF) << 8 | (s >> 8 & 0xFF));
    return codes;
}

/// The transfer function as the numbers of a PixelTexture of 256 x 1 pixels: entries beside a code are as the code.
std::string transferFunction(const Palette& palette) {
    std::string text = "256 1 4";
    for (std::uint32_t entry = 0; entry < 256; ++entry) {
        const std::size_t look = (entry + Palette::kStep / 2) / Palette::kStep;
        const std::uint32_t color = look < palette.looks.size() ? palette.looks[look] : 0;
        text += color == 0 ? " 0" : fmt::format(" 0x{:08X}", color);
    }
    return text;
}

/// Axis and angle of the rotation from the grid's axes to the world's (Rodrigues), as X3D writes it.
std::string rotationText(const std::array<Vec3d, 3>& axes) {
    const auto& [x, y, z] = axes;
    const Vec3d axis{y.z - z.y, z.x - x.z, x.y - y.x};
    const double sine = length(axis) / 2, cosine = (x.x + y.y + z.z - 1) / 2;
    if (sine < 1e-12) return cosine > 0 ? "0 0 1 0" : fmt::format("0 0 1 {}", std::numbers::pi);
    const Vec3d unit = axis / (2 * sine);
    return fmt::format("{} {} {} {}", unit.x, unit.y, unit.z, std::atan2(sine, cosine));
}

std::string metadata(const volume::SemanticVolume& volume, const Palette& palette, bool hasLabels) {
    const Vec3d corner = lowerCorner(volume.grid);
    std::string text = "<MetadataSet containerField='metadata' name='svt'>\n";
    text += fmt::format("<MetadataString containerField='value' name='crs' value='\"{}\"'/>\n",
                        xmlAttribute(volume.crsName));
    text += fmt::format("<MetadataDouble containerField='value' name='origin' value='{} {} {}'/>\n", corner.x, corner.y,
                        corner.z);
    for (const volume::Label& label : volume.labels.labels) {
        if (!hasLabels) break;
        const auto quoted = [](std::string_view value) {
            std::string out;
            for (const char c : value) (c == '"' || c == '\\' ? out += '\\' : out) += c;
            return xmlAttribute(out);
        };
        text += fmt::format(
            "<MetadataSet containerField='value' name='feature'>"
            "<MetadataString containerField='value' name='id' value='\"{}\"'/>"
            "<MetadataString containerField='value' name='class' value='\"{}\"'/>"
            "<MetadataString containerField='value' name='name' value='\"{}\"'/>",
            quoted(label.id), quoted(label.className), quoted(label.name));
        if (label.parent != volume::kNoLabel)
            text += fmt::format("<MetadataString containerField='value' name='parent' value='\"{}\"'/>",
                                quoted(volume.labels.labels[label.parent].id));
        if (label.count > 0)
            text += fmt::format(
                "<MetadataInteger containerField='value' name='scalarRange' value='{} {}'/>"
                "<MetadataInteger containerField='value' name='code' value='{}'/>",
                label.first, label.first + label.count - 1, palette.lookOfScalar[label.first] * Palette::kStep);
        text += "</MetadataSet>\n";
    }
    return text + "</MetadataSet>\n";
}

std::string beginningOfX3d(const volume::SemanticVolume& volume, const Palette& palette, bool hasLabels) {
    const volume::Grid& grid = volume.grid;
    const Vec3d extent = scaled(toDouble(grid.dimension()), grid.spacing());
    std::string text =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<!DOCTYPE X3D PUBLIC \"ISO//Web3D//DTD X3D 4.0//EN\" \"https://www.web3d.org/specifications/x3d-4.0.dtd\">\n"
        "<X3D profile='Full' version='4.0' xmlns:xsd='http://www.w3.org/2001/XMLSchema-instance' "
        "xsd:noNamespaceSchemaLocation='https://www.web3d.org/specifications/x3d-4.0.xsd'>\n<head>\n";
    text += fmt::format("<meta name='title' content='{}'/>\n<meta name='generator' content='SVT'/>\n</head>\n<Scene>\n",
                        xmlAttribute(shownName(volume)));
    const double size = length(extent);
    // From the south-east, above: +x is east, +y up, -z north.
    const Vec3d look{extent.x / 2, extent.z / 2, -extent.y / 2};
    text += "<Background skyColor='0.859 0.89 0.922'/>\n";  // not white: walls often are
    text += fmt::format(
        "<Viewpoint description='from the south-east' centerOfRotation='{0} {1} {2}' "
        "position='{3} {4} {5}' orientation='-0.5558 0.7988 0.2302 0.9567'/>\n",
        look.x, look.y, look.z, look.x + 0.9 * size, look.y + 0.8 * size, look.z + 0.9 * size);
    text +=
        fmt::format("<Transform rotation='1 0 0 {}'>\n<Transform rotation='{}'>\n<Transform translation='{} {} {}'>\n",
                    -std::numbers::pi / 2, rotationText(grid.axes()), extent.x / 2, extent.y / 2, extent.z / 2);
    text += fmt::format("<{} DEF='volume' dimensions='{} {} {}'>\n", hasLabels ? "SegmentedVolumeData" : "VolumeData",
                        extent.x, extent.y, extent.z);
    return text + metadata(volume, palette, hasLabels);
}

constexpr const char* kEndOfScene = "</Transform>\n</Transform>\n</Transform>\n</Scene>\n</X3D>\n";

std::string endOfX3d(const Palette& palette) {
    return fmt::format(
        "<OpacityMapVolumeStyle containerField='renderStyle'><PixelTexture containerField='transferFunction' "
        "repeatS='false' repeatT='false' "
        "image='{}'>{}</PixelTexture></OpacityMapVolumeStyle>\n</SegmentedVolumeData>\n",
        transferFunction(palette), kNearest);
}

/// The nodes of X3DOM, which X_ITE knows too. X3DOM mixes neighbouring slices, so numbers of looks would become others
/// on the way to a transfer function; colours become colours between them. Each of its steps through the volume is
/// opaque by opacityFactor, which is that number of steps; it takes the red channel for opacity.
Result<std::string> writeAtlasScene(const volume::SemanticVolume& volume, int bits, const Palette& palette,
                                    const std::filesystem::path& path, const VolumeWriteOptions& options) {
    std::vector<std::uint32_t> lookOf;
    for (const std::uint32_t look : palette.lookOfScalar) lookOf.push_back(palette.looks[look]);
    SVT_TRY(atlas, writeAtlas(volume, bits, lookOf, path, writeStream(options)));
    return fmt::format(
        "<ImageTextureAtlas containerField='voxels' url='\"{}\"' numberOfSlices='{}' slicesOverX='{}' "
        "slicesOverY='{}'/>\n<OpacityMapVolumeStyle containerField='renderStyle' opacityFactor='85' "
        "lightFactor='1'/>\n</VolumeData>\n",
        xmlAttribute(atlas->file), volume.grid.dimension().z, atlas->along, atlas->rows);
}

/// An NRRD as browsers read it: bytes, components first.
Result<void> writeColorNrrd(const volume::SemanticVolume& volume, int bits, const std::vector<std::uint32_t>& codes,
                            const std::filesystem::path& path, const VolumeWriteOptions& options) {
    SVT_DO(checkSibling(path, "NRRD000"));
    SVT_TRY(file, AtomicFile::create(path));
    const Vec3i dimension = volume.grid.dimension();
    const Vec3d spacing = volume.grid.spacing();
    const std::string head = fmt::format(
        "NRRD0004\ntype: uint8\ndimension: 4\nsizes: 3 {} {} {}\nspacings: nan {} {} {}\n"
        "kinds: RGB-color domain domain domain\nencoding: {}\n\n",
        dimension.x, dimension.y, dimension.z, spacing.x, spacing.y, spacing.z, options.isCompressed ? "gzip" : "raw");
    SVT_DO(file->write(head));
    GzipWriter gzip(*file, options.threads);
    std::vector<std::byte> colors;
    auto done = streamSamples(volume.columns, bits, writeStream(options), [&](std::span<const std::byte> bytes) {
        const auto size = static_cast<std::size_t>(bits / 8);
        colors.clear();
        for (std::size_t at = 0; at < bytes.size(); at += size) {
            std::uint32_t scalar = 0;
            std::memcpy(&scalar, bytes.data() + at, size);
            for (const int shift : {16, 8, 0}) colors.push_back(static_cast<std::byte>(codes[scalar] >> shift & 0xFF));
        }
        return options.isCompressed ? gzip.write(colors) : file->write(colors);
    });
    if (!done) return done;
    if (options.isCompressed) SVT_DO(gzip.finish());
    auto bytes = file->commit();
    return bytes ? Result<void>() : Result<void>(bytes.error());
}

/// The numbers of a PixelTexture3D: components, sizes, samples as 0xRRGGBB.
Result<void> writePixels(const volume::SemanticVolume& volume, int bits, const std::vector<std::uint32_t>& codes,
                         const StreamOptions& stream, AtomicFile& file) {
    const Vec3i dimension = volume.grid.dimension();
    SVT_DO(file.write(fmt::format("<PixelTexture3D containerField='voxels' image='3 {} {} {}", dimension.x, dimension.y,
                                  dimension.z)));
    SVT_DO(writePixelNumbers(volume, bits, codes, stream, file));
    return file.write(fmt::format("'>{}</PixelTexture3D>\n", kNearest));
}

/// Writes what stands beside the document; returns the element that names it.
Result<std::string> writeBesideScene(const volume::SemanticVolume& volume, int bits,
                                     const std::vector<std::uint32_t>& codes, const std::filesystem::path& path,
                                     const VolumeWriteOptions& options) {
    if (options.texture == TextureKind::Image) {
        const std::string nrrd = stemOf(path) + ".labels.nrrd";
        SVT_DO(writeColorNrrd(volume, bits, codes, path.parent_path() / nrrd, options));
        return fmt::format("<ImageTexture3D containerField='voxels' url='\"{}\"'>{}</ImageTexture3D>\n",
                           xmlAttribute(nrrd), kNearest);
    }
    SVT_TRY(files, writeSlices(volume, bits, SliceKind::Colors, codes, path, writeStream(options)));
    std::string text = "<ComposedTexture3D containerField='voxels'>\n";
    for (const std::string& file : *files)
        text += fmt::format("<ImageTexture containerField='texture' url='\"{}\"'/>\n", xmlAttribute(file));
    return text + fmt::format("{}</ComposedTexture3D>\n", kNearest);
}

/// Beside the document it writes `<stem>.labels.nrrd`, or `<stem>_slices/0000.png` and so on, or `<stem>.atlas.png`.
/// Equal volumes give equal bytes. The document appears when all is written.
/// \return bytes of the document, or BadArgument (too many scalars or voxels), CannotWrite, DiskFull, WouldDestroy,
///         Cancelled
Result<std::uint64_t> writeX3d(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                               const VolumeWriteOptions& options) {
    const TextureKind kind = options.texture;
    SVT_TRY(bits, checkedSampleBits(volume));
    if (volume.labels.scalarCount() > 65536)
        return Error(Code::BadArgument,
                     fmt::format("{} scalars are more than the 65536 that a texture of X3D can colour; build without "
                                 "--patterns, or write another format",
                                 volume.labels.scalarCount()));
    if (kind == TextureKind::Pixel) SVT_DO(checkPixelCount(volume.grid.dimension(), options.maxVoxels));
    const Palette palette = paletteOf(volume.labels);
    const std::vector<std::uint32_t> codes = codesOf(palette);
    std::string beside;
    if (kind != TextureKind::Pixel) {
        SVT_TRY(written, kind == TextureKind::Atlas ? writeAtlasScene(volume, *bits, palette, path, options)
                                                    : writeBesideScene(volume, *bits, codes, path, options));
        beside = std::move(*written);
    }
    SVT_TRY(file, AtomicFile::create(path));
    const bool hasLabels = kind != TextureKind::Atlas;
    SVT_DO(file->write(beginningOfX3d(volume, palette, hasLabels)));
    SVT_DO(kind == TextureKind::Pixel ? writePixels(volume, *bits, codes, writeStream(options), *file)
                                      : file->write(beside));
    SVT_DO(file->write((hasLabels ? endOfX3d(palette) : std::string()) + kEndOfScene));
    return file->commit();
}

}  // namespace

extern const VolumeFormat kX3d{
    .name = "x3d",
    .endings = ".x3d",
    .holds = "X3D 4.0: a 3D texture as SegmentedVolumeData, with transfer function and features",
    .readers = "X_ITE, Castle, InstantReality; X3DOM by --texture atlas",
    .content = FileContent::X3d,
    .isDense = true,
    .write = writeX3d};

}  // namespace svt::writers
