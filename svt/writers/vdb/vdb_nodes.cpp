#include <svt/writers/vdb/vdb_nodes.hpp>

#include <zlib.h>

#include <new>

namespace svt::writers {
namespace {

constexpr int kVdbLevel = 1;
constexpr std::int8_t kOthersAreBackground = 0, kAllValues = 6;

/// zlib with a window as small as the leaves are, made once: setting it up takes longer than to pack a leaf.
class LeafPacker {
public:
    LeafPacker() {
        if (deflateInit2(&stream_, kVdbLevel, Z_DEFLATED, kWindowBits, kMemoryLevel, Z_DEFAULT_STRATEGY) != Z_OK)
            throw std::bad_alloc();
    }
    LeafPacker(const LeafPacker&) = delete;
    LeafPacker& operator=(const LeafPacker&) = delete;
    ~LeafPacker() { deflateEnd(&stream_); }

    /// The packed bytes, until the next call.
    std::span<const std::byte> pack(std::span<const std::byte> plain) {
        deflateReset(&stream_);
        packed_.resize(deflateBound(&stream_, static_cast<uLong>(plain.size())));
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(plain.data()));
        stream_.avail_in = static_cast<uInt>(plain.size());
        stream_.next_out = reinterpret_cast<Bytef*>(packed_.data());
        stream_.avail_out = static_cast<uInt>(packed_.size());
        deflate(&stream_, Z_FINISH);  // ends, since the buffer is large enough
        return std::span<const std::byte>(packed_).first(packed_.size() - stream_.avail_out);
    }

private:
    static constexpr int kWindowBits = 12, kMemoryLevel = 4;
    z_stream stream_{};
    VdbBytes packed_;
};

void putPacked(VdbBytes& to, std::int8_t kind, std::span<const std::byte> plain) {
    thread_local LeafPacker packer;
    put(to, kind);
    const auto packed = packer.pack(plain);
    const bool isSmaller = packed.size() < plain.size();
    put(to, isSmaller ? static_cast<std::int64_t>(packed.size()) : -static_cast<std::int64_t>(plain.size()));
    const auto bytes = isSmaller ? packed : plain;
    to.insert(to.end(), bytes.begin(), bytes.end());
}

}  // namespace

void putValues(VdbBytes& to, std::span<const std::uint32_t> active) {
    putPacked(to, kOthersAreBackground, std::as_bytes(active));
}

void putAllValues(VdbBytes& to, std::span<const float> values) { putPacked(to, kAllValues, std::as_bytes(values)); }

}  // namespace svt::writers
