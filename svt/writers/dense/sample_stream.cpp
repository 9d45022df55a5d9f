#include <svt/core/deflate.hpp>
#include <svt/core/parallel.hpp>
#include <svt/writers/dense/sample_stream.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

namespace svt::writers {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are written as they stand in memory");

constexpr std::uint64_t kSlabBytes = std::uint64_t{16} << 20;
constexpr std::uint64_t kKeptBytes = std::uint64_t{64} << 20;
constexpr int kBlockLevel = 5;

template <class T>
Result<void> streamAs(const volume::ColumnVolume& columns, const StreamOptions& options, const SampleSink& sink) {
    const Vec3i dimension = columns.dimension();
    const std::uint64_t rowBytes = std::uint64_t(dimension.x) * sizeof(T);
    const std::uint64_t sliceBytes = rowBytes * std::uint64_t(dimension.y);
    // Several slices at once; if one slice is too large, bands of whole tiles of one slice.
    const auto slices = static_cast<std::int32_t>(
        std::clamp<std::uint64_t>(kSlabBytes / sliceBytes, 1, static_cast<std::uint64_t>(dimension.z)));
    constexpr std::int32_t kTile = volume::ColumnVolume::kTileSize;
    const auto bandTiles = std::max<std::uint64_t>(1, kSlabBytes / (rowBytes * kTile));
    const auto rows = sliceBytes <= kSlabBytes ? dimension.y
                                               : static_cast<std::int32_t>(std::min<std::uint64_t>(
                                                     bandTiles * kTile, static_cast<std::uint64_t>(dimension.y)));
    std::vector<T> slab;
    for (std::int32_t k = 0; k < dimension.z; k += slices) {
        for (std::int32_t j = 0; j < dimension.y; j += rows) {
            SVT_DO(checkNotStopped(options.progress));
            const volume::DenseBox box{j, std::min(j + rows, dimension.y), k, std::min(k + slices, dimension.z)};
            slab.resize(std::size_t(dimension.x) * std::size_t(box.jEnd - box.jBegin) *
                        std::size_t(box.kEnd - box.kBegin));
            volume::copyBox<T>(columns, box, slab, options.threads);
            SVT_DO(sink(std::as_bytes(std::span(slab))));
        }
        const double share = double(std::min(k + slices, dimension.z)) / dimension.z;
        Progress::tell(options.progress, options.stage, options.begin + (options.end - options.begin) * share);
    }
    return {};
}

}  // namespace

Result<void> checkDimension(const volume::Grid& grid, const volume::ColumnVolume& columns) {
    const Vec3i expected = grid.dimension(), found = columns.dimension();
    if (expected == found) return {};
    return Error(Code::BadArgument, fmt::format("the grid has {} x {} x {} samples, the columns have {} x {} x {}",
                                                expected.x, expected.y, expected.z, found.x, found.y, found.z));
}

Result<void> checkNotStopped(const Progress* progress, std::string_view left) {
    if (!Progress::isCancelled(progress)) return {};
    return Error(Code::Cancelled, fmt::format("writing the volume was stopped; {} was left", left));
}

Result<int> checkedSampleBits(const volume::SemanticVolume& volume) {
    SVT_DO(checkDimension(volume.grid, volume.columns));
    const volume::Scalar largest = volume::largestScalar(volume.columns);
    if (largest >= volume.labels.scalarCount())
        return Error(Code::BadArgument, fmt::format("scalar {} belongs to no label", largest));
    return volume.labels.scalarBits();
}

std::uint64_t sampleBytes(Vec3i dimension, int bits) noexcept {
    return std::uint64_t(dimension.x) * std::uint64_t(dimension.y) * std::uint64_t(dimension.z) *
           static_cast<std::uint64_t>(bits / 8);
}

Result<void> streamSamples(const volume::ColumnVolume& columns, int bits, const StreamOptions& options,
                           const SampleSink& sink) {
    return bits == 8    ? streamAs<std::uint8_t>(columns, options, sink)
           : bits == 16 ? streamAs<std::uint16_t>(columns, options, sink)
                        : streamAs<std::uint32_t>(columns, options, sink);
}

std::uint64_t ZlibBlocks::Layout::sizeOf(std::uint64_t block) const noexcept {
    return std::min(blockBytes, groupBytes - block % blocksOfGroup() * blockBytes);
}

Result<void> ZlibBlocks::forEach(const StreamOptions& options, const BlockSink& sink) const {
    std::uint64_t next = 0;  // the block that begins next
    std::vector<std::byte> pending;
    return streamSamples(columns_, bits_, options, [&](std::span<const std::byte> bytes) -> Result<void> {
        pending.insert(pending.end(), bytes.begin(), bytes.end());
        std::vector<std::span<const std::byte>> whole;
        std::size_t at = 0;
        for (std::uint64_t size = layout_.sizeOf(next); at + size <= pending.size() && size > 0;
             size = layout_.sizeOf(++next)) {
            whole.push_back(std::span(pending).subspan(at, size));
            at += size;
        }
        std::vector<std::vector<std::byte>> compressed(whole.size());
        parallelFor(whole.size(), 1, options.threads, [&](std::size_t begin, std::size_t end) {
            ZlibPacker packer(kBlockLevel);
            for (std::size_t b = begin; b < end; ++b) {
                const auto packed = packer.pack(whole[b]);
                compressed[b].assign(packed.begin(), packed.end());
            }
        });
        for (std::vector<std::byte>& block : compressed) SVT_DO(sink(std::move(block)));
        pending.erase(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(at));
        return {};
    });
}

Result<void> ZlibBlocks::compress() {
    StreamOptions options = options_;
    options.end = (options_.begin + options_.end) / 2;
    return forEach(options, [&](std::vector<std::byte> block) -> Result<void> {
        sizes_.push_back(block.size());
        keptBytes_ += block.size();
        areAllKept_ = areAllKept_ && keptBytes_ <= kKeptBytes;
        if (areAllKept_)
            kept_.push_back(std::move(block));
        else
            kept_ = {};
        return {};
    });
}

Result<void> ZlibBlocks::write(AtomicFile& file) {
    if (areAllKept_) {
        for (const std::vector<std::byte>& block : kept_) SVT_DO(file.write(block));
        return {};
    }
    StreamOptions options = options_;
    options.begin = (options_.begin + options_.end) / 2;
    return forEach(options, [&](const std::vector<std::byte>& block) { return file.write(block); });
}

}  // namespace svt::writers
