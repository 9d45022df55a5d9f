#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/precomputed/precomputed_shards.hpp>

#include <svt/core/deflate.hpp>
#include <svt/core/parallel.hpp>
#include <svt/volume/dense.hpp>
#include <svt/writers/dense/piece_writer.hpp>
#include <svt/writers/precomputed/precomputed_writer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace svt::writers {
namespace {

constexpr int kChunkBits = 3, kMinishardBits = 3;

struct ChunkPlace {
    std::uint64_t code = 0;
    Vec3i place;
};

std::vector<std::byte> packedChunk(const volume::ColumnVolume& columns, Vec3i place, std::int32_t side) {
    const Vec3i first = place * side;
    Vec3i end = first + Vec3i{side, side, side};
    for (int axis = 0; axis < 3; ++axis) end[axis] = std::min(end[axis], columns.dimension()[axis]);
    const Vec3i size = end - first;
    std::vector<std::uint32_t> samples(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z));
    volume::copyBox<std::uint32_t>(columns, {first.y, end.y, first.z, end.z, first.x, end.x}, samples, 1);
    const std::vector<std::uint32_t> words = compressSegmentation(samples, size);
    return gzipBytes(std::as_bytes(std::span(words)));
}

/// The index of a minishard: codes, places and sizes of its chunks, each stored as the difference to the previous one.
std::vector<std::byte> packedIndex(std::span<const ChunkPlace> chunks, std::span<const std::uint64_t> sizes,
                                   std::uint64_t begin) {
    std::string codes, starts, lengths;
    for (std::size_t n = 0; n < chunks.size(); ++n) {
        appendBytes(codes, chunks[n].code - (n == 0 ? 0 : chunks[n - 1].code));
        appendBytes(starts, n == 0 ? begin : std::uint64_t{0});  // one behind the other
        appendBytes(lengths, sizes[n]);
    }
    const std::string index = codes + starts + lengths;
    return gzipBytes(std::as_bytes(std::span(index)));
}

/// A shard: where the indices of its minishards are, its chunks, these indices. Places count from behind the first
/// part.
std::string shardBytes(std::span<const ChunkPlace> chunks, const std::vector<std::vector<std::byte>>& packed,
                       const ShardBits& bits) {
    std::string data;
    std::vector<std::uint64_t> begins, sizes;
    const auto append = [&](const std::vector<std::byte>& bytes) {
        data.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    for (const auto& bytes : packed) {
        begins.push_back(data.size());
        sizes.push_back(bytes.size());
        append(bytes);
    }
    std::string head;
    std::size_t n = 0;
    for (std::uint64_t minishard = 0; minishard < std::uint64_t{1} << bits.minishard; ++minishard) {
        const std::size_t first = n;
        while (n < chunks.size() && (chunks[n].code >> bits.chunk & ((1u << bits.minishard) - 1)) == minishard) ++n;
        const std::uint64_t begin = data.size();
        if (n > first)
            append(packedIndex(chunks.subspan(first, n - first), std::span(sizes).subspan(first, n - first),
                               begins[first]));
        appendBytes(head, begin);
        appendBytes(head, static_cast<std::uint64_t>(data.size()));
    }
    return head + data;
}

}  // namespace

ShardBits ShardBits::of(Vec3i chunks) {
    int all = 0;
    for (int axis = 0; axis < 3; ++axis)
        for (int bit = 0; std::int64_t{1} << bit < chunks[axis]; ++bit) ++all;
    ShardBits bits;
    bits.chunk = std::min(all, kChunkBits);
    bits.minishard = std::min(all - bits.chunk, kMinishardBits);
    bits.shard = all - bits.chunk - bits.minishard;
    return bits;
}

std::uint64_t mortonCode(Vec3i place, Vec3i chunks) noexcept {
    std::uint64_t code = 0;
    int to = 0;
    for (int bit = 0; bit < 31; ++bit)
        for (int axis = 0; axis < 3; ++axis)
            if (std::int64_t{1} << bit < chunks[axis])
                code |= static_cast<std::uint64_t>(place[axis] >> bit & 1) << to++;
    return code;
}

Result<void> writeShards(const volume::ColumnVolume& columns, std::int32_t side, const std::string& key,
                         const VolumeWriteOptions& options, NewFolder& folder) {
    Vec3i count;
    for (int axis = 0; axis < 3; ++axis) count[axis] = (columns.dimension()[axis] + side - 1) / side;
    std::vector<ChunkPlace> chunks;
    for (std::int32_t z = 0; z < count.z; ++z)
        for (std::int32_t y = 0; y < count.y; ++y)
            for (std::int32_t x = 0; x < count.x; ++x) chunks.push_back({mortonCode({x, y, z}, count), {x, y, z}});
    std::sort(chunks.begin(), chunks.end(), [](const ChunkPlace& a, const ChunkPlace& b) { return a.code < b.code; });
    const ShardBits bits = ShardBits::of(count);
    const int inside = bits.chunk + bits.minishard;
    for (std::size_t begin = 0, end = 0; begin < chunks.size(); begin = end) {
        SVT_DO(checkNotStopped(options.progress, "nothing"));
        Progress::tell(options.progress, "write", double(begin) / double(chunks.size()));
        const std::uint64_t shard = chunks[begin].code >> inside;
        while (end < chunks.size() && chunks[end].code >> inside == shard) ++end;
        std::vector<std::vector<std::byte>> packed(end - begin);
        parallelFor(packed.size(), 1, options.threads, [&](std::size_t from, std::size_t to) {
            for (std::size_t n = from; n < to; ++n) packed[n] = packedChunk(columns, chunks[begin + n].place, side);
        });
        const std::string name = fmt::format("{}/{:0{}x}.shard", key, shard, std::max(1, (bits.shard + 3) / 4));
        SVT_DO(folder.write(name, shardBytes(std::span(chunks).subspan(begin, end - begin), packed, bits)));
    }
    return {};
}

}  // namespace svt::writers
