#include <svt/volume_readers/zarr/chunk_codecs.hpp>
#include <svt/volume_readers/zarr/zarr_array.hpp>

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace svt::volume_readers {
namespace {

using namespace std::string_view_literals;

std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text.data(), text.size())); }

Result<std::string> unpacked(CodecKind codec, std::string_view stored, std::uint64_t size) {
    SVT_TRY(bytes, unpackChunk(codec, bytesOf(stored), size));
    return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

TEST(ChunkCodecs, Lz4BlocksAreLiteralsAndMatches) {
    // "ab" as literals, 10 bytes from 2 back (they overlap), "xyz12" as the last literals.
    EXPECT_EQ(*unpacked(CodecKind::Lz4,
                        "\x11\0\0\0\x26"
                        "ab\2\0\x50xyz12"sv,
                        17),
              "abababababab"
              "xyz12");
    // 15 + 3 literals.
    EXPECT_EQ(*unpacked(CodecKind::Lz4, "\x12\0\0\0\xf0\3abcdefghijklmnopqr"sv, 18), "abcdefghijklmnopqr");
}

TEST(ChunkCodecs, DamagedLz4IsRefused) {
    for (const std::string_view stored : {"\x11\0\0\0\x26"
                                          "ab\3\0\x50xyz12"sv,  // from before the beginning
                                          "\x11\0\0\0\x26"
                                          "ab\0\0\x50xyz12"sv,
                                          "\x11\0\0\0\x26"
                                          "ab\2"sv,  // cut
                                          "\x11\0\0\0\x2f"
                                          "ab\2\0\xff\xff\xff"sv,                          // too long
                                          "\x11\0\0\0\xf0\xff\xff"sv, "\x11\0\0"sv, ""sv,  // no end
                                          "\x12\0\0\0\x26"
                                          "ab\2\0\x50xyz12"sv})  // another size
        EXPECT_EQ(unpacked(CodecKind::Lz4, stored, 17).error().code(), Code::BadImage) << stored;
}

TEST(ChunkCodecs, TheChecksumOfTheSpecificationIsRight) {
    EXPECT_EQ(*unpacked(CodecKind::Crc32c, "123456789\x83\x92\x06\xe3"sv, 0), "123456789");
    EXPECT_EQ(unpacked(CodecKind::Crc32c, "123456788\x83\x92\x06\xe3"sv, 0).error().code(), Code::BadImage);
    EXPECT_EQ(unpacked(CodecKind::Crc32c, "abc"sv, 0).error().code(), Code::BadImage);
}

TEST(ChunkCodecs, BloscIsCopiedSplitAndShuffled) {
    // Version 2, flags: copied; items of 2 bytes; 4 bytes in one block.
    EXPECT_EQ(*unpacked(CodecKind::Blosc, "\2\1\2\2\4\0\0\0\4\0\0\0\x14\0\0\0abcd"sv, 4), "abcd");
    // LZ4 (format 1), not split, shuffled: the stream is as long as the block, so it stands as it is.
    EXPECT_EQ(*unpacked(CodecKind::Blosc, "\2\1\x31\2\4\0\0\0\4\0\0\0\x1c\0\0\0\x14\0\0\0\4\0\0\0acbd"sv, 4), "abcd");
    // Bits: 8 items of a byte, one row of bits after the other; row 0 has all set.
    EXPECT_EQ(*unpacked(CodecKind::Blosc,
                        "\2\1\x34\1\x8\0\0\0\x8\0\0\0\x20\0\0\0\x14\0\0\0\x8\0\0\0\xff\0\0\0\0\0\0\x1"sv, 8),
              "\x81\1\1\1\1\1\1\1");
}

TEST(ChunkCodecs, DamagedBloscIsRefused) {
    for (const std::string_view stored :
         {"\2\1\2\2\4\0\0\0\4\0\0\0\x14\0\0\0abc"sv,                             // cut
          "\2\1\2\2\5\0\0\0\4\0\0\0\x14\0\0\0abcd"sv,                            // another size
          "\2\1\x31\2\4\0\0\0\0\0\0\0\x14\0\0\0abcd"sv,                          // empty blocks
          "\2\1\x31\2\4\0\0\0\1\0\0\0\x14\0\0\0abcd"sv,                          // too many
          "\2\1\x31\2\4\0\0\0\4\0\0\0\x1c\0\0\0\xff\xff\xff\xff\4\0\0\0acbd"sv,  // beyond it
          "\2\1\x31\2\4\0\0\0\4\0\0\0\x1c\0\0\0\x14\0\0\0\xff\0\0\0acbd"sv,
          "\2\1\x11\2\4\0\0\0\4\0\0\0\x1c\0\0\0\x14\0\0\0\4\0\0\0acbd"sv,  // BloscLZ
          "\2\1"sv})
        EXPECT_EQ(unpacked(CodecKind::Blosc, stored, 4).error().code(), Code::BadImage) << stored;
}

TEST(ChunkCodecs, ChunksThatCannotBeThatLargeTakeNoMemory) {
    for (const CodecKind codec :
         {CodecKind::Zlib, CodecKind::Gzip, CodecKind::Zstd, CodecKind::Lz4, CodecKind::Blosc}) {
        EXPECT_FALSE(unpacked(codec, "0123456789abcdef0123456789", kMostChunkBytes + 1));
        EXPECT_FALSE(unpacked(codec, "0123456789abcdef0123456789", 1000));
        EXPECT_FALSE(unpacked(codec, "", 10));
    }
}

TEST(ZarrPaths, StayInTheirFolder) {
    for (const char* inside : {"0", "labels/a b/0", "a..b", "..."}) EXPECT_TRUE(isPathInside(inside)) << inside;
    for (const std::string_view outside :
         {""sv, "/etc"sv, ".."sv, "."sv, "a/../b"sv, "a//b"sv, "a/"sv, "a\\..\\b"sv, "c:x"sv, "a\0b"sv})
        EXPECT_FALSE(isPathInside(outside)) << outside;
}

}  // namespace
}  // namespace svt::volume_readers
