#pragma once
/// \file
/// Decompressors of chunks: each gets the stored bytes, and must return exactly the expected number.

#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace svt::volume_readers {

/// One step of a chain of codecs.
enum class CodecKind : std::uint8_t { Zlib, Gzip, Zstd, Lz4, Blosc, Crc32c };

/// Maximum number of bytes of an unpacked chunk, for all codecs.
inline constexpr std::uint64_t kMostChunkBytes = std::uint64_t{1} << 30;

/// Unpacks `stored` into exactly `size` bytes. zlib and gzip (RFC 1950, 1952), zstd frames, LZ4 blocks after their size
/// (numcodecs), Blosc 1 with LZ4, zlib or zstd inside, with or without shuffle of bytes and bits. Crc32c checks the
/// four bytes at the end and removes them.
/// \param size  at most kMostChunkBytes; Crc32c ignores it, and its result may have any size
/// \return the bytes, or BadImage with the problem
[[nodiscard]] Result<std::vector<std::byte>> unpackChunk(CodecKind codec, std::span<const std::byte> stored,
                                                         std::uint64_t size);

}  // namespace svt::volume_readers
