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
constexpr std::size_t kFlushBytes = 64;  // what Z_SYNC_FLUSH may add beyond deflateBound()

Bytef* zlibBytes(std::span<const std::byte> bytes) noexcept {
    return reinterpret_cast<Bytef*>(const_cast<std::byte*>(bytes.data()));
}

bool beginsGzip(std::span<const std::byte> bytes) noexcept {
    return bytes.size() >= 3 && bytes[0] == std::byte{0x1F} && bytes[1] == std::byte{0x8B} && bytes[2] == std::byte{8};
}

std::vector<std::byte> deflated(std::span<const std::byte> bytes, int level, int window, int flush) {
    z_stream stream{};
    if (deflateInit2(&stream, level, Z_DEFLATED, window, 9, Z_DEFAULT_STRATEGY) != Z_OK) throw std::bad_alloc();
    const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, deflateEnd);
    std::vector<std::byte> out(deflateBound(&stream, static_cast<uLong>(bytes.size())) + kFlushBytes);
    stream.next_in = zlibBytes(bytes);
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = zlibBytes(out);
    stream.avail_out = static_cast<uInt>(out.size());
    const int state = deflate(&stream, flush);
    SVT_CHECK(state == (flush == Z_FINISH ? Z_STREAM_END : Z_OK));
    SVT_CHECK(stream.avail_in == 0u);
    out.resize(out.size() - stream.avail_out);
    return out;
}

}  // namespace

std::uint32_t zipChecksum(std::span<const std::byte> bytes, std::uint32_t before) noexcept {
    if (bytes.empty()) return before;  // zlib takes a null pointer as a wish for the first value
    return static_cast<std::uint32_t>(crc32_z(before, zlibBytes(bytes), bytes.size()));
}

Inflated inflateBytes(std::span<const std::byte> packed, DeflateFormat format, std::uint64_t expectedBytes,
                      std::uint64_t maxBytes) {
    z_stream stream{};
    if (inflateInit2(&stream, format == DeflateFormat::Raw ? -MAX_WBITS : kGzipWindow) != Z_OK) throw std::bad_alloc();
    const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, inflateEnd);
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
        // At the limit, one byte more tells a stream that ends there from one that goes on.
        std::byte beyond{};
        const std::span<std::byte> room = written == out.size()
                                              ? std::span(&beyond, 1)
                                              : std::span(out).subspan(written, std::min(out.size() - written, kStep));
        const auto input = packed.subspan(result.taken, std::min(packed.size() - result.taken, kStep));
        stream.next_in = zlibBytes(input);
        stream.avail_in = static_cast<uInt>(input.size());
        stream.next_out = zlibBytes(room);
        stream.avail_out = static_cast<uInt>(room.size());
        const int state = inflate(&stream, Z_NO_FLUSH);
        result.taken += input.size() - stream.avail_in;
        const std::size_t made = room.size() - stream.avail_out;
        if (made != 0 && room.data() == &beyond) return finish(InflateStatus::TooLong);
        written += made;
        if (state == Z_STREAM_END) {
            if (format == DeflateFormat::Raw || !beginsGzip(packed.subspan(result.taken)))
                return finish(InflateStatus::Done);
            inflateReset(&stream);
        } else if (state != Z_OK && state != Z_BUF_ERROR) {
            return finish(InflateStatus::Damaged);
        } else if (result.taken == packed.size() && stream.avail_out != 0) {
            return finish(InflateStatus::CutShort);
        }
    }
}

struct GzipStream::State {
    z_stream stream{};
    bool isComplete = true, isDamaged = false;

    State() {
        if (inflateInit2(&stream, kGzipWindow) != Z_OK) throw std::bad_alloc();
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() { inflateEnd(&stream); }
};

GzipStream::GzipStream() : state_(std::make_unique<State>()) {}
GzipStream::GzipStream(GzipStream&&) noexcept = default;
GzipStream& GzipStream::operator=(GzipStream&&) noexcept = default;
GzipStream::~GzipStream() = default;

InflateStatus GzipStream::append(std::span<const std::byte> packed, std::string& out) {
    constexpr std::size_t kPiece = std::size_t{1} << 18;
    if (state_->isDamaged) return InflateStatus::Damaged;
    z_stream& stream = state_->stream;
    stream.next_in = zlibBytes(packed);
    stream.avail_in = static_cast<uInt>(packed.size());
    while (stream.avail_in > 0) {
        if (state_->isComplete) inflateReset(&stream);  // the first member, or the next one
        state_->isComplete = false;
        const std::size_t before = out.size();
        out.resize(before + kPiece);
        stream.next_out = reinterpret_cast<Bytef*>(out.data() + before);
        stream.avail_out = static_cast<uInt>(kPiece);
        const int state = inflate(&stream, Z_NO_FLUSH);
        out.resize(before + kPiece - stream.avail_out);
        if (state == Z_STREAM_END) state_->isComplete = true;
        if (state == Z_STREAM_END || state == Z_OK || (state == Z_BUF_ERROR && stream.avail_in == 0)) continue;
        state_->isDamaged = true;
        return InflateStatus::Damaged;
    }
    return InflateStatus::Done;
}

bool GzipStream::isComplete() const noexcept { return state_->isComplete && !state_->isDamaged; }

std::vector<std::byte> deflatePiece(std::span<const std::byte> bytes, int level, bool isLast) {
    return deflated(bytes, level, -MAX_WBITS, isLast ? Z_FINISH : Z_SYNC_FLUSH);
}

std::vector<std::byte> gzipBytes(std::span<const std::byte> bytes) {
    return deflated(bytes, Z_DEFAULT_COMPRESSION, kGzipWindow, Z_FINISH);
}

}  // namespace svt
