#pragma once
/// \file
/// Conversion between numbers and the bytes of files: append to a buffer, load at an offset, take from the front with
/// bounds checks.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace svt {

static_assert(std::endian::native == std::endian::little,
              "numbers of files are little-endian, and are copied unchanged");

/// Appends the bytes of trivially copyable values as in memory. Numbers are little-endian.
/// \param to  a string or a vector of bytes
template <class Buffer, class... Values>
void appendBytes(Buffer& to, const Values&... values) {
    static_assert((std::is_trivially_copyable_v<Values> && ...));
    using Byte = typename Buffer::value_type;
    const auto append = [&](const auto& value) {
        const auto* bytes = reinterpret_cast<const Byte*>(&value);
        to.insert(to.end(), bytes, bytes + sizeof(value));
    };
    (append(values), ...);
}

/// Appends the values as numbers of type T. Bits beyond T are dropped.
template <class T, class Buffer, class... Values>
void appendAs(Buffer& to, const Values&... values) {
    appendBytes(to, static_cast<T>(values)...);
}

/// Appends a number in LEB128: seven bits per byte, lowest bits first.
template <class Buffer>
void appendVarint(Buffer& to, std::uint64_t value) {
    using Byte = typename Buffer::value_type;
    for (; value >= 0x80; value >>= 7) to.push_back(static_cast<Byte>(value | 0x80));
    to.push_back(static_cast<Byte>(value));
}

/// Zigzag code: a number of small magnitude gets a short varint, whatever its sign.
[[nodiscard]] constexpr std::uint64_t zigzag(std::int64_t value) noexcept {
    return static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63);
}
[[nodiscard]] constexpr std::int64_t fromZigzag(std::uint64_t value) noexcept {
    return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
}

/// The number of type T at `at`. The caller ensures that sizeof(T) bytes are available.
template <class T>
[[nodiscard]] T loadBytes(const std::byte* at, std::endian order = std::endian::little) noexcept {
    std::array<std::byte, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), at, sizeof(T));
    if (order == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
}
template <class T>
[[nodiscard]] T loadBytes(std::span<const std::byte> bytes, std::size_t at) noexcept {
    return loadBytes<T>(bytes.data() + at);
}

/// The unsigned number of 1 to 8 bytes at `at`. The caller ensures that they are available.
[[nodiscard]] inline std::uint64_t loadNumber(std::span<const std::byte> bytes, std::size_t at, std::size_t size,
                                              std::endian order = std::endian::little) noexcept {
    std::uint64_t value = 0;
    for (std::size_t b = 0; b < size; ++b)
        value = value << 8 | std::to_integer<std::uint64_t>(bytes[at + (order == std::endian::big ? b : size - 1 - b)]);
    return value;
}

/// Packs bits into bytes, lowest bit first.
/// \param isSet  isSet(n): whether bit n is set, for n below `count`
template <class IsSet>
[[nodiscard]] std::string packedBits(std::size_t count, const IsSet& isSet) {
    std::string bytes((count + 7) / 8, '\0');
    for (std::size_t n = 0; n < count; ++n)
        if (isSet(n)) bytes[n / 8] = static_cast<char>(bytes[n / 8] | 1 << n % 8);
    return bytes;
}

/// Takes values from the front of a byte sequence. When too few bytes are left, isGood() becomes false and all further
/// values are 0.
class ByteReader {
public:
    explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

    template <class T>
    [[nodiscard]] T take() {
        T value{};
        take(value);
        return value;
    }
    /// Takes the values in their order.
    template <class First, class... Rest>
    void take(First& first, Rest&... rest) {
        static_assert(std::is_trivially_copyable_v<First>);
        if (rest_.size() < sizeof(First)) {
            isGood_ = false;
            rest_ = {};
            first = First{};
        } else {
            std::memcpy(&first, rest_.data(), sizeof(First));
            rest_.remove_prefix(sizeof(First));
        }
        if constexpr (sizeof...(Rest) > 0) take(rest...);
    }
    /// A number that appendVarint() wrote. A number of more than ten bytes counts as missing.
    [[nodiscard]] std::uint64_t takeVarint() {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 64; shift += 7) {
            const auto byte = take<std::uint8_t>();
            value |= std::uint64_t{byte & 0x7Fu} << shift;
            if (byte < 0x80) return value;
        }
        isGood_ = false;
        rest_ = {};
        return 0;
    }
    /// The next `size` bytes. If fewer are left, returns those, and isGood() becomes false.
    [[nodiscard]] std::string_view text(std::size_t size) {
        isGood_ = isGood_ && size <= rest_.size();
        const std::string_view taken = rest_.substr(0, size);
        rest_.remove_prefix(taken.size());
        return taken;
    }
    void skip(std::size_t size) { (void)text(size); }
    [[nodiscard]] std::size_t left() const noexcept { return rest_.size(); }
    [[nodiscard]] bool isGood() const noexcept { return isGood_; }

private:
    std::string_view rest_;
    bool isGood_ = true;
};

}  // namespace svt
