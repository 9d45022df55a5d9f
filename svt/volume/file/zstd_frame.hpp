#pragma once
/// \file
/// Numbers in one zstd frame with known content size: the format of the small entries of a `.svt`.

#include <svt/core/bytes.hpp>
#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

struct ZSTD_CCtx_s;

namespace svt::volume {

/// Prepares a context for a frame of a file. All parameters that affect the bytes are the same on every machine.
void startFrame(ZSTD_CCtx_s* context);

/// Maximum unpacked size of any frame, bytes.
inline constexpr std::uint64_t kMaxNumberBytes = 0xFFFFFFFFu;

/// Writes 32-bit numbers in LEB128, and single bytes.
class NumberWriter {
public:
    void number(std::uint32_t value) { appendVarint(bytes_, value); }
    /// Zigzag code of value - before modulo 2^32, so that every difference fits into 32 bits.
    void difference(std::uint32_t value, std::uint32_t before) {
        const std::uint32_t step = value - before;
        number((step << 1) ^ (0u - (step >> 31)));
    }
    void byte(std::uint8_t value) { bytes_.push_back(value); }
    [[nodiscard]] const std::vector<std::uint8_t>& bytes() const noexcept { return bytes_; }

private:
    std::vector<std::uint8_t> bytes_;
};

/// Reads the output of NumberWriter. A number that is truncated or over 32 bits, or a byte beyond the end, reads as 0
/// and sets isGood() to false.
class NumberReader {
public:
    explicit NumberReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    std::uint32_t number() noexcept {
        std::uint64_t value = 0;
        for (int shift = 0; shift <= 28; shift += 7) {
            if (at_ == bytes_.size()) break;
            const std::uint8_t next = bytes_[at_++];
            value |= std::uint64_t{next & 0x7Fu} << shift;
            if (next < 0x80 && value <= 0xFFFFFFFFu) return static_cast<std::uint32_t>(value);
        }
        isGood_ = false;
        return 0;
    }
    std::uint32_t difference(std::uint32_t before) noexcept {
        const std::uint32_t value = number();
        return before + ((value >> 1) ^ (0u - (value & 1u)));
    }
    std::uint8_t byte() noexcept {
        if (at_ < bytes_.size()) return bytes_[at_++];
        isGood_ = false;
        return 0;
    }
    [[nodiscard]] bool isGood() const noexcept { return isGood_; }
    [[nodiscard]] std::uint64_t left() const noexcept { return bytes_.size() - at_; }

private:
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
    bool isGood_ = true;
};

/// Compresses bytes. Equal bytes give equal frames. Bytes that would unpack to more than readers accept (1 MiB + 1024
/// times the frame) are compressed less well.
/// \param what  name of the content for messages: "the vector parts"
/// \return the frame, or BadArgument if zstd fails
[[nodiscard]] Result<std::vector<std::byte>> compressNumbers(std::span<const std::uint8_t> bytes,
                                                             std::string_view what);

/// Decompresses a frame. The unpacked size is checked before memory is allocated.
/// \return the bytes, or BadVolume
[[nodiscard]] Result<std::vector<std::uint8_t>> unpackNumbers(std::span<const std::byte> frame, std::string_view what);

}  // namespace svt::volume
