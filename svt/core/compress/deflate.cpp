#include <svt/core/check.hpp>
#include <svt/core/deflate.hpp>

#include <zlib.h>

#include <algorithm>
#include <memory>
#include <new>

namespace svt {
namespace {

constexpr std::size_t kStep = std::size_t{1} << 30;  // zlib counts with 32 bits
constexpr std::size_t kLeastBuffer = std::size_t{1} << 12;
constexpr int kGzipWindow = MAX_WBITS + 16;
constexpr std::size_t kFlushBytes = 64;  // upper limit of the bytes that Z_SYNC_FLUSH adds to deflateBound()

Bytef* zlibBytes(std::span<const std::byte> bytes) noexcept {
    return reinterpret_cast<Bytef*>(const_cast<std::byte*>(bytes.data()));
}

bool beginsGzip(std::span<const std::byte> bytes) noexcept {
    return bytes.size() >= 3 && bytes[0] == std::byte{0x1F} && bytes[1] == std::byte{0x8B} && bytes[2] == std::byte{8};
}

int windowOf(DeflateFormat format) noexcept {
    switch (format) {
        case DeflateFormat::Raw: return -MAX_WBITS;
        case DeflateFormat::Zlib: return MAX_WBITS;
        case DeflateFormat::ZlibOrGzip: return MAX_WBITS + 32;
        case DeflateFormat::Gzip: break;
    }
    return kGzipWindow;
}

struct Packer {
    z_stream stream{};
    std::vector<std::byte> packed;

    Packer(int level, int windowBits, int memoryLevel) {
        if (deflateInit2(&stream, level, Z_DEFLATED, windowBits, memoryLevel, Z_DEFAULT_STRATEGY) != Z_OK)
            throw std::bad_alloc();
    }
    Packer(const Packer&) = delete;
    Packer& operator=(const Packer&) = delete;
    ~Packer() { deflateEnd(&stream); }

    void pack(std::span<const std::byte> bytes, int flush) {
        deflateReset(&stream);
        packed.resize(deflateBound(&stream, static_cast<uLong>(bytes.size())) + kFlushBytes);
        stream.next_in = zlibBytes(bytes);
        stream.avail_in = static_cast<uInt>(bytes.size());
        stream.next_out = zlibBytes(packed);
        stream.avail_out = static_cast<uInt>(packed.size());
        const int state = deflate(&stream, flush);
        SVT_CHECK(state == (flush == Z_FINISH ? Z_STREAM_END : Z_OK));
        SVT_CHECK(stream.avail_in == 0u);
        packed.resize(packed.size() - stream.avail_out);
    }
};

std::vector<std::byte> deflated(std::span<const std::byte> bytes, int level, int window, int flush) {
    Packer packer(level, window, 9);
    packer.pack(bytes, flush);
    return std::move(packer.packed);
}

}  // namespace

std::uint32_t zipChecksum(std::span<const std::byte> bytes, std::uint32_t before) noexcept {
    if (bytes.empty()) return before;  // for a null pointer, zlib returns the initial value
    return static_cast<std::uint32_t>(crc32_z(before, zlibBytes(bytes), bytes.size()));
}

std::uint32_t joinedChecksum(std::uint32_t first, std::uint32_t second, std::uint64_t size) noexcept {
    return static_cast<std::uint32_t>(crc32_combine(first, second, static_cast<z_off_t>(size)));
}

struct InflateStream::State {
    z_stream stream{};

    explicit State(DeflateFormat format) {
        if (inflateInit2(&stream, windowOf(format)) != Z_OK) throw std::bad_alloc();
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() { inflateEnd(&stream); }
};

InflateStream::InflateStream(DeflateFormat format) : state_(std::make_unique<State>(format)) {}
InflateStream::InflateStream(InflateStream&&) noexcept = default;
InflateStream& InflateStream::operator=(InflateStream&&) noexcept = default;
InflateStream::~InflateStream() = default;

InflateStep InflateStream::step(std::span<const std::byte>& packed, std::span<std::byte>& out) {
    z_stream& stream = state_->stream;
    const std::size_t input = std::min(packed.size(), kStep), room = std::min(out.size(), kStep);
    stream.next_in = zlibBytes(packed);
    stream.avail_in = static_cast<uInt>(input);
    std::byte none{};  // zlib rejects a null address, even for an empty buffer
    stream.next_out = zlibBytes(out.empty() ? std::span(&none, 1) : out);
    stream.avail_out = static_cast<uInt>(room);
    const int state = inflate(&stream, Z_NO_FLUSH);
    packed = packed.subspan(input - stream.avail_in);
    out = out.subspan(room - stream.avail_out);
    switch (state) {
        case Z_STREAM_END: return InflateStep::End;
        case Z_OK: return InflateStep::More;
        case Z_BUF_ERROR: return InflateStep::Stuck;
        case Z_MEM_ERROR: throw std::bad_alloc();
        default: return InflateStep::Damaged;
    }
}

void InflateStream::restart() noexcept { inflateReset(&state_->stream); }

bool inflateInto(std::span<const std::byte> packed, DeflateFormat format, std::span<std::byte> out) {
    InflateStream stream(format);
    InflateStep step = InflateStep::More;
    while (step == InflateStep::More) step = stream.step(packed, out);
    return step == InflateStep::End && out.empty();
}

Inflated inflateBytes(std::span<const std::byte> packed, DeflateFormat format, std::uint64_t expectedBytes,
                      std::uint64_t maxBytes) {
    InflateStream stream(format);
    Inflated result;
    std::vector<std::byte>& out = result.bytes;
    out.resize(static_cast<std::size_t>(std::min(expectedBytes, maxBytes)));
    std::size_t written = 0;
    const auto finish = [&](InflateStatus status) {
        out.resize(written);
        result.status = status;
        return std::move(result);
    };
    while (true) {
        if (written == out.size() && out.size() < maxBytes)
            out.resize(
                static_cast<std::size_t>(std::min<std::uint64_t>(std::max(2 * out.size(), kLeastBuffer), maxBytes)));
        // At the limit, one more byte shows whether the stream ends there or continues.
        std::byte beyond{};
        const bool isAtLimit = written == out.size();
        std::span<std::byte> room = isAtLimit ? std::span(&beyond, 1) : std::span(out).subspan(written);
        std::span<const std::byte> input = packed.subspan(result.taken);
        const std::size_t before = room.size();
        const InflateStep step = stream.step(input, room);
        result.taken = packed.size() - input.size();
        if (isAtLimit && room.empty()) return finish(InflateStatus::TooLong);
        written += before - room.size();
        if (step == InflateStep::End) {
            if (format != DeflateFormat::Gzip || !beginsGzip(input)) return finish(InflateStatus::Done);
            stream.restart();
        } else if (step != InflateStep::More) {
            return finish(step == InflateStep::Stuck ? InflateStatus::CutShort : InflateStatus::Damaged);
        }
    }
}

InflateStatus GzipStream::append(std::span<const std::byte> packed, std::string& out) {
    constexpr std::size_t kPiece = std::size_t{1} << 18;
    if (isDamaged_) return InflateStatus::Damaged;
    while (!packed.empty()) {
        if (isComplete_) stream_.restart();  // the first member, or the next one
        const std::size_t before = out.size();
        out.resize(before + kPiece);
        std::span<std::byte> room = std::as_writable_bytes(std::span(out).subspan(before));
        const InflateStep step = stream_.step(packed, room);
        out.resize(out.size() - room.size());
        isComplete_ = step == InflateStep::End;
        isDamaged_ = step == InflateStep::Damaged || (step == InflateStep::Stuck && !packed.empty());
        if (isDamaged_) return InflateStatus::Damaged;
    }
    return InflateStatus::Done;
}

struct ZlibPacker::State : Packer {
    using Packer::Packer;
};

ZlibPacker::ZlibPacker(int level, int windowBits, int memoryLevel)
    : state_(std::make_unique<State>(level, windowBits, memoryLevel)) {}
ZlibPacker::ZlibPacker(ZlibPacker&&) noexcept = default;
ZlibPacker& ZlibPacker::operator=(ZlibPacker&&) noexcept = default;
ZlibPacker::~ZlibPacker() = default;

std::span<const std::byte> ZlibPacker::pack(std::span<const std::byte> bytes) {
    state_->pack(bytes, Z_FINISH);
    return state_->packed;
}

std::vector<std::byte> deflatePiece(std::span<const std::byte> bytes, int level, bool isLast) {
    return deflated(bytes, level, -MAX_WBITS, isLast ? Z_FINISH : Z_SYNC_FLUSH);
}

std::vector<std::byte> gzipBytes(std::span<const std::byte> bytes) {
    return deflated(bytes, Z_DEFAULT_COMPRESSION, kGzipWindow, Z_FINISH);
}

}  // namespace svt
