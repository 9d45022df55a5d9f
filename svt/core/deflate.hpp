#pragma once
/// \file
/// Deflate (RFC 1951) and gzip (RFC 1952) in memory. Unpacked sizes are bounded by the caller.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace svt {

enum class DeflateFormat : std::uint8_t {
    Raw,  ///< one stream without header
    Gzip  ///< one or more gzip members, concatenated
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

/// Unpacks `packed`. Each gzip member is checked against the checksum and the size at its end.
/// \param expectedBytes  guess of the size, to reserve memory; the buffer doubles beyond it
/// \param maxBytes       limit of the size
/// Cost: about 3 s per GB unpacked. Memory: twice the unpacked size at most, and at most `maxBytes`.
[[nodiscard]] Inflated inflateBytes(std::span<const std::byte> packed, DeflateFormat format,
                                    std::uint64_t expectedBytes, std::uint64_t maxBytes);

/// Unpacks gzip data piece by piece, of one or more members, in memory of its own that does not grow.
class GzipStream {
public:
    GzipStream();
    GzipStream(GzipStream&&) noexcept;
    GzipStream& operator=(GzipStream&&) noexcept;
    ~GzipStream();

    /// Appends to `out` what `packed` unpacks to.
    /// \return Done: the piece is used up; Damaged: nothing more can be unpacked
    InflateStatus append(std::span<const std::byte> packed, std::string& out);
    /// Whether the last member is complete: where the data end, so that CutShort is the word for anything else.
    [[nodiscard]] bool isComplete() const noexcept;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Raw deflate data of `bytes` that end at a byte boundary, so that pieces that were made independently can be joined.
/// \param bytes   less than 2 GiB
/// \param level   of zlib, 1 to 9; -1: its default
/// \param isLast  whether the stream ends with this piece
[[nodiscard]] std::vector<std::byte> deflatePiece(std::span<const std::byte> bytes, int level, bool isLast);

/// One gzip member, without name and time, so equal input gives equal bytes.
/// \param bytes  less than 2 GiB
[[nodiscard]] std::vector<std::byte> gzipBytes(std::span<const std::byte> bytes);

}  // namespace svt
