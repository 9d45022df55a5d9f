#pragma once
/// \file
/// Internal: numbers as one zstd frame that states its size, as the small entries of a `.svt` hold them.

#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace svt::volume {

/// Most bytes that a frame may unpack to, whatever its size.
inline constexpr std::uint64_t kMaxNumberBytes = 0xFFFFFFFFu;

/// Numbers of 32 bits in LEB128, and bytes between them.
class NumberWriter {
public:
    void number(std::uint32_t value) {
        for (; value >= 0x80; value >>= 7) bytes_.push_back(static_cast<std::uint8_t>(value | 0x80));
        bytes_.push_back(static_cast<std::uint8_t>(value));
    }
    /// How far `value` is from `before`, around 2^32, so that any two values have a difference of 32 bits.
    void difference(std::uint32_t value, std::uint32_t before) {
        const std::uint32_t step = value - before;
        number((step << 1) ^ (0u - (step >> 31)));
    }
    void byte(std::uint8_t value) { bytes_.push_back(value); }
    [[nodiscard]] const std::vector<std::uint8_t>& bytes() const noexcept { return bytes_; }

private:
    std::vector<std::uint8_t> bytes_;
};

/// Reads what NumberWriter wrote. After a number that is cut short or over 32 bits isGood() is false, and that number
/// is 0; bytes beyond the end are 0 in the same way.
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

/// \param what  what the numbers are, as messages begin: "the vector parts"
/// \return the frame; equal bytes give equal frames. BadArgument where it is shorter than a reader accepts: they may
///         take 1 MiB + 1024 times the frame
[[nodiscard]] Result<std::vector<std::byte>> compressNumbers(std::span<const std::uint8_t> bytes,
                                                             std::string_view what);

/// The bytes of a frame, with its size checked before they are allocated. \return them, or BadVolume
[[nodiscard]] Result<std::vector<std::uint8_t>> unpackNumbers(std::span<const std::byte> frame, std::string_view what);

}  // namespace svt::volume
