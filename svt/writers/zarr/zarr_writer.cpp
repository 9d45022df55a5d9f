#include <svt/core/check.hpp>
#include <svt/core/parallel.hpp>
#include <svt/writers/dense/coarser_levels.hpp>
#include <svt/writers/dense/format_options.hpp>
#include <svt/writers/dense/new_folder.hpp>
#include <svt/writers/dense/sample_band.hpp>
#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/volume_formats.hpp>
#include <svt/writers/zarr/zarr_metadata.hpp>
#include <svt/writers/zarr/zarr_writer.hpp>

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
                        const DenseOptions& options, NewFolder& to) {
    const Vec3i dimension = columns.dimension();
    for (std::int32_t k = 0; k < dimension.z; k += shape.file) {
        Progress::tell(options.progress, "write", double(k) / dimension.z);
        for (std::int32_t j = 0; j < dimension.y; j += shape.file) {
            if (Progress::isCancelled(options.progress))
                return Error(Code::Cancelled, "writing the volume was stopped; nothing was left");
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

}  // namespace

Result<std::uint64_t> writeZarr(const volume::SemanticVolume& volume, const fs::path& path, int version,
                                const DenseOptions& options) {
    SVT_TRY(bits, checkedSampleBits(volume));
    SVT_CHECK(version == 2 || version == 3);
    NewFolder folder(path);
    SVT_DO(folder.create());
    SVT_TRY(coarser, coarserLevels(volume, options.threads));
    const std::vector<volume::SemanticVolume>& coarse = *coarser;
    std::vector<volume::Grid> grids{volume.grid};
    for (const volume::SemanticVolume& level : coarse) grids.push_back(level.grid);
    if (version == 2)
        if (auto done = folder.write(".zgroup", "{\"zarr_format\": 2}\n"); !done) return done.error();
    SVT_DO(folder.write(version == 2 ? ".zattrs" : "zarr.json", zarrGroupJson(volume, grids, version)));
    const ZarrShape shape = zarrShape(version);
    for (std::size_t l = 0; l < grids.size(); ++l) {
        const std::string name = std::to_string(l);
        if (auto done = folder.write(name + (version == 2 ? "/.zarray" : "/zarr.json"),
                                     zarrArrayJson(grids[l], *bits, version));
            !done)
            return done.error();
        const volume::ColumnVolume& columns = l == 0 ? volume.columns : coarse[l - 1].columns;
        const std::string chunks = version == 2 ? name : name + "/c";
        SVT_TRY(done, *bits == 8    ? writeArray<std::uint8_t>(columns, chunks, shape, options, folder)
                      : *bits == 16 ? writeArray<std::uint16_t>(columns, chunks, shape, options, folder)
                                    : writeArray<std::uint32_t>(columns, chunks, shape, options, folder));
    }
    return folder.commit();
}

extern const VolumeFormat kZarr{.name = "zarr",
                                .endings = ".zarr",
                                .holds = "Zarr v2 or v3 with OME-NGFF: a folder with all levels, colours and names",
                                .readers = "zarr-python, zarrita, napari, neuroglancer, vizarr",
                                .content = FileContent::Nothing,
                                .isDense = true,
                                .write = [](const auto& volume, const auto& path, const auto& options) {
                                    return writeZarr(volume, path, options.zarrVersion, denseOptions(options));
                                }};

}  // namespace svt::writers
