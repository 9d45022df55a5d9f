#include <svt/core/deflate.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

namespace svt {
namespace {

std::vector<std::byte> someBytes(std::size_t count, unsigned seed, unsigned distinct) {
    std::mt19937 random(seed);
    std::vector<std::byte> bytes(count);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random() % distinct);
    return bytes;
}

std::vector<std::byte> joined(std::vector<std::byte> a, const std::vector<std::byte>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

TEST(Deflate, BytesComeBack) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{4095}, std::size_t{300000}})
        for (const unsigned distinct : {1u, 7u, 256u}) {
            const auto bytes = someBytes(count, 1, distinct);
            const auto raw = inflateBytes(deflatePiece(bytes, 5, true), DeflateFormat::Raw, 0, count);
            EXPECT_EQ(raw.status, InflateStatus::Done);
            EXPECT_EQ(raw.bytes, bytes);
            const auto packed = gzipBytes(bytes);
            const auto whole = inflateBytes(packed, DeflateFormat::Gzip, 10, count);
            EXPECT_EQ(whole.status, InflateStatus::Done);
            EXPECT_EQ(whole.bytes, bytes);
            EXPECT_EQ(whole.taken, packed.size());
        }
}

TEST(Deflate, PiecesAndMembersAreJoined) {
    const auto a = someBytes(5000, 2, 9), b = someBytes(777, 3, 9);
    const auto pieces = joined(deflatePiece(a, -1, false), deflatePiece(b, 9, true));
    EXPECT_EQ(inflateBytes(pieces, DeflateFormat::Raw, 0, 1 << 20).bytes, joined(a, b));
    EXPECT_EQ(inflateBytes(joined(gzipBytes(a), gzipBytes(b)), DeflateFormat::Gzip, 0, 1 << 20).bytes, joined(a, b));
}

TEST(Deflate, TheChecksumIsTheOneOfZip) {
    const std::string text = "123456789";
    EXPECT_EQ(zipChecksum(std::as_bytes(std::span(text))), 0xCBF43926u);
    EXPECT_EQ(zipChecksum({}), 0u);
    const auto bytes = std::as_bytes(std::span(text));
    EXPECT_EQ(zipChecksum(bytes.subspan(4), zipChecksum(bytes.first(4))), 0xCBF43926u);
}

TEST(Deflate, TheLimitHoldsToTheByte) {
    const auto bytes = someBytes(10000, 4, 3);
    const auto packed = gzipBytes(bytes);
    EXPECT_EQ(inflateBytes(packed, DeflateFormat::Gzip, 0, bytes.size()).status, InflateStatus::Done);
    const auto over = inflateBytes(packed, DeflateFormat::Gzip, 0, bytes.size() - 1);
    EXPECT_EQ(over.status, InflateStatus::TooLong);
    EXPECT_EQ(over.bytes.size(), bytes.size() - 1);
    EXPECT_EQ(inflateBytes(packed, DeflateFormat::Gzip, 1 << 30, 16).status, InflateStatus::TooLong);
}

TEST(Deflate, DamageAndMissingEndsAreTold) {
    auto packed = gzipBytes(someBytes(10000, 5, 50));
    const std::span<const std::byte> all(packed);
    for (const std::size_t size : {std::size_t{0}, std::size_t{5}, packed.size() / 2, packed.size() - 1})
        EXPECT_EQ(inflateBytes(all.first(size), DeflateFormat::Gzip, 0, 1 << 20).status, InflateStatus::CutShort)
            << size;
    packed[packed.size() - 6] ^= std::byte{1};  // the checksum
    EXPECT_EQ(inflateBytes(packed, DeflateFormat::Gzip, 0, 1 << 20).status, InflateStatus::Damaged);
}

TEST(Deflate, AStreamGivesTheSamePieceByPiece) {
    const auto a = someBytes(600'000, 6, 40), b = someBytes(777, 7, 9);
    const auto packed = joined(gzipBytes(a), gzipBytes(b)), plain = joined(a, b);
    const std::span<const std::byte> all(packed);
    for (const std::size_t piece : {std::size_t{1}, std::size_t{1000}, packed.size()}) {
        GzipStream stream;
        std::string out;
        for (std::size_t at = 0; at < packed.size(); at += piece)
            ASSERT_EQ(stream.append(all.subspan(at, std::min(piece, packed.size() - at)), out), InflateStatus::Done);
        EXPECT_TRUE(stream.isComplete());
        ASSERT_EQ(out.size(), plain.size());
        EXPECT_TRUE(std::equal(plain.begin(), plain.end(), std::as_bytes(std::span(out)).begin()));
    }
    GzipStream cut;
    std::string out;
    EXPECT_EQ(cut.append(all.first(packed.size() - 1), out), InflateStatus::Done);
    EXPECT_FALSE(cut.isComplete());
    auto damaged = packed;
    damaged[packed.size() - 6] ^= std::byte{1};  // the checksum
    GzipStream stream;
    EXPECT_EQ(stream.append(damaged, out), InflateStatus::Damaged);
    EXPECT_EQ(stream.append(packed, out), InflateStatus::Damaged);
    EXPECT_FALSE(stream.isComplete());
}

TEST(Deflate, PackerMakesAStreamOfEachPiece) {
    ZlibPacker packer(5, 12, 4);
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{70000}}) {
        const auto bytes = someBytes(count, 6, 9);
        const auto packed = packer.pack(bytes);
        for (const DeflateFormat format : {DeflateFormat::Zlib, DeflateFormat::ZlibOrGzip}) {
            std::vector<std::byte> back(count);
            EXPECT_TRUE(inflateInto(packed, format, back));
            EXPECT_EQ(back, bytes);
        }
        std::vector<std::byte> larger(count + 1);
        EXPECT_FALSE(inflateInto(packed, DeflateFormat::Zlib, larger));
        EXPECT_FALSE(inflateInto(packed, DeflateFormat::Gzip, larger));
        if (count > 0) {
            EXPECT_FALSE(inflateInto(packed, DeflateFormat::Zlib, std::span(larger).first(count - 1)));
        }
        EXPECT_FALSE(inflateInto(packed.first(packed.size() - 1), DeflateFormat::Zlib, std::span(larger).first(count)));
    }
}

TEST(Deflate, StepsUseUpInputAndRoom) {
    const auto a = someBytes(1000, 7, 9), b = someBytes(10, 8, 9);
    const auto packed = joined(gzipBytes(a), gzipBytes(b));
    InflateStream stream(DeflateFormat::Gzip);
    std::span<const std::byte> rest = packed;
    std::vector<std::byte> out(1010);
    std::span<std::byte> room(out);
    std::span<std::byte> half = room.first(500);
    EXPECT_EQ(stream.step(rest, half), InflateStep::More);
    EXPECT_TRUE(half.empty());
    room = room.subspan(500);
    EXPECT_EQ(stream.step(rest, room), InflateStep::End);
    EXPECT_EQ(room.size(), 10u);
    stream.restart();
    EXPECT_EQ(stream.step(rest, room), InflateStep::End);
    EXPECT_TRUE(rest.empty() && room.empty());
    EXPECT_EQ(out, joined(a, b));
    stream.restart();
    EXPECT_EQ(stream.step(rest, room), InflateStep::Stuck);
}

TEST(Deflate, ChecksumsAreJoined) {
    const auto a = someBytes(1000, 9, 256), b = someBytes(10, 10, 256);
    EXPECT_EQ(joinedChecksum(zipChecksum(a), zipChecksum(b), b.size()), zipChecksum(joined(a, b)));
}

}  // namespace
}  // namespace svt
