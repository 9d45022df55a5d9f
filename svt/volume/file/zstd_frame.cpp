#include <svt/volume/file/zstd_frame.hpp>

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>

namespace svt::volume {
namespace {

/// Maximum unpacked size of a frame of `size` bytes. zstd could reach higher ratios, real numbers never do.
std::uint64_t maxBytes(std::uint64_t size) noexcept {
    return std::min((std::uint64_t{1} << 20) + 1024 * size, kMaxNumberBytes);
}

}  // namespace

Result<std::vector<std::byte>> compressNumbers(std::span<const std::uint8_t> bytes, std::string_view what) {
    std::vector<std::byte> frame(ZSTD_compressBound(bytes.size()));
    const std::size_t size = ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), kZstdLevel);
    if (ZSTD_isError(size) != 0) return Error(Code::BadArgument, fmt::format("{} cannot be compressed", what));
    frame.resize(size);
    if (bytes.size() > maxBytes(size))
        return Error(Code::BadArgument, fmt::format("{} repeat themselves more often than a reader accepts", what));
    return frame;
}

Result<std::vector<std::uint8_t>> unpackNumbers(std::span<const std::byte> frame, std::string_view what) {
    const std::uint64_t size = ZSTD_getFrameContentSize(frame.data(), frame.size());
    if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN ||
        ZSTD_findFrameCompressedSize(frame.data(), frame.size()) != frame.size())
        return Error(
            Code::BadVolume,
            fmt::format("{}: they are no zstd frame that says its size; the file is damaged, build it again", what));
    if (size > maxBytes(frame.size()))
        return Error(Code::BadVolume, fmt::format("{}: {} bytes are said to unpack to {}, {} are possible", what,
                                                  frame.size(), size, maxBytes(frame.size())));
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
    if (ZSTD_decompress(bytes.data(), bytes.size(), frame.data(), frame.size()) != bytes.size())
        return Error(Code::BadVolume,
                     fmt::format("{}: they cannot be unpacked; the file is damaged, build it again", what));
    return bytes;
}

}  // namespace svt::volume
