#pragma once
/// \file
/// The samples of a volume as one stream of bytes: x fastest, then y, then z, little-endian, in the smallest unsigned
/// type that holds all scalars. All dense formats are written from it. Columns are expanded slab by slab, so a volume
/// of any dense size takes some tens of MB.

#include <svt/core/file.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/dense.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace svt::writers {

struct StreamOptions {
    std::string_view stage;              ///< stage for progress
    int threads = 0;                     ///< maximum; 0: all cores. The bytes do not depend on it.
    const Progress* progress = nullptr;  ///< may be null
    double begin = 0, end = 1;           ///< range of the stream in the stage, 0 to 1
};

/// The options of a stream that covers the whole stage "write" of a format.
[[nodiscard]] inline StreamOptions writeStream(const VolumeWriteOptions& options) noexcept {
    return {.stage = "write", .threads = options.threads, .progress = options.progress};
}

/// \return nothing, or BadArgument if grid and columns differ in dimension
[[nodiscard]] Result<void> checkDimension(const volume::Grid& grid, const volume::ColumnVolume& columns);

/// \param left  remaining output in the message: "no file", or "nothing" for a folder
/// \return nothing, or Cancelled if the caller stopped the call
[[nodiscard]] Result<void> checkNotStopped(const Progress* progress, std::string_view left = "no file");

/// Bits of a sample: 8, 16 or 32.
/// \return the bits, or BadArgument if grid and columns differ in dimension or a scalar belongs to no label
[[nodiscard]] Result<int> checkedSampleBits(const volume::SemanticVolume& volume);

/// Size of all samples, bytes; below 2^51.
[[nodiscard]] std::uint64_t sampleBytes(Vec3i dimension, int bits) noexcept;

/// Takes the next bytes of the stream.
using SampleSink = std::function<Result<void>(std::span<const std::byte>)>;

/// Passes all samples to `sink`, in slabs of whole rows. Memory: 16 MB, or a row of tiles if that is more.
/// \param bits  result of checkedSampleBits()
/// \return nothing, or the first error of `sink`, or Cancelled
[[nodiscard]] Result<void> streamSamples(const volume::ColumnVolume& columns, int bits, const StreamOptions& options,
                                         const SampleSink& sink);

/// The stream cut into blocks that are compressed one by one (RFC 1950, zlib), for formats that state the sizes of the
/// compressed blocks before the blocks. Compressed blocks of up to 64 MB in total are kept; larger streams are
/// compressed again for writing.
class ZlibBlocks {
public:
    /// A block has `blockBytes`; the last one of each group of `groupBytes` has the remaining bytes. At most 16 MB per
    /// block.
    struct Layout {
        std::uint64_t groupBytes = 0, blockBytes = 0;
        [[nodiscard]] std::uint64_t blocksOfGroup() const noexcept {
            return (groupBytes + blockBytes - 1) / blockBytes;
        }
        [[nodiscard]] std::uint64_t sizeOf(std::uint64_t block) const noexcept;
    };

    /// \param columns  must outlive the blocks
    ZlibBlocks(const volume::ColumnVolume& columns, int bits, const Layout& layout, const StreamOptions& options)
        : columns_(columns), bits_(bits), layout_(layout), options_(options) {}

    /// Compresses all blocks. \return nothing, or Cancelled
    [[nodiscard]] Result<void> compress();
    /// Sizes of the compressed blocks, in order; available after compress().
    [[nodiscard]] const std::vector<std::uint64_t>& sizes() const noexcept { return sizes_; }
    /// Writes the compressed blocks. \return nothing, or CannotWrite, DiskFull, Cancelled
    [[nodiscard]] Result<void> write(AtomicFile& file);

private:
    using BlockSink = std::function<Result<void>(std::vector<std::byte>)>;
    [[nodiscard]] Result<void> forEach(const StreamOptions& options, const BlockSink& sink) const;

    const volume::ColumnVolume& columns_;
    int bits_;
    Layout layout_;
    StreamOptions options_;
    std::vector<std::uint64_t> sizes_;
    std::vector<std::vector<std::byte>> kept_;  // the first ones
    std::uint64_t keptBytes_ = 0;
    bool areAllKept_ = true;
};

}  // namespace svt::writers
