#include <svt/core/bytes.hpp>
#include <svt/core/deflate.hpp>
#include <svt/core/parallel.hpp>
#include <svt/writers/dense/gzip_writer.hpp>

#include <algorithm>
#include <array>
#include <string>

namespace svt::writers {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 20;
constexpr std::size_t kPiecesAtOnce = 16;
constexpr int kLevel = 5;

struct Piece {
    std::vector<std::byte> compressed;
    std::uint32_t crc = 0;
};

/// Raw deflate blocks that end at a byte boundary, so that pieces can be joined.
Piece compressPiece(std::span<const std::byte> bytes) {
    Piece piece;
    piece.compressed = deflatePiece(bytes, kLevel, false);
    piece.crc = zipChecksum(bytes);
    return piece;
}

}  // namespace

Result<void> GzipWriter::compress(std::span<const std::byte> bytes) {
    if (!isBegun_) {
        // Deflate, no name, no time stamp (equal input gives equal bytes), unknown system.
        constexpr std::array<unsigned char, 10> kHeader{0x1F, 0x8B, 8, 0, 0, 0, 0, 0, 0, 0xFF};
        SVT_DO(file_.write(std::as_bytes(std::span(kHeader))));
        isBegun_ = true;
    }
    const auto pieceAt = [&](std::size_t p) {
        return bytes.subspan(p * kPieceBytes, std::min(kPieceBytes, bytes.size() - p * kPieceBytes));
    };
    const std::size_t count = (bytes.size() + kPieceBytes - 1) / kPieceBytes;
    for (std::size_t first = 0; first < count; first += kPiecesAtOnce) {
        std::vector<Piece> pieces(std::min(kPiecesAtOnce, count - first));
        parallelFor(pieces.size(), 1, threads_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t p = begin; p < end; ++p) pieces[p] = compressPiece(pieceAt(first + p));
        });
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            const std::size_t size = pieceAt(first + p).size();
            crc_ = joinedChecksum(crc_, pieces[p].crc, size);
            size_ += size;
            SVT_DO(file_.write(pieces[p].compressed));
        }
    }
    return {};
}

Result<void> GzipWriter::write(std::span<const std::byte> bytes) {
    if (!pending_.empty()) {
        const std::size_t taken = std::min(bytes.size(), kPieceBytes - pending_.size());
        pending_.insert(pending_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(taken));
        bytes = bytes.subspan(taken);
        if (pending_.size() < kPieceBytes) return {};
        SVT_DO(compress(pending_));
        pending_.clear();
    }
    const std::size_t whole = bytes.size() / kPieceBytes * kPieceBytes;
    if (whole > 0) SVT_DO(compress(bytes.first(whole)));
    const auto rest = bytes.subspan(whole);
    pending_.assign(rest.begin(), rest.end());
    return {};
}

Result<void> GzipWriter::finish() {
    SVT_DO(compress(pending_));
    // An empty last block with fixed Huffman codes: the bits 1, 01, 0000000.
    std::string end("\3\0", 2);
    appendAs<std::uint32_t>(end, crc_, size_);
    return file_.write(end);
}

}  // namespace svt::writers
