#include <svt/volume/file/zstd_frame.hpp>

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <memory>
#include <new>

namespace svt::volume {
namespace {

/// Compression level of all zstd frames of a file. Measured on the columns of FZK-Haus: 19 takes ten times as long and
/// saves 5 to 8 %; 3 is three times as fast and 15 % larger.
constexpr int kZstdLevel = 9;

/// ZSTD_c_useRowMatchFinder and ZSTD_ps_enable, which zstd.h hides from programs that link it dynamically. By default,
/// zstd uses this match finder only with SIMD, and gives other bytes without it.
constexpr ZSTD_cParameter kRowMatchFinder = ZSTD_c_experimentalParam14;
constexpr int kEnable = 1;

/// Maximum unpacked size of a frame of `size` bytes. zstd could reach higher ratios, real numbers never do.
std::uint64_t maxBytes(std::uint64_t size) noexcept {
    return std::min((std::uint64_t{1} << 20) + 1024 * size, kMaxNumberBytes);
}

}  // namespace

void startFrame(ZSTD_CCtx* context) {
    ZSTD_CCtx_reset(context, ZSTD_reset_session_and_parameters);
    ZSTD_CCtx_setParameter(context, ZSTD_c_compressionLevel, kZstdLevel);
    ZSTD_CCtx_setParameter(context, kRowMatchFinder, kEnable);
}

namespace {

// The same in blocks of 1 KiB. Each block takes at least three bytes, so every reader accepts the frame, even if the
// bytes repeat often.
Result<std::vector<std::byte>> compressInSmallBlocks(ZSTD_CCtx* context, std::span<const std::uint8_t> bytes,
                                                     std::string_view what) {
    constexpr std::size_t kBlock = 1024, kHeaders = 64;
    startFrame(context);
    ZSTD_CCtx_setPledgedSrcSize(context, bytes.size());
    std::vector<std::byte> frame(ZSTD_compressBound(bytes.size()) + (bytes.size() / kBlock + 1) * 3 + kHeaders);
    ZSTD_outBuffer out{frame.data(), frame.size(), 0};
    for (std::size_t at = 0; at < bytes.size(); at += kBlock) {
        ZSTD_inBuffer in{bytes.data() + at, std::min(kBlock, bytes.size() - at), 0};
        const bool isLast = at + in.size == bytes.size();
        if (ZSTD_compressStream2(context, &out, &in, isLast ? ZSTD_e_end : ZSTD_e_flush) != 0)
            return Error(Code::BadArgument, fmt::format("{} cannot be compressed", what));
    }
    frame.resize(out.pos);
    return frame;
}

}  // namespace

Result<std::vector<std::byte>> compressNumbers(std::span<const std::uint8_t> bytes, std::string_view what) {
    const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), ZSTD_freeCCtx);
    if (!context) throw std::bad_alloc();
    startFrame(context.get());
    std::vector<std::byte> frame(ZSTD_compressBound(bytes.size()));
    const std::size_t size = ZSTD_compress2(context.get(), frame.data(), frame.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(size) != 0) return Error(Code::BadArgument, fmt::format("{} cannot be compressed", what));
    frame.resize(size);
    if (bytes.size() > maxBytes(size)) return compressInSmallBlocks(context.get(), bytes, what);
    return frame;
}

Result<std::vector<std::uint8_t>> unpackNumbers(std::span<const std::byte> frame, std::string_view what) {
    const std::uint64_t size = ZSTD_getFrameContentSize(frame.data(), frame.size());
    if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN ||
        ZSTD_findFrameCompressedSize(frame.data(), frame.size()) != frame.size())
        return Error(Code::BadVolume,
                     fmt::format("{}: not a zstd frame with a stated size; the file is damaged, build it again", what));
    if (size > maxBytes(frame.size()))
        return Error(Code::BadVolume, fmt::format("{}: {} bytes cannot unpack to {}, at most {} are possible", what,
                                                  frame.size(), size, maxBytes(frame.size())));
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
    if (ZSTD_decompress(bytes.data(), bytes.size(), frame.data(), frame.size()) != bytes.size())
        return Error(Code::BadVolume,
                     fmt::format("{}: they cannot be unpacked; the file is damaged, build it again", what));
    return bytes;
}

}  // namespace svt::volume
