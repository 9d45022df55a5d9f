#include <svt/volume_readers/samples/label_image.hpp>

#include <svt/core/deflate.hpp>
#include <svt/volume/grid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace svt::volume_readers {
namespace {

/// Maximum compression ratio of deflate; a header that claims more is invalid.
constexpr std::uint64_t kMaxRatio = 1032;

Error trailing(Code code, std::uint64_t count) {
    return {code, fmt::format("{} bytes stand behind the samples: the file is damaged, or its sizes are wrong", count)};
}

/// gzip members as one stream.
class GzipSource {
public:
    GzipSource(SharedFile file, FilePart part, Code code) : file_(std::move(file)), rest_(part), code_(code) {}

    Result<void> read(std::span<std::byte> out) {
        if (out.empty()) return finish();
        while (!out.empty()) {
            SVT_DO(fill());
            const std::size_t before = out.size();
            const InflateStep step = stream_.step(piece_, out);
            isBetween_ = step == InflateStep::End;
            if (isBetween_ && !isSpent()) {
                stream_.restart();
                continue;
            }
            if (!isBetween_ && step != InflateStep::More)
                return Error(code_, "the compressed samples are damaged or cut short");
            if (out.size() == before && isSpent())
                return Error(code_, "the compressed samples are fewer than the sizes say");
        }
        return {};
    }

private:
    [[nodiscard]] bool isSpent() const noexcept { return rest_.size == 0 && piece_.empty(); }

    /// Reads the next piece of the file if there is none.
    Result<void> fill() {
        if (!piece_.empty()) return {};
        const std::uint64_t size = std::min(rest_.size, kPiece);
        SVT_TRY(piece, file_->bytes({rest_.offset, size}, buffer_));
        rest_ = {rest_.offset + size, rest_.size - size};
        piece_ = *piece;
        return {};
    }

    /// Reads to the end of the last member, whose checksum and size zlib compares.
    Result<void> finish() {
        while (!(isBetween_ && isSpent())) {
            SVT_DO(fill());
            if (isBetween_ && piece_.front() != std::byte{0x1F}) return trailing(code_, rest_.size + piece_.size());
            std::byte beyond{};
            std::span<std::byte> room(&beyond, 1);
            const InflateStep step = stream_.step(piece_, room);
            if (room.empty()) return Error(code_, "the compressed samples are more than the sizes say");
            isBetween_ = step == InflateStep::End;
            if (isBetween_) stream_.restart();
            if (!isBetween_ && (step != InflateStep::More || isSpent()))
                return Error(code_, "the end of the compressed samples is damaged or cut short");
        }
        return {};
    }

    static constexpr std::uint64_t kPiece = std::uint64_t{1} << 20;

    SharedFile file_;
    FilePart rest_;                     // of the file, behind the piece
    std::span<const std::byte> piece_;  // not unpacked yet
    std::string buffer_;
    Code code_;
    InflateStream stream_{DeflateFormat::Gzip};
    bool isBetween_ = false;  // members, or behind the last one
};

/// Blocks, unpacked one at a time.
class BlockSource {
public:
    BlockSource(SharedFile file, std::vector<ZlibBlock> blocks, bool isCompressed, Code code)
        : file_(std::move(file)), blocks_(std::move(blocks)), isCompressed_(isCompressed), code_(code) {}

    Result<void> read(std::span<std::byte> out) {
        if (out.empty() && (block_ != blocks_.size() || at_ != bytes_.size()))
            return Error(code_, "the samples are more than the sizes say");
        while (!out.empty()) {
            if (at_ == bytes_.size()) SVT_DO(next());
            const std::size_t count = std::min(out.size(), bytes_.size() - at_);
            std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(at_), count, out.begin());
            at_ += count;
            out = out.subspan(count);
        }
        return {};
    }

private:
    Result<void> next() {
        if (block_ == blocks_.size()) return Error(code_, "the samples are fewer than the sizes say");
        const ZlibBlock& block = blocks_[block_++];
        at_ = 0;
        SVT_TRY(stored, file_->bytes(block.stored, buffer_));
        if (!isCompressed_) {
            bytes_.assign(stored->begin(), stored->end());
            return {};
        }
        bytes_.resize(static_cast<std::size_t>(block.size));
        if (!inflateInto(*stored, DeflateFormat::Zlib, bytes_))
            return Error(code_, fmt::format("block {} of the compressed samples is damaged or cut short", block_ - 1));
        return {};
    }

    SharedFile file_;
    std::vector<ZlibBlock> blocks_;
    bool isCompressed_;
    Code code_;
    std::size_t block_ = 0, at_ = 0;
    std::vector<std::byte> bytes_;
    std::string buffer_;
};

}  // namespace

Result<void> checkImage(const LabelImage& image, std::uint64_t storedBytes, bool isCompressed, Code code) {
    if (image.bits != 8 && image.bits != 16 && image.bits != 32)
        return Error(code,
                     fmt::format("samples of {} bits cannot be labels; whole numbers of 8, 16 or 32 bits are expected",
                                 image.bits));
    for (int axis = 0; axis < 3; ++axis)
        if (image.dimension[axis] < 2 || image.dimension[axis] > volume::Grid::kMaxDimension)
            return Error(code,
                         fmt::format("{} x {} x {} samples; 2 to {} along each axis are possible", image.dimension.x,
                                     image.dimension.y, image.dimension.z, volume::Grid::kMaxDimension));
    // 65535^3 samples of 8 bytes stay below 2^64.
    const std::uint64_t bytes = image.storedSliceBytes() * static_cast<std::uint64_t>(image.dimension.z);
    if (!isCompressed && storedBytes < bytes)
        return Error(code,
                     fmt::format("{} bytes of samples found, {} expected: the file is cut short", storedBytes, bytes));
    if (isCompressed && bytes / kMaxRatio > storedBytes)
        return Error(code, fmt::format("{} bytes of compressed samples cannot hold the {} bytes that the sizes say",
                                       storedBytes, bytes));
    return {};
}

ReadSamples plainSamples(SharedFile file, FilePart part, Code code) {
    return
        [file = std::move(file), part, code, buffer = std::string()](std::span<std::byte> out) mutable -> Result<void> {
            if (part.size < out.size()) return Error(code, "the samples are fewer than the sizes say");
            if (out.empty() && part.size != 0) return trailing(code, part.size);
            SVT_TRY(stored, file->bytes({part.offset, out.size()}, buffer));
            std::copy(stored->begin(), stored->end(), out.begin());
            part = {part.offset + out.size(), part.size - out.size()};
            return {};
        };
}

ReadSamples gzipSamples(SharedFile file, FilePart part, Code code) {
    auto source = std::make_shared<GzipSource>(std::move(file), part, code);
    return [source](std::span<std::byte> out) { return source->read(out); };
}

ReadSamples zlibSamples(SharedFile file, std::vector<ZlibBlock> blocks, bool isCompressed, Code code) {
    auto source = std::make_shared<BlockSource>(std::move(file), std::move(blocks), isCompressed, code);
    return [source](std::span<std::byte> out) { return source->read(out); };
}

}  // namespace svt::volume_readers
