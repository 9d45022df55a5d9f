#pragma once
/// \file
/// Frames of Zstandard as other programs write them, for tests of what a .svt holds.

#include <zstd.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::volume::test {

/// One frame with the given content, packed by zstd at its default level.
inline std::vector<std::byte> zstdFrameOf(const std::vector<std::uint8_t>& bytes) {
    std::vector<std::byte> frame(ZSTD_compressBound(bytes.size()));
    frame.resize(ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), 3));
    return frame;
}

}  // namespace svt::volume::test
