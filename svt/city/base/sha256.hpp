#pragma once
/// \file
/// SHA-256 (FIPS 180-4), which proves packs and plans and names ids.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace svt::city {

using Digest = std::array<std::byte, 32>;

class Sha256 {
public:
    void add(std::span<const std::byte> bytes);
    void add(std::string_view text) { add(std::as_bytes(std::span(text.data(), text.size()))); }
    [[nodiscard]] Digest finish();

private:
    void block(const std::byte* bytes);

    std::array<std::uint32_t, 8> state_{0x6A09E667u, 0xBB67AE85u, 0x3C6EF372u, 0xA54FF53Au,
                                        0x510E527Fu, 0x9B05688Cu, 0x1F83D9ABu, 0x5BE0CD19u};
    std::array<std::byte, 64> rest_{};
    std::uint64_t size_ = 0;
};

[[nodiscard]] Digest digestOf(std::string_view text);
/// 64 hexadecimal digits, lower case.
[[nodiscard]] std::string hexOf(const Digest& digest);
/// The digest that hexOf() wrote; all zero for another text.
[[nodiscard]] Digest digestFromHex(std::string_view hex);

/// The hash of an id in ids.bin: the first eight bytes of its SHA-256, big-endian.
[[nodiscard]] std::uint64_t idHash(std::string_view id);

/// A hash of a feature's text, eight bytes at a time. It detects changed files and replicas (together with the id); no
/// result depends on it.
[[nodiscard]] std::uint64_t contentHash(std::string_view text);

}  // namespace svt::city
