#include <svt/volume/vector_parts.hpp>

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <string_view>

namespace svt::volume {
namespace {

constexpr int kLevel = 9;
constexpr std::uint64_t kMaxBytes = 0xFFFFFFFFu;
/// Fewest bytes that a point, a segment and a triangle take.
constexpr std::uint64_t kPointBytes = 3, kSegmentBytes = 3, kTriangleBytes = 4;

Error bad(std::string message) { return Error(Code::BadVolume, "the vector parts: " + std::move(message)); }

/// Most bytes that a frame of `size` bytes may hold; zstd could say more, real parts never do.
std::uint64_t maxBytes(std::uint64_t size) noexcept {
    return std::min((std::uint64_t{1} << 20) + 1024 * size, kMaxBytes);
}

class Writer {
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
    [[nodiscard]] const std::vector<std::uint8_t>& bytes() const noexcept { return bytes_; }

private:
    std::vector<std::uint8_t> bytes_;
};

class Reader {
public:
    explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    std::uint32_t number() noexcept {
        std::uint64_t value = 0;
        for (int shift = 0; shift <= 28; shift += 7) {
            if (at_ == bytes_.size()) break;
            const std::uint8_t byte = bytes_[at_++];
            value |= std::uint64_t{byte & 0x7Fu} << shift;
            if (byte < 0x80 && value <= 0xFFFFFFFFu) return static_cast<std::uint32_t>(value);
        }
        isGood_ = false;
        return 0;
    }
    std::uint32_t difference(std::uint32_t before) noexcept {
        const std::uint32_t value = number();
        return before + ((value >> 1) ^ (0u - (value & 1u)));
    }
    [[nodiscard]] bool isGood() const noexcept { return isGood_; }
    [[nodiscard]] std::uint64_t left() const noexcept { return bytes_.size() - at_; }

private:
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
    bool isGood_ = true;
};

std::uint32_t bitsOf(std::int32_t value) noexcept { return static_cast<std::uint32_t>(value); }

template <class Part, class Corners>
Result<void> checkPart(const std::vector<Part>& list, Corners corners, std::string_view name, std::size_t labelCount,
                       std::size_t pointCount) {
    std::uint32_t before = 0;
    for (std::size_t n = 0; n < list.size(); ++n) {
        if (list[n].label >= labelCount)
            return bad(fmt::format("{} {} is of label {}, there are {}", name, n, list[n].label, labelCount));
        if (list[n].label < before) return bad(fmt::format("{} {} is out of the order of labels", name, n));
        before = list[n].label;
        for (const std::uint32_t point : list[n].*corners)
            if (point >= pointCount)
                return bad(fmt::format("{} {} uses point {}, there are {}", name, n, point, pointCount));
    }
    return {};
}

}  // namespace

Result<void> checkVectorParts(const VectorParts& parts, std::size_t labelCount) {
    if (auto checked =
            checkPart(parts.segments, &VectorParts::Segment::ends, "segment", labelCount, parts.points.size());
        !checked)
        return checked;
    return checkPart(parts.triangles, &VectorParts::Triangle::corners, "triangle", labelCount, parts.points.size());
}

Result<std::vector<std::byte>> compressVectorParts(const VectorParts& parts) {
    Writer writer;
    const std::uint64_t most = kMaxBytes / 20;  // a triangle takes 20 bytes at most
    if (parts.points.size() + parts.segments.size() + parts.triangles.size() > most)
        return Error(Code::BadArgument,
                     fmt::format("{} points, segments and triangles are over the limit of {}",
                                 parts.points.size() + parts.segments.size() + parts.triangles.size(), most));
    writer.number(static_cast<std::uint32_t>(parts.points.size()));
    writer.number(static_cast<std::uint32_t>(parts.segments.size()));
    writer.number(static_cast<std::uint32_t>(parts.triangles.size()));
    Vec3i before{};
    for (const Vec3i point : parts.points) {
        for (int axis = 0; axis < 3; ++axis) writer.difference(bitsOf(point[axis]), bitsOf(before[axis]));
        before = point;
    }
    const auto writeList = [&](const auto& list, auto corners) {
        std::uint32_t label = 0, last = 0;
        for (const auto& part : list) {
            writer.number(part.label - label);
            label = part.label;
            for (const std::uint32_t corner : part.*corners) {
                writer.difference(corner, last);
                last = corner;
            }
        }
    };
    writeList(parts.segments, &VectorParts::Segment::ends);
    writeList(parts.triangles, &VectorParts::Triangle::corners);
    const auto& bytes = writer.bytes();
    std::vector<std::byte> frame(ZSTD_compressBound(bytes.size()));
    const std::size_t size = ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), kLevel);
    if (ZSTD_isError(size) != 0) return Error(Code::BadArgument, "the vector parts cannot be compressed");
    frame.resize(size);
    if (bytes.size() > maxBytes(size))
        return Error(Code::BadArgument, "the vector parts repeat themselves more often than a reader accepts");
    return frame;
}

Result<VectorParts> readVectorParts(std::span<const std::byte> frame, std::size_t labelCount) {
    const std::uint64_t size = ZSTD_getFrameContentSize(frame.data(), frame.size());
    if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN ||
        ZSTD_findFrameCompressedSize(frame.data(), frame.size()) != frame.size())
        return bad("they are no zstd frame that says its size; the file is damaged, build it again");
    if (size > maxBytes(frame.size()))
        return bad(fmt::format("{} bytes are said to unpack to {}, {} are possible", frame.size(), size,
                               maxBytes(frame.size())));
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
    if (ZSTD_decompress(bytes.data(), bytes.size(), frame.data(), frame.size()) != bytes.size())
        return bad("they cannot be unpacked; the file is damaged, build it again");
    Reader reader(bytes);
    const std::uint64_t points = reader.number(), segments = reader.number(), triangles = reader.number();
    if (!reader.isGood() ||
        points * kPointBytes + segments * kSegmentBytes + triangles * kTriangleBytes > reader.left())
        return bad(fmt::format("{} points, {} segments and {} triangles are said to be in {} bytes", points, segments,
                               triangles, reader.left()));
    VectorParts parts;
    parts.points.resize(static_cast<std::size_t>(points));
    parts.segments.resize(static_cast<std::size_t>(segments));
    parts.triangles.resize(static_cast<std::size_t>(triangles));
    Vec3i before{};
    for (Vec3i& point : parts.points) {
        for (int axis = 0; axis < 3; ++axis)
            point[axis] = static_cast<std::int32_t>(reader.difference(bitsOf(before[axis])));
        before = point;
    }
    const auto readList = [&](auto& list, auto corners) {
        std::uint32_t label = 0, last = 0;
        for (auto& part : list) {
            // A sum that wraps around is found out of order.
            part.label = label += reader.number();
            for (std::uint32_t& corner : part.*corners) corner = last = reader.difference(last);
        }
    };
    readList(parts.segments, &VectorParts::Segment::ends);
    readList(parts.triangles, &VectorParts::Triangle::corners);
    if (!reader.isGood()) return bad("a number is cut short or longer than 32 bits");
    if (reader.left() != 0) return bad(fmt::format("{} bytes are left over", reader.left()));
    if (auto checked = checkVectorParts(parts, labelCount); !checked) return checked.error();
    return parts;
}

}  // namespace svt::volume
