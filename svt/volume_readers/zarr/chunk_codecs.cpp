#include <svt/volume_readers/zarr/chunk_codecs.hpp>

#include <svt/core/bytes.hpp>
#include <svt/core/deflate.hpp>

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>

namespace svt::volume_readers {
namespace {

using ChunkBytes = std::vector<std::byte>;

Error badChunk(std::string_view codec) {
    return {Code::BadImage, fmt::format("a chunk is damaged: its {} does not unpack to the size of a chunk", codec)};
}

bool unzstdInto(std::span<const std::byte> stored, std::span<std::byte> out) {
    const std::size_t size = ZSTD_decompress(out.data(), out.size(), stored.data(), stored.size());
    return ZSTD_isError(size) == 0 && size == out.size();
}

/// A block of LZ4: https://github.com/lz4/lz4/blob/dev/doc/lz4_Block_format.md
bool unlz4Into(std::span<const std::byte> in, std::span<std::byte> out) {
    std::size_t at = 0, made = 0;
    const auto lengthFrom = [&](std::size_t nibble, std::size_t& length) {
        length = nibble;
        if (nibble != 15) return true;
        for (std::size_t more = 255; more == 255; length += more) {
            if (at == in.size()) return false;
            more = static_cast<std::size_t>(in[at++]);
        }
        return true;
    };
    while (at < in.size()) {
        const auto token = static_cast<std::size_t>(in[at++]);
        std::size_t literals = 0, match = 0;
        if (!lengthFrom(token >> 4, literals) || literals > in.size() - at || literals > out.size() - made)
            return false;
        std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(at), literals,
                    out.begin() + static_cast<std::ptrdiff_t>(made));
        at += literals;
        made += literals;
        if (at == in.size()) break;  // the last sequence has no match
        if (in.size() - at < 2) return false;
        const std::size_t offset = static_cast<std::size_t>(in[at]) | static_cast<std::size_t>(in[at + 1]) << 8;
        at += 2;
        if (!lengthFrom(token & 15, match)) return false;
        match += 4;
        if (offset == 0 || offset > made || match > out.size() - made) return false;
        for (std::size_t n = 0; n < match; ++n, ++made) out[made] = out[made - offset];
    }
    return made == out.size();
}

bool unpackInner(int format, std::span<const std::byte> stored, std::span<std::byte> out) {
    if (stored.size() == out.size()) {
        std::copy(stored.begin(), stored.end(), out.begin());
        return true;
    }
    return format == 1   ? unlz4Into(stored, out)
           : format == 3 ? inflateInto(stored, DeflateFormat::ZlibOrGzip, out)
                         : unzstdInto(stored, out);
}

/// Byte b of each item follows all bytes b - 1.
void unshuffle(std::span<const std::byte> in, std::span<std::byte> out, std::size_t itemSize) {
    const std::size_t items = in.size() / itemSize;
    for (std::size_t b = 0; b < itemSize; ++b)
        for (std::size_t n = 0; n < items; ++n) out[n * itemSize + b] = in[b * items + n];
    std::copy(in.begin() + static_cast<std::ptrdiff_t>(items * itemSize), in.end(),
              out.begin() + static_cast<std::ptrdiff_t>(items * itemSize));
}

/// Bit b of each item follows all bits b - 1, for whole groups of eight items.
void unshuffleBits(std::span<const std::byte> in, std::span<std::byte> out, std::size_t itemSize) {
    const std::size_t items = in.size() / itemSize / 8 * 8, rowBytes = items / 8;
    std::copy(in.begin(), in.end(), out.begin());
    std::fill_n(out.begin(), items * itemSize, std::byte{0});
    for (std::size_t bit = 0; bit < itemSize * 8; ++bit)
        for (std::size_t n = 0; n < items; ++n)
            if ((in[bit * rowBytes + n / 8] >> static_cast<int>(n % 8) & std::byte{1}) != std::byte{0})
                out[n * itemSize + bit / 8] |= std::byte{1} << static_cast<int>(bit % 8);
}

/// A block of Blosc: one stream, or one stream per byte of an item.
bool unpackBlock(std::span<const std::byte> in, std::size_t at, int format, std::size_t splits,
                 std::span<std::byte> out) {
    for (std::size_t s = 0; s < splits; ++s) {
        if (at > in.size() || in.size() - at < 4) return false;
        const std::size_t size = loadBytes<std::uint32_t>(in, at);
        at += 4;
        if (size > in.size() - at) return false;
        const std::size_t part = out.size() / splits;
        if (!unpackInner(format, in.subspan(at, size), out.subspan(s * part, part))) return false;
        at += size;
    }
    return true;
}

/// https://github.com/Blosc/c-blosc/blob/main/README_CHUNK_FORMAT.rst
Result<ChunkBytes> unblosc(std::span<const std::byte> in, std::uint64_t size) {
    if (in.size() < 16) return badChunk("Blosc");
    const auto flags = static_cast<unsigned>(in[2]);
    const std::size_t itemSize = std::max<std::size_t>(1, static_cast<std::size_t>(in[3]));
    const std::size_t plain = loadBytes<std::uint32_t>(in, 4), blockSize = loadBytes<std::uint32_t>(in, 8),
                      stored = loadBytes<std::uint32_t>(in, 12);
    const auto format = static_cast<int>(flags >> 5);
    if (plain != size || stored > in.size() || blockSize == 0 || blockSize > kMostChunkBytes) return badChunk("Blosc");
    ChunkBytes out(plain);
    if ((flags & 2) != 0) {  // copied as it was
        if (in.size() - 16 < plain) return badChunk("Blosc");
        std::copy_n(in.begin() + 16, plain, out.begin());
        return out;
    }
    if (format != 1 && format != 3 && format != 4)
        return Error(Code::BadImage,
                     fmt::format("the chunks are Blosc with {} inside, which cannot be read; LZ4, zlib and zstd can",
                                 format == 0   ? "BloscLZ"
                                 : format == 2 ? "Snappy"
                                               : "something unknown"));
    const std::size_t blocks = (plain + blockSize - 1) / blockSize;
    if (blocks > (in.size() - 16) / 4) return badChunk("Blosc");
    ChunkBytes block;
    for (std::size_t b = 0; b < blocks; ++b) {
        const std::size_t begin = b * blockSize, length = std::min(blockSize, plain - begin);
        const bool isSplit = (flags & 16) == 0 && length == blockSize && itemSize <= 16 && length / itemSize >= 128;
        block.assign(length, std::byte{0});
        if (!unpackBlock(in, loadBytes<std::uint32_t>(in, 16 + 4 * b), format, isSplit ? itemSize : 1, block))
            return badChunk("Blosc");
        const std::span<std::byte> to = std::span(out).subspan(begin, length);
        if ((flags & 1) != 0 && itemSize > 1)
            unshuffle(block, to, itemSize);
        else if ((flags & 4) != 0)
            unshuffleBits(block, to, itemSize);
        else
            std::copy(block.begin(), block.end(), to.begin());
    }
    return out;
}

std::uint32_t crc32cOf(std::span<const std::byte> bytes) noexcept {
    std::uint32_t crc = ~0u;
    for (const std::byte byte : bytes) {
        crc ^= static_cast<std::uint32_t>(byte);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (0x82F63B78u & (0u - (crc & 1u)));
    }
    return ~crc;
}

}  // namespace

Result<std::vector<std::byte>> unpackChunk(CodecKind codec, std::span<const std::byte> stored, std::uint64_t size) {
    if (codec == CodecKind::Crc32c) {
        if (stored.size() < 4 ||
            crc32cOf(stored.first(stored.size() - 4)) != loadBytes<std::uint32_t>(stored, stored.size() - 4))
            return Error(Code::BadImage, "a chunk is damaged: its checksum (CRC-32C) differs");
        return ChunkBytes(stored.begin(), stored.end() - 4);
    }
    if (size > kMostChunkBytes || stored.size() > kMostChunkBytes)
        return Error(Code::BadImage, "a chunk has more than 1 GiB; write the array with smaller chunks");
    if (codec == CodecKind::Blosc) return unblosc(stored, size);
    // The maximum ratio of deflate is 1032; zstd and LZ4 store the unpacked size.
    if ((codec == CodecKind::Zlib || codec == CodecKind::Gzip) && size / 1032 > stored.size()) return badChunk("zlib");
    if (codec == CodecKind::Lz4 &&
        (stored.size() < 4 || loadBytes<std::uint32_t>(stored, 0) != size || size / 255 > stored.size()))
        return badChunk("LZ4");
    ChunkBytes out(static_cast<std::size_t>(size));
    switch (codec) {
        case CodecKind::Zlib:
        case CodecKind::Gzip:
            if (!inflateInto(stored, DeflateFormat::ZlibOrGzip, out)) return badChunk("zlib");
            break;
        case CodecKind::Zstd:
            if (!unzstdInto(stored, out)) return badChunk("zstd");
            break;
        case CodecKind::Lz4:
            if (!unlz4Into(stored.subspan(4), out)) return badChunk("LZ4");
            break;
        case CodecKind::Blosc:
        case CodecKind::Crc32c: break;
    }
    return out;
}

}  // namespace svt::volume_readers
