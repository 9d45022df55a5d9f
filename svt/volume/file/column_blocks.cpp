#include <svt/core/bytes.hpp>
#include <svt/core/parallel.hpp>
#include <svt/volume/column_blocks.hpp>
#include <svt/volume/columns/column_codec.hpp>
#include <svt/volume/file/bad_volume.hpp>
#include <svt/volume/file/zip_container.hpp>
#include <svt/volume/file/zstd_frame.hpp>

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <memory>
#include <optional>

namespace svt::volume {
namespace {

/// Streams of at least this many bytes get their own entropy tables.
constexpr std::size_t kOwnTables = 512;
constexpr std::uint32_t kMaxBlockBytes = 0xFFFFFFFFu;
static_assert(sizeof(ColumnBlock) == 16);

/// Maximum bytes of the streams in a frame of `size` bytes. zstd could reach higher ratios, real columns never do.
constexpr std::uint64_t maxStreamBytes(std::uint64_t size) noexcept { return (1u << 20) + 1024 * size; }

/// The tiles of a block.
struct BlockPlace {
    std::int32_t tileX = 0, tileY = 0;  // its first tile
    BlockShape shape;
};

/// The division of a volume into blocks.
class BlockLayout {
public:
    explicit BlockLayout(Vec3i dimension) noexcept : dimension_(dimension) {}

    [[nodiscard]] std::int32_t blocksX() const noexcept { return (dimension_.x + kColumns - 1) / kColumns; }
    [[nodiscard]] std::size_t count() const noexcept {
        return static_cast<std::size_t>(blocksX()) * static_cast<std::size_t>((dimension_.y + kColumns - 1) / kColumns);
    }
    [[nodiscard]] BlockPlace place(std::size_t number) const noexcept {
        const auto x = static_cast<std::int32_t>(number % static_cast<std::size_t>(blocksX()));
        const auto y = static_cast<std::int32_t>(number / static_cast<std::size_t>(blocksX()));
        return {x * kBlockTiles,
                y * kBlockTiles,
                {std::min(kColumns, dimension_.x - x * kColumns), std::min(kColumns, dimension_.y - y * kColumns),
                 dimension_.z}};
    }

private:
    static constexpr std::int32_t kColumns = kBlockTiles * ColumnVolume::kTileSize;
    Vec3i dimension_;
};

/// The lengths of the streams in LEB128, as stored before the streams.
std::vector<std::uint8_t> lengthsOf(const BlockStreams& streams) {
    std::vector<std::uint8_t> bytes;
    for (const auto& stream : streams) appendVarint(bytes, stream.size());
    return bytes;
}

using Compressor = std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)>;
using Decompressor = std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)>;

/// Appends bytes to a frame.
/// \return false if zstd fails, which happens only when it is out of memory
bool append(ZSTD_CCtx* context, ZSTD_outBuffer& out, std::span<const std::uint8_t> bytes, ZSTD_EndDirective directive) {
    ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
    while (true) {
        const std::size_t left = ZSTD_compressStream2(context, &out, &in, directive);
        if (ZSTD_isError(left)) return false;
        if (directive == ZSTD_e_continue ? in.pos == in.size : left == 0) return true;
    }
}

/// Compresses lengths and streams into one frame. Long streams end their zstd block, so that they have their own
/// entropy tables.
bool compress(ZSTD_CCtx* context, const BlockStreams& streams, ColumnBlock& block, std::vector<std::byte>& frame) {
    const std::vector<std::uint8_t> lengths = lengthsOf(streams);
    std::size_t total = lengths.size();
    for (const auto& stream : streams) total += stream.size();
    if (total > kMaxBlockBytes) return false;
    startFrame(context);
    ZSTD_CCtx_setPledgedSrcSize(context, total);
    frame.resize(ZSTD_compressBound(total) + 32 * (kBlockStreams + 1));
    ZSTD_outBuffer out{frame.data(), frame.size(), 0};
    bool isDone = append(context, out, lengths, ZSTD_e_continue);
    for (const auto& stream : streams)
        isDone = isDone && append(context, out, stream, stream.size() < kOwnTables ? ZSTD_e_continue : ZSTD_e_flush);
    if (!isDone || !append(context, out, {}, ZSTD_e_end)) return false;
    frame.resize(out.pos);
    frame.shrink_to_fit();
    block.size = static_cast<std::uint32_t>(frame.size());
    block.streamBytes = static_cast<std::uint32_t>(total);
    block.crc = crc32Of(frame);
    return true;
}

/// Splits decompressed bytes into the streams.
/// \return nullopt if the lengths do not match
std::optional<PerStream<std::span<const std::uint8_t>>> splitStreams(std::span<const std::uint8_t> bytes) {
    PerStream<std::uint64_t> lengths{};
    std::size_t at = 0;
    for (std::uint64_t& length : lengths) {
        for (int shift = 0;; shift += 7) {
            if (at == bytes.size() || shift > 28) return std::nullopt;
            const std::uint8_t byte = bytes[at++];
            length |= std::uint64_t{byte & 0x7Fu} << shift;
            if (byte < 0x80) break;
        }
    }
    PerStream<std::span<const std::uint8_t>> streams;
    for (std::size_t s = 0; s < kBlockStreams; ++s) {
        if (lengths[s] > bytes.size() - at) return std::nullopt;
        streams[s] = bytes.subspan(at, static_cast<std::size_t>(lengths[s]));
        at += streams[s].size();
    }
    if (at != bytes.size()) return std::nullopt;
    return streams;
}

}  // namespace

std::uint64_t maxArrayBytes(std::uint64_t frameBytes) noexcept {
    constexpr std::uint64_t kMaxBytes = std::uint64_t{16} << 30;
    return std::min((std::uint64_t{256} << 20) + 1024 * std::min(frameBytes, kMaxBytes), kMaxBytes);
}

Result<CompressedColumns> compressColumns(const ColumnVolume& columns, int threads) {
    const BlockLayout layout(columns.dimension());
    const auto tilesX = static_cast<std::size_t>(columns.tilesX());
    CompressedColumns result;
    result.index.resize(layout.count());
    result.frames.resize(layout.count());
    std::vector<std::uint64_t> arrayBytes(layout.count(), 0);
    std::atomic<bool> isDone = true;
    parallelFor(layout.count(), 1, threads, [&](std::size_t begin, std::size_t end) {
        const Compressor context(ZSTD_createCCtx(), ZSTD_freeCCtx);
        std::vector<ColumnTile> tiles;
        for (std::size_t b = begin; b < end; ++b) {
            const BlockPlace place = layout.place(b);
            tiles.clear();
            for (std::int32_t y = 0; y < place.shape.tilesY(); ++y)
                for (std::int32_t x = 0; x < place.shape.tilesX(); ++x)
                    tiles.push_back(columns.tiles()[static_cast<std::size_t>(place.tileX + x) +
                                                    tilesX * static_cast<std::size_t>(place.tileY + y)]);
            for (const ColumnTile& tile : tiles) arrayBytes[b] += arrayBytesOf(tile);
            if (!context ||
                !compress(context.get(), encodeBlock(tiles, place.shape), result.index[b], result.frames[b]))
                isDone = false;
        }
    });
    if (!isDone) return Error(Code::BadArgument, "the columns of a block take more than 4 GiB or more than the memory");
    std::uint64_t all = 0, allFrames = 0;
    for (std::size_t b = 0; b < layout.count(); ++b) {
        result.index[b].arrayBytes = static_cast<std::uint32_t>(std::min<std::uint64_t>(arrayBytes[b], kMaxBlockBytes));
        all += arrayBytes[b];
        allFrames += result.index[b].size;
        if (arrayBytes[b] >= kMaxBlockBytes || result.index[b].streamBytes > maxStreamBytes(result.index[b].size))
            return Error(Code::BadArgument, fmt::format("block {} of the columns takes {} bytes, which is over the "
                                                        "limit of a .svt; choose a larger spacing",
                                                        b, arrayBytes[b]));
    }
    if (const std::uint64_t most = maxArrayBytes(allFrames); all > most)
        return Error(Code::BadArgument,
                     fmt::format("the columns take {} bytes, {} are possible in a .svt of this size; choose a larger "
                                 "spacing",
                                 all, most));
    return result;
}

Result<ColumnBlocks> ColumnBlocks::open(Vec3i dimension, Scalar scalarCount, std::span<const std::byte> index,
                                        std::uint64_t frameBytes) {
    const BlockLayout layout(dimension);
    if (index.size() != layout.count() * sizeof(ColumnBlock))
        return badVolume(fmt::format("the index of the columns has {} bytes, {} blocks need {}", index.size(),
                                     layout.count(), layout.count() * sizeof(ColumnBlock)));
    ColumnBlocks blocks;
    blocks.dimension_ = dimension;
    blocks.scalarCount_ = scalarCount;
    blocks.blocks_.resize(layout.count());
    std::memcpy(blocks.blocks_.data(), index.data(), index.size());
    blocks.offsets_.reserve(layout.count());
    std::uint64_t offset = 0, arrayBytes = 0;
    for (std::size_t b = 0; b < layout.count(); ++b) {
        const ColumnBlock& block = blocks.blocks_[b];
        blocks.offsets_.push_back(offset);
        offset += block.size;
        arrayBytes += block.arrayBytes;
        if (block.streamBytes > maxStreamBytes(block.size))
            return badVolume(
                fmt::format("block {} of the columns: {} bytes cannot unpack to {}, at most {} are possible", b,
                            block.size, block.streamBytes, maxStreamBytes(block.size)));
    }
    if (offset != frameBytes)
        return badVolume(
            fmt::format("the frames of the columns have {} bytes, the index states {}", frameBytes, offset));
    if (const std::uint64_t most = maxArrayBytes(frameBytes); arrayBytes > most)
        return badVolume(fmt::format("the columns cannot take {} bytes, at most {} are possible in a file of this size",
                                     arrayBytes, most));
    return blocks;
}

std::size_t ColumnBlocks::blockOfTile(std::int32_t tileX, std::int32_t tileY) const noexcept {
    return static_cast<std::size_t>(tileX / kBlockTiles) +
           static_cast<std::size_t>(BlockLayout(dimension_).blocksX()) * static_cast<std::size_t>(tileY / kBlockTiles);
}

Result<std::vector<ColumnTileData>> ColumnBlocks::decodeBlock(std::size_t number,
                                                              std::span<const std::byte> frame) const {
    const ColumnBlock& block = blocks_[number];
    const auto wrong = [&](std::string_view reason) {
        return badVolume(
            fmt::format("block {} of the columns: {}; the file is damaged, build it again", number, reason));
    };
    if (frame.size() != block.size) return wrong("its frame is cut short");
    if (const std::uint32_t crc = crc32Of(frame); crc != block.crc)
        return Error(Code::BadChecksum, fmt::format("block {} of the columns has CRC32 {:08x}, {:08x} is expected: the "
                                                    "file is damaged. Copy it again or build the volume again.",
                                                    number, crc, block.crc));
    std::vector<std::uint8_t> bytes(block.streamBytes);
    const Decompressor context(ZSTD_createDCtx(), ZSTD_freeDCtx);
    if (!context || ZSTD_findFrameCompressedSize(frame.data(), frame.size()) != frame.size() ||
        ZSTD_decompressDCtx(context.get(), bytes.data(), bytes.size(), frame.data(), frame.size()) != bytes.size())
        return wrong("it is not a zstd frame of the size in the index");
    const auto streams = splitStreams(bytes);
    if (!streams) return wrong("the lengths of its streams do not fit");
    auto tiles =
        volume::decodeBlock(*streams, BlockLayout(dimension_).place(number).shape, scalarCount_, block.arrayBytes);
    if (!tiles) return wrong(tiles.error().message());
    return tiles;
}

Result<ColumnTileData> ColumnBlocks::decodeTile(std::int32_t tileX, std::int32_t tileY,
                                                std::span<const std::byte> frame) const {
    const std::size_t number = blockOfTile(tileX, tileY);
    SVT_TRY(tiles, decodeBlock(number, frame));
    const BlockPlace place = BlockLayout(dimension_).place(number);
    return std::move(
        (*tiles)[static_cast<std::size_t>((tileY - place.tileY) * place.shape.tilesX() + tileX - place.tileX)]);
}

Result<ColumnVolume> ColumnBlocks::decodeAll(std::span<const std::byte> frames, int threads) const {
    const BlockLayout layout(dimension_);
    const auto tilesX =
        static_cast<std::size_t>((dimension_.x + ColumnVolume::kTileSize - 1) / ColumnVolume::kTileSize);
    const auto tilesY =
        static_cast<std::size_t>((dimension_.y + ColumnVolume::kTileSize - 1) / ColumnVolume::kTileSize);
    std::vector<ColumnTileData> all(tilesX * tilesY);
    std::vector<std::optional<Error>> errors(count());
    parallelFor(count(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            const std::uint64_t from = std::min<std::uint64_t>(offsets_[b], frames.size());
            const std::uint64_t size = std::min<std::uint64_t>(blocks_[b].size, frames.size() - from);
            auto tiles = decodeBlock(b, frames.subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(size)));
            if (!tiles) {
                errors[b] = tiles.error();
                continue;
            }
            const BlockPlace place = layout.place(b);
            for (std::size_t t = 0; t < tiles->size(); ++t) {
                const std::size_t x = static_cast<std::size_t>(place.tileX) + t % std::size_t(place.shape.tilesX());
                const std::size_t y = static_cast<std::size_t>(place.tileY) + t / std::size_t(place.shape.tilesX());
                all[x + tilesX * y] = std::move((*tiles)[t]);
            }
        }
    });
    for (const auto& error : errors)
        if (error) return *error;
    return ColumnVolume::fromTiles(dimension_, std::move(all));
}

}  // namespace svt::volume
