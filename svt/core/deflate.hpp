#pragma once
/// \file
/// Deflate (RFC 1951), zlib (RFC 1950) and gzip (RFC 1952) in memory. Unpacked sizes are bounded by the caller. No other
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
    CutShort,  ///< the data end before the stream does
    TooLong    ///< more bytes than the limit
};

struct Inflated {
    InflateStatus status = InflateStatus::Done;
    std::size_t taken = 0;         ///< bytes of the input that were read; fewer than there are if others follow the end
    std::vector<std::byte> bytes;  ///< whole only if Done
};

/// CRC-32 as ZIP and gzip have it. \param before  that of the bytes before these
[[nodiscard]] std::uint32_t zipChecksum(std::span<const std::byte> bytes, std::uint32_t before = 0) noexcept;
/// The CRC-32 of two sequences of bytes as one. \param first, second  their checksums \param size  bytes of the second
[[nodiscard]] std::uint32_t joinedChecksum(std::uint32_t first, std::uint32_t second, std::uint64_t size) noexcept;

/// Unpacks `packed`. Each gzip member is checked against the checksum and the size at its end.
/// \param expectedBytes  guess of the size, to reserve memory; the buffer doubles beyond it
/// \param maxBytes       limit of the size
/// Cost: about 3 s per GB unpacked. Memory: twice the unpacked size at most, and at most `maxBytes`.
[[nodiscard]] Inflated inflateBytes(std::span<const std::byte> packed, DeflateFormat format,
                                    std::uint64_t expectedBytes, std::uint64_t maxBytes);

/// Unpacks one stream, which must have out.size() bytes. Bytes behind the stream are ignored.
/// \return false for a damaged stream, or one of another size
[[nodiscard]] bool inflateInto(std::span<const std::byte> packed, DeflateFormat format, std::span<std::byte> out);

enum class InflateStep : std::uint8_t {
    End,    ///< end of the stream or gzip member
    More,   ///< there is more to unpack
    Stuck,  ///< it needs more input or room to go on
    Damaged
};

/// Unpacks streams step by step.
class InflateStream {
public:
    explicit InflateStream(DeflateFormat format);
    InflateStream(InflateStream&&) noexcept;
    InflateStream& operator=(InflateStream&&) noexcept;
    ~InflateStream();

    /// Unpacks from the front of `packed` to the front of `out`. Both shrink by the bytes that were used.
    InflateStep step(std::span<const std::byte>& packed, std::span<std::byte>& out);
    /// Begins the next stream or member.
    void restart() noexcept;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Unpacks gzip data piece by piece, of one or more members, in memory of its own that does not grow.
class GzipStream {
public:
    /// Appends to `out` what `packed` unpacks to.
    /// \return Done: the piece is used up; Damaged: nothing more can be unpacked
    InflateStatus append(std::span<const std::byte> packed, std::string& out);
    /// Whether the last member is complete: where the data end, so that CutShort is the word for anything else.
    [[nodiscard]] bool isComplete() const noexcept { return isComplete_ && !isDamaged_; }

private:
    InflateStream stream_{DeflateFormat::Gzip};
    bool isComplete_ = true, isDamaged_ = false;
};

/// Raw deflate data of `bytes` that end at a byte boundary, so that pieces that were made independently can be joined.
/// \param bytes   less than 2 GiB
/// \param level   of zlib, 1 to 9; -1: its default
/// \param isLast  whether the stream ends with this piece
[[nodiscard]] std::vector<std::byte> deflatePiece(std::span<const std::byte> bytes, int level, bool isLast);

/// One gzip member, without name and time, so equal input gives equal bytes.
/// \param bytes  less than 2 GiB
[[nodiscard]] std::vector<std::byte> gzipBytes(std::span<const std::byte> bytes);

/// Packs pieces, each into a zlib stream of its own. It keeps one state: a new one costs more than a small piece.
class ZlibPacker {
public:
    /// \param windowBits, memoryLevel  of deflateInit2() of zlib
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
