/// \file
/// Writes a semantic volume as Zarr with the metadata of OME-NGFF, which zarr-python, zarrita, napari, neuroglancer and
/// vizarr read: a folder with one array per level, axes z, y, x.
///
/// Version 2 (OME-NGFF 0.4): chunks of 64 x 64 x 64 samples, each a zstd frame in a file of its own, `LEVEL/z/y/x`.
/// Version 3 (OME-NGFF 0.5): shards of 128 x 128 x 128 samples with inner chunks of 32 x 32 x 32, `LEVEL/c/z/y/x`,
/// their index at the end. Chunks of background are left out. Levels are those of volume::coarseVolumes(), until 64
/// samples are the longest side. Scale and translation are metres of the model's CRS; a turned grid has them along its
/// own axes, since the metadata know no rotation. `image-label` has colour, id, class and name of each scalar; `svt`
/// has the same as `svt.json` and `labels.json` of a `.svt`.

#include <svt/core/check.hpp>
#include <svt/core/parallel.hpp>
#include <svt/record/record.hpp>
#include <svt/writers/dense/coarser_levels.hpp>
#include <svt/writers/dense/new_folder.hpp>
#include <svt/writers/dense/sample_band.hpp>
#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/volume_formats.hpp>
#include <svt/writers/zarr/zarr_metadata.hpp>

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <new>

namespace svt::writers {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::byte>;

constexpr int kZstdLevel = 3;

Bytes zstdFrame(std::span<const std::byte> bytes) {
    Bytes frame(ZSTD_compressBound(bytes.size()));
    const std::size_t size = ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), kZstdLevel);
    if (ZSTD_isError(size) != 0) throw std::bad_alloc();  // the buffer is large enough, so only memory can be missing
    frame.resize(size);
    return frame;
}

std::uint32_t crc32c(std::span<const std::byte> bytes) noexcept {
    std::uint32_t crc = ~0u;
    for (const std::byte byte : bytes) {
        crc ^= static_cast<std::uint32_t>(byte);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (0x82F63B78u & (0u - (crc & 1u)));
    }
    return ~crc;
}

/// The bytes of a file: a chunk, or a shard of chunks with its index; empty: all is background.
template <class T>
Bytes fileBytes(const SampleBand<T>& band, Vec3i first, const ZarrShape& shape, Vec3i dimension) {
    if (shape.chunk == shape.file) {
        const auto samples = band.chunk(first.x, first.y, first.z, shape.chunk);
        return samples.empty() ? Bytes() : zstdFrame(std::as_bytes(std::span(samples)));
    }
    Bytes bytes;
    std::vector<std::uint64_t> index;  // offset and size of each inner chunk, z slowest
    for (std::int32_t z = first.z; z < first.z + shape.file; z += shape.chunk)
        for (std::int32_t y = first.y; y < first.y + shape.file; y += shape.chunk)
            for (std::int32_t x = first.x; x < first.x + shape.file; x += shape.chunk) {
                std::vector<T> samples;
                if (x < dimension.x && y < dimension.y && z < dimension.z) samples = band.chunk(x, y, z, shape.chunk);
                if (samples.empty()) {
                    index.insert(index.end(), {~std::uint64_t{0}, ~std::uint64_t{0}});
                    continue;
                }
                const Bytes frame = zstdFrame(std::as_bytes(std::span(samples)));
                index.insert(index.end(), {bytes.size(), frame.size()});
                bytes.insert(bytes.end(), frame.begin(), frame.end());
            }
    if (bytes.empty()) return bytes;
    const auto table = std::as_bytes(std::span(index));
    const std::uint32_t crc = crc32c(table);
    bytes.insert(bytes.end(), table.begin(), table.end());
    const auto end = std::as_bytes(std::span(&crc, 1));
    bytes.insert(bytes.end(), end.begin(), end.end());
    return bytes;
}

template <class T>
Result<void> writeArray(const volume::ColumnVolume& columns, const std::string& folder, const ZarrShape& shape,
                        const VolumeWriteOptions& options, NewFolder& to) {
    const Vec3i dimension = columns.dimension();
    for (std::int32_t k = 0; k < dimension.z; k += shape.file) {
        Progress::tell(options.progress, "write", double(k) / dimension.z);
        for (std::int32_t j = 0; j < dimension.y; j += shape.file) {
            SVT_DO(checkNotStopped(options.progress, "nothing"));
            const SampleBand<T> band(columns, j, k, shape.file, options.threads);
            std::vector<Bytes> files(static_cast<std::size_t>((dimension.x + shape.file - 1) / shape.file));
            parallelFor(files.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
                for (std::size_t f = begin; f < end; ++f)
                    files[f] = fileBytes(band, {static_cast<std::int32_t>(f) * shape.file, j, k}, shape, dimension);
            });
            for (std::size_t f = 0; f < files.size(); ++f) {
                if (files[f].empty()) continue;
                const std::string name = fmt::format("{}/{}/{}/{}", folder, k / shape.file, j / shape.file, f);
                const std::string_view text(reinterpret_cast<const char*>(files[f].data()), files[f].size());
                SVT_DO(to.write(name, text));
            }
        }
    }
    return {};
}

/// Writes a folder that appears when all of it is written; one that is there is not replaced. Equal volumes give equal
/// bytes. Memory: besides the volume and its levels, a band of chunks: 4096 nx samples (version 2) or 16384 nx (version
/// 3).
/// \param options  zarr.version is 2 or 3
/// \return bytes of all files, or WouldDestroy, CannotWrite, Cancelled; BadArgument as checkedSampleBits()
Result<std::uint64_t> writeZarr(const volume::SemanticVolume& volume, const fs::path& path,
                                const VolumeWriteOptions& options) {
    const int version = options.zarr.version;
    SVT_TRY(bits, checkedSampleBits(volume));
    SVT_CHECK(version == 2 || version == 3);
    NewFolder folder(path);
    SVT_DO(folder.create());
    SVT_TRY(coarser, coarserLevels(volume, options.threads));
    const std::vector<volume::SemanticVolume>& coarse = *coarser;
    std::vector<volume::Grid> grids{volume.grid};
    for (const volume::SemanticVolume& level : coarse) grids.push_back(level.grid);
    if (version == 2) SVT_DO(folder.write(".zgroup", "{\"zarr_format\": 2}\n"));
    SVT_DO(folder.write(version == 2 ? ".zattrs" : "zarr.json", zarrGroupJson(volume, grids, version)));
    const ZarrShape shape = zarrShape(version);
    for (std::size_t l = 0; l < grids.size(); ++l) {
        const std::string name = std::to_string(l);
        SVT_DO(
            folder.write(name + (version == 2 ? "/.zarray" : "/zarr.json"), zarrArrayJson(grids[l], *bits, version)));
        const volume::ColumnVolume& columns = l == 0 ? volume.columns : coarse[l - 1].columns;
        const std::string chunks = version == 2 ? name : name + "/c";
        SVT_DO(*bits == 8    ? writeArray<std::uint8_t>(columns, chunks, shape, options, folder)
               : *bits == 16 ? writeArray<std::uint16_t>(columns, chunks, shape, options, folder)
                             : writeArray<std::uint32_t>(columns, chunks, shape, options, folder));
    }
    return folder.commit();
}

}  // namespace

record::Members<ZarrWriteOptions> membersOf(const ZarrWriteOptions*) noexcept {
    using All = ZarrWriteOptions;
    static constexpr record::Member<All> kMembers[] = {
        record::memberAs<record::NumberChoice, &All::version>(
            "version", "of a .zarr: 2 (OME-NGFF 0.4) or 3 (OME-NGFF 0.5, sharded)",
            {.choices = "2|3", .group = "Output", .option = "--zarr"}),
    };
    return kMembers;
}

extern const VolumeFormat kZarr{.name = "zarr",
                                .endings = ".zarr",
                                .holds = "Zarr v2 or v3 with OME-NGFF: a folder with all levels, colours and names",
                                .readers = "zarr-python, zarrita, napari, neuroglancer, vizarr",
                                .content = FileContent::Nothing,
                                .isDense = true,
                                .write = writeZarr};

}  // namespace svt::writers
