#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/image/png.hpp>
#include <svt/writers/x3d/texture_files.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <system_error>

namespace svt::writers {
namespace {

namespace fs = std::filesystem;

std::uint32_t sampleAt(std::span<const std::byte> bytes, std::size_t index, int bits) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + index * std::size_t(bits / 8), std::size_t(bits / 8));
    return value;
}

template <class Pixel, class PixelOf>
Result<void> writeSlice(std::span<const std::byte> bytes, Vec3i dimension, int bits, const fs::path& file,
                        PixelOf pixelOf) {
    image::Image<Pixel> slice(dimension.x, dimension.y);
    for (std::int32_t j = 0; j < dimension.y; ++j)
        for (std::int32_t i = 0; i < dimension.x; ++i)
            slice.at(i, dimension.y - 1 - j) =
                pixelOf(sampleAt(bytes, std::size_t(i) + std::size_t(dimension.x) * std::size_t(j), bits));
    return image::writePng(file, slice);
}

}  // namespace

std::string stemOf(const fs::path& document) {
    std::string name = document.filename().string();
    for (const std::string_view ending : {".ade.gml", ".x3d"})
        if (lowerAscii(name).ends_with(ending)) name.resize(name.size() - ending.size());
    return name;
}

Result<void> checkPixelCount(Vec3i dimension, std::uint64_t maxVoxels) {
    const auto countOf = [&](int level) {
        std::uint64_t count = 1;
        for (int axis = 0; axis < 3; ++axis) count *= (std::uint64_t(dimension[axis]) + (1u << level) - 1) >> level;
        return count;
    };
    if (countOf(0) <= maxVoxels) return {};
    int level = 1;
    while (level < 6 && countOf(level) > maxVoxels) ++level;
    return Error(Code::BadArgument,
                 fmt::format("{} x {} x {} samples are {} voxels, and the document is to hold {} at most; write them "
                             "beside it by --texture image, or coarser by --level {}, or give --max-voxels",
                             dimension.x, dimension.y, dimension.z, countOf(0), maxVoxels, level));
}

Result<void> checkSibling(const fs::path& file, std::string_view begin) {
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return {};
    const auto there = FileBytes::read(file);
    if (there && (there->bytes().empty() || there->text().starts_with(begin))) return {};
    return Error(Code::WouldDestroy,
                 "the samples beside the document need this file name, but the existing file has other content; give "
                 "the document another name, or remove the file",
                 Place{file.string(), 0, 0, {}});
}

Result<void> writePixelNumbers(const volume::SemanticVolume& volume, int bits, const std::vector<std::uint32_t>& codeOf,
                               const StreamOptions& options, AtomicFile& file) {
    const auto width = static_cast<std::size_t>(volume.grid.dimension().x);
    std::string text;
    return streamSamples(volume.columns, bits, options, [&](std::span<const std::byte> bytes) -> Result<void> {
        // Slabs have some MB: a number takes up to eleven characters.
        const std::size_t count = bytes.size() / std::size_t(bits / 8);
        for (std::size_t begin = 0; begin < count; begin += width) {
            text += '\n';
            for (std::size_t s = begin; s < begin + width; ++s) {
                const std::uint32_t scalar = sampleAt(bytes, s, bits);
                if (s != begin) text += ' ';
                fmt::format_to(std::back_inserter(text), "{}", codeOf.empty() ? scalar : codeOf[scalar]);
            }
            if (text.size() < std::size_t{1} << 20 && begin + width < count) continue;
            SVT_DO(file.write(text));
            text.clear();
        }
        return {};
    });
}

Result<std::vector<std::string>> writeSlices(const volume::SemanticVolume& volume, int bits, SliceKind kind,
                                             const std::vector<std::uint32_t>& codeOf, const fs::path& document,
                                             const StreamOptions& options) {
    const Vec3i dimension = volume.grid.dimension();
    if (kind == SliceKind::Gray16 && volume.labels.scalarCount() > 65536)
        return Error(Code::BadArgument,
                     fmt::format("{} scalars do not fit into pictures of 16 bits; use --texture image",
                                 volume.labels.scalarCount()));
    const std::string name = stemOf(document) + "_slices";
    const fs::path folder = document.parent_path() / name;
    std::error_code failed;
    fs::create_directory(folder, failed);
    if (failed)
        return Error(Code::CannotWrite, "the folder of the slices cannot be made: " + failed.message(),
                     Place{folder.string(), 0, 0, {}});
    std::vector<std::string> files;
    const std::uint64_t sliceBytes = sampleBytes({dimension.x, dimension.y, 1}, bits);
    std::vector<std::byte> pending;
    const auto writeOne = [&](std::span<const std::byte> bytes) -> Result<void> {
        const std::string file = fmt::format("{:04}.png", files.size());
        SVT_DO(checkSibling(folder / file, "\x89PNG"));
        files.push_back(name + "/" + file);
        if (kind == SliceKind::Gray16)
            return writeSlice<std::uint16_t>(bytes, dimension, bits, folder / file,
                                             [](std::uint32_t s) { return static_cast<std::uint16_t>(s); });
        return writeSlice<image::Rgba8>(bytes, dimension, bits, folder / file, [&](std::uint32_t s) {
            const std::uint32_t code = codeOf[s];
            return image::Rgba8{std::uint8_t(code >> 16 & 0xFF), std::uint8_t(code >> 8 & 0xFF),
                                std::uint8_t(code & 0xFF), 255};
        });
    };
    const auto done =
        streamSamples(volume.columns, bits, options, [&](std::span<const std::byte> bytes) -> Result<void> {
            pending.insert(pending.end(), bytes.begin(), bytes.end());
            std::size_t at = 0;
            for (; at + sliceBytes <= pending.size(); at += sliceBytes)
                SVT_DO(writeOne(std::span(pending).subspan(at, sliceBytes)));
            pending.erase(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(at));
            return {};
        });
    if (!done) return done.error();
    return files;
}

Result<SliceAtlas> writeAtlas(const volume::SemanticVolume& volume, int bits, const std::vector<std::uint32_t>& lookOf,
                              const fs::path& document, const StreamOptions& options) {
    const Vec3i dimension = volume.grid.dimension();
    // About as wide as high.
    SliceAtlas atlas;
    const double square = std::sqrt(double(dimension.z) * dimension.y / dimension.x);
    atlas.along = std::clamp(static_cast<std::int32_t>(std::lround(square)), 1, dimension.z);
    atlas.rows = (dimension.z + atlas.along - 1) / atlas.along;
    const std::int64_t width = std::int64_t{atlas.along} * dimension.x, height = std::int64_t{atlas.rows} * dimension.y;
    if (std::max(width, height) > SliceAtlas::kMaxSide)
        return Error(
            Code::BadArgument,
            fmt::format("{} slices of {} x {} samples make a picture of {} x {} pixels, and browsers hold {} along "
                        "an axis; write it coarser by --level, or another kind by --texture",
                        dimension.z, dimension.x, dimension.y, width, height, SliceAtlas::kMaxSide));
    atlas.file = stemOf(document) + ".atlas.png";
    SVT_DO(checkSibling(document.parent_path() / atlas.file, "\x89PNG"));
    image::Image<image::Rgba8> picture(static_cast<std::int32_t>(width), static_cast<std::int32_t>(height));
    const auto nx = static_cast<std::uint64_t>(dimension.x), ny = static_cast<std::uint64_t>(dimension.y);
    const auto along = static_cast<std::uint64_t>(atlas.along);
    std::uint64_t sample = 0;
    const auto done = streamSamples(volume.columns, bits, options, [&](std::span<const std::byte> bytes) {
        for (std::size_t s = 0; s < bytes.size() / std::size_t(bits / 8); ++s, ++sample) {
            const std::uint64_t i = sample % nx, j = sample / nx % ny, k = sample / (nx * ny);
            const std::uint32_t look = lookOf[sampleAt(bytes, s, bits)];
            picture.at(static_cast<std::int32_t>(k % along * nx + i), static_cast<std::int32_t>(k / along * ny + j)) = {
                std::uint8_t(look >> 24), std::uint8_t(look >> 16 & 0xFF), std::uint8_t(look >> 8 & 0xFF),
                std::uint8_t(look & 0xFF)};
        }
        return Result<void>();
    });
    if (!done) return done.error();
    SVT_DO(image::writePng(document.parent_path() / atlas.file, picture));
    return atlas;
}

}  // namespace svt::writers
