#pragma once
/// \file
/// Building blocks for the nodes of an OpenVDB tree: masks, numbers, values.

#include <svt/core/bytes.hpp>
#include <svt/core/deflate.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace svt::writers {

inline constexpr std::int32_t kUpperSide = 32;  // nodes of 128^3 samples along an axis of an upper node
inline constexpr std::int32_t kLeafSide = 8, kLeavesAlong = 16;  // samples, and leaves in a node of 128^3 samples

using VdbBytes = std::vector<std::byte>;

/// Bits of a node, words of 64.
template <std::size_t N>
struct NodeMask {
    std::array<std::uint64_t, N / 64> words{};
    void set(std::size_t bit) noexcept { words[bit / 64] |= std::uint64_t{1} << (bit % 64); }
};

/// Appends the values of nodes, compressed by zlib if that makes them smaller. Each thread needs its own.
class NodeValues {
public:
    NodeValues();
    /// The active values of a node: a byte that marks all others as background, then the values.
    void put(VdbBytes& to, std::span<const std::uint32_t> active);
    /// All values of a node, active or not.
    void putAll(VdbBytes& to, std::span<const float> values);

private:
    void putPacked(VdbBytes& to, std::int8_t kind, std::span<const std::byte> plain);

    ZlibPacker packer_;
};

}  // namespace svt::writers
