#pragma once
/// \file
/// Deflate (RFC 1951), zlib (RFC 1950) and gzip (RFC 1952) in memory. The caller limits the unpacked size. No other
/// source of the library calls zlib.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace svt {

enum class DeflateFormat : std::uint8_t {
    Raw,        ///< one stream without header
    Zlib,       ///< one stream with header and checksum
    Gzip,       ///< one or more gzip members, concatenated
    ZlibOrGzip  ///< one zlib stream or one gzip member; its first bytes decide
};

enum class InflateStatus : std::uint8_t {
    Done,
    Damaged,
    CutShort,  ///< the data end before the stream ends
    TooLong    ///< more unpacked bytes than the limit
};

struct Inflated {
    InflateStatus status = InflateStatus::Done;
    std::size_t taken = 0;         ///< bytes of input used; fewer than all if other bytes follow the stream
    std::vector<std::byte> bytes;  ///< complete only if Done
};

/// CRC-32 as in ZIP and gzip. \param before  checksum of the preceding bytes
[[nodiscard]] std::uint32_t zipChecksum(std::span<const std::byte> bytes, std::uint32_t before = 0) noexcept;
/// The CRC-32 of two byte sequences joined. \param first, second  their checksums \param size  bytes of the second
[[nodiscard]] std::uint32_t joinedChecksum(std::uint32_t first, std::uint32_t second, std::uint64_t size) noexcept;

/// Unpacks `packed`. Verifies the checksum and the size at the end of each gzip member.
/// \param expectedBytes  estimate of the unpacked size, to reserve memory; beyond it the buffer doubles
/// \param maxBytes       limit of the unpacked size
/// Cost: about 3 s per GB unpacked. Memory: at most twice the unpacked size, and at most `maxBytes`.
[[nodiscard]] Inflated inflateBytes(std::span<const std::byte> packed, DeflateFormat format,
                                    std::uint64_t expectedBytes, std::uint64_t maxBytes);

/// Unpacks one stream, whose unpacked size must be out.size(). Ignores bytes after the stream.
/// \return false if the stream is damaged or has another size
[[nodiscard]] bool inflateInto(std::span<const std::byte> packed, DeflateFormat format, std::span<std::byte> out);

enum class InflateStep : std::uint8_t {
    End,    ///< end of the stream or gzip member
    More,   ///< there is more to unpack
    Stuck,  ///< more input or more space in the output is needed
    Damaged
};

/// Unpacks streams step by step.
class InflateStream {
public:
    explicit InflateStream(DeflateFormat format);
    InflateStream(InflateStream&&) noexcept;
    InflateStream& operator=(InflateStream&&) noexcept;
    ~InflateStream();

    /// Unpacks from the front of `packed` to the front of `out`. Both spans shrink by the bytes used.
    InflateStep step(std::span<const std::byte>& packed, std::span<std::byte>& out);
    /// Begins the next stream or member.
    void restart() noexcept;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Unpacks gzip data of one or more members piece by piece, with a constant amount of memory.
class GzipStream {
public:
    /// Unpacks `packed` and appends the result to `out`.
    /// \return Done: all of the piece was unpacked; Damaged: no further data can be unpacked
    InflateStatus append(std::span<const std::byte> packed, std::string& out);
    /// Whether the last member is complete. If it is not at the end of the data, the data are cut short.
    [[nodiscard]] bool isComplete() const noexcept { return isComplete_ && !isDamaged_; }

private:
    InflateStream stream_{DeflateFormat::Gzip};
    bool isComplete_ = true, isDamaged_ = false;
};

/// Compresses `bytes` to raw deflate data that end at a byte boundary, so that pieces can be compressed independently
/// and then joined.
/// \param bytes   less than 2 GiB
/// \param level   compression level of zlib, 1 to 9; -1: the default of zlib
/// \param isLast  whether the stream ends with this piece
[[nodiscard]] std::vector<std::byte> deflatePiece(std::span<const std::byte> bytes, int level, bool isLast);

/// One gzip member, without name and time, so equal input gives equal bytes.
/// \param bytes  less than 2 GiB
[[nodiscard]] std::vector<std::byte> gzipBytes(std::span<const std::byte> bytes);

/// Packs each piece into a separate zlib stream. Reuses one zlib state, because a new state costs more than packing a
/// small piece.
class ZlibPacker {
public:
    /// \param windowBits, memoryLevel  as in deflateInit2() of zlib
    explicit ZlibPacker(int level, int windowBits = 15, int memoryLevel = 8);
    ZlibPacker(ZlibPacker&&) noexcept;
    ZlibPacker& operator=(ZlibPacker&&) noexcept;
    ~ZlibPacker();

    /// \param bytes  less than 2 GiB
    /// \return the packed bytes, valid until the next call
    [[nodiscard]] std::span<const std::byte> pack(std::span<const std::byte> bytes);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace svt
