#include <svt/volume/column_blocks.hpp>
#include <svt/volume/file/zip_container.hpp>
#include <svt/volume/file/zstd_frame_test.hpp>
#include <svt/volume/random_columns_test.hpp>

#include <gtest/gtest.h>

#include <functional>

namespace svt::volume {
namespace {

using test::kRandomScalars;
using test::randomColumns;

std::vector<std::byte> joined(const CompressedColumns& columns) {
    std::vector<std::byte> bytes;
    for (const auto& frame : columns.frames) bytes.insert(bytes.end(), frame.begin(), frame.end());
    return bytes;
}

/// Blocks of a volume with a change in their index or frames.
struct Changed {
    Vec3i dimension{300, 70, 20};
    CompressedColumns columns = *compressColumns(randomColumns(dimension, 5));

    /// The volume, or the error from opening or decoding.
    [[nodiscard]] Result<ColumnVolume> read() const {
        const std::vector<std::byte> frames = joined(columns);
        const auto blocks =
            ColumnBlocks::open(dimension, kRandomScalars, std::as_bytes(std::span(columns.index)), frames.size());
        if (!blocks) return blocks.error();
        return blocks->decodeAll(frames);
    }
    /// Replaces frame 1 by `bytes`, with matching CRC and size.
    void replaceFrame(std::vector<std::byte> bytes) {
        columns.frames[1] = std::move(bytes);
        columns.index[1].size = std::uint32_t(columns.frames[1].size());
        columns.index[1].crc = crc32Of(columns.frames[1]);
    }
    void expectRefused(Code code, std::string_view reason) const {
        const auto volume = read();
        ASSERT_FALSE(volume) << reason;
        EXPECT_EQ(volume.error().code(), code);
        EXPECT_NE(volume.error().message().find(reason), std::string::npos) << volume.error().message();
    }
};

TEST(ColumnBlocks, VolumeComesBackWithAnyNumberOfThreads) {
    const Vec3i dimension{700, 300, 30};
    const ColumnVolume volume = randomColumns(dimension, 11);
    const auto one = compressColumns(volume, 1);
    ASSERT_TRUE(one);
    ASSERT_EQ(one->index.size(), 6u);
    for (const int threads : {2, 5, 0}) {
        const auto many = compressColumns(volume, threads);
        ASSERT_TRUE(many);
        EXPECT_EQ(many->index, one->index);
        EXPECT_EQ(many->frames, one->frames);
    }
    const std::vector<std::byte> frames = joined(*one);
    const auto blocks =
        ColumnBlocks::open(dimension, kRandomScalars, std::as_bytes(std::span(one->index)), frames.size());
    ASSERT_TRUE(blocks);
    for (const int threads : {1, 2, 5, 0}) {
        const auto read = blocks->decodeAll(frames, threads);
        ASSERT_TRUE(read) << read.error().toString();
        EXPECT_TRUE(*read == volume);
    }
}

TEST(ColumnBlocks, EveryTileIsInItsBlock) {
    const Vec3i dimension{700, 300, 4};
    const auto columns = compressColumns(randomColumns(dimension, 1));
    ASSERT_TRUE(columns);
    const auto blocks = ColumnBlocks::open(dimension, kRandomScalars, std::as_bytes(std::span(columns->index)),
                                           joined(*columns).size());
    ASSERT_TRUE(blocks);
    EXPECT_EQ(blocks->blockOfTile(0, 0), 0u);
    EXPECT_EQ(blocks->blockOfTile(3, 3), 0u);
    EXPECT_EQ(blocks->blockOfTile(4, 3), 1u);
    EXPECT_EQ(blocks->blockOfTile(10, 4), 5u);
    EXPECT_EQ(blocks->offset(0), 0u);
    EXPECT_EQ(blocks->offset(2), columns->frames[0].size() + columns->frames[1].size());
}

TEST(ColumnBlocks, UnchangedBlocksAreRead) { EXPECT_TRUE(Changed().read()); }

TEST(ColumnBlocks, IndexThatLiesIsRefused) {
    const std::pair<std::function<void(std::vector<ColumnBlock>&)>, const char*> cases[] = {
        {[](auto& index) { index.pop_back(); }, "has 16 bytes, 2 blocks need 32"},
        {[](auto& index) { index.emplace_back(); }, "has 48 bytes"},
        {[](auto& index) { index[0].size += 1; }, "the index states"},
        {[](auto& index) { index[1].size = 0; }, "the index states"},
        {[](auto& index) { index[0].streamBytes = 0xFFFFFFFF; }, "cannot unpack to 4294967295"},
        {[](auto& index) { index[0].streamBytes -= 1; }, "not a zstd frame of the size"},
        {[](auto& index) { index[0].streamBytes += 1; }, "not a zstd frame of the size"},
        {[](auto& index) { index[0].streamBytes = 0; }, "not a zstd frame of the size"},
        {[](auto& index) { index[0].arrayBytes = 0xFFFFFFFF; }, "cannot take"},
        {[](auto& index) { index[1].arrayBytes -= 1; }, "block 1 of the columns: its arrays take more"},
    };
    for (const auto& [change, reason] : cases) {
        Changed changed;
        change(changed.columns.index);
        changed.expectRefused(Code::BadVolume, reason);
    }
}

TEST(ColumnBlocks, DamagedFrameFailsItsChecksum) {
    Changed changed;
    changed.columns.frames[1][7] ^= std::byte{1};
    changed.expectRefused(Code::BadChecksum, "block 1 of the columns has CRC32");
}

TEST(ColumnBlocks, TheFirstDamagedBlockIsTold) {
    Changed changed;
    changed.columns.frames[0][7] ^= std::byte{1};
    changed.columns.frames[1][7] ^= std::byte{1};
    changed.expectRefused(Code::BadChecksum, "block 0 of the columns");
}

TEST(ColumnBlocks, FramesOfOtherContentAreRefused) {
    Changed changed;
    changed.replaceFrame(std::vector<std::byte>(100, std::byte{'x'}));
    changed.expectRefused(Code::BadVolume, "not a zstd frame");
    changed.replaceFrame({});
    changed.expectRefused(Code::BadVolume, "not a zstd frame");
    // Two frames that together have the right size.
    std::vector<std::byte> two = test::zstdFrameOf(std::vector<std::uint8_t>(10));
    const std::vector<std::byte> second =
        test::zstdFrameOf(std::vector<std::uint8_t>(changed.columns.index[1].streamBytes - 10));
    two.insert(two.end(), second.begin(), second.end());
    changed.replaceFrame(two);
    changed.expectRefused(Code::BadVolume, "not a zstd frame");
    const std::size_t size = changed.columns.index[1].streamBytes;
    changed.replaceFrame(test::zstdFrameOf(std::vector<std::uint8_t>(size, 1)));
    changed.expectRefused(Code::BadVolume, "lengths of its streams do not fit");
    changed.replaceFrame(test::zstdFrameOf(std::vector<std::uint8_t>(size, 0xFF)));
    changed.expectRefused(Code::BadVolume, "lengths of its streams do not fit");
}

TEST(ColumnBlocks, FrameThatUnpacksToMoreThanSaidIsRefused) {
    Changed changed;
    changed.replaceFrame(test::zstdFrameOf(std::vector<std::uint8_t>(50'000'000)));
    changed.expectRefused(Code::BadVolume, "not a zstd frame of the size");
    changed.columns.index[1].streamBytes = 50'000'000;
    changed.expectRefused(Code::BadVolume, "cannot unpack to 50000000");
}

TEST(ColumnBlocks, DamageWithTheRightChecksumIsRefusedOrHarmless) {
    const Changed good;
    std::mt19937 random(1);
    int refused = 0;
    for (int round = 0; round < 500; ++round) {
        Changed changed = good;
        std::vector<std::byte> frame = changed.columns.frames[1];
        frame[random() % frame.size()] ^= std::byte(1u << random() % 8);
        changed.replaceFrame(frame);
        const auto volume = changed.read();
        if (!volume)
            ++refused;
        else
            EXPECT_EQ(volume->countVoxels(kRandomScalars).size(), kRandomScalars);
    }
    EXPECT_GT(refused, 100);
}

TEST(ColumnBlocks, LimitGrowsWithTheFileUpToAnEnd) {
    EXPECT_EQ(maxArrayBytes(0), 256u << 20);
    EXPECT_EQ(maxArrayBytes(1'000'000), (256u << 20) + 1'024'000'000u);
    EXPECT_EQ(maxArrayBytes(~std::uint64_t{0}), std::uint64_t{16} << 30);
}

TEST(ColumnBlocks, EmptyGridOfAnySizeFitsTheLimit) {
    const Vec3i dimension{65535, 2000, 65535};
    ColumnVolume shape = ColumnVolume::fromTiles(
        dimension,
        std::vector<ColumnTileData>(
            1024 * 32,
            ColumnTileData{std::vector<std::uint8_t>(64, 0), std::vector<std::uint16_t>(64, 0), {0, 1}, {{65535, 0}}}));
    const auto columns = compressColumns(shape);
    ASSERT_TRUE(columns) << columns.error().toString();
    EXPECT_LT(joined(*columns).size(), 200'000u);
}

}  // namespace
}  // namespace svt::volume
