#pragma once
/// \file
/// Decompressors of chunks: each gets the bytes that are stored, and must give exactly as many as are expected.

#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace svt::volume_readers {

/// What one step of a chain of codecs does.
enum class CodecKind : std::uint8_t { Zlib, Gzip, Zstd, Lz4, Blosc, Crc32c };

/// Bytes that a compressed chunk may at most become; none of the codecs says more of itself than it must.
inline constexpr std::uint64_t kMostChunkBytes = std::uint64_t{1} << 30;

/// Unpacks `stored` into exactly `size` bytes. zlib and gzip (RFC 1950, 1952), zstd frames, LZ4 blocks behind their size
/// (numcodecs), Blosc 1 with LZ4, zlib or zstd inside, with or without shuffle of bytes and bits. Crc32c checks four bytes at
/// the end and takes them off.
/// \param size  at most kMostChunkBytes; of Crc32c the result may have any size, `size` is not looked at
/// \return the bytes, or BadImage that says what is wrong
[[nodiscard]] Result<std::vector<std::byte>> unpackChunk(CodecKind codec, std::span<const std::byte> stored,
                                                         std::uint64_t size);

}  // namespace svt::volume_readers
