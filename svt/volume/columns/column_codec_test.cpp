#include <svt/volume/columns/column_codec.hpp>
#include <svt/volume/label_table.hpp>
#include <svt/volume/random_columns_test.hpp>

#include <gtest/gtest.h>

namespace svt::volume {
namespace {

using test::isCanonical;
using test::kRandomScalars;
using test::randomColumns;
using Bytes = std::vector<std::uint8_t>;

PerStream<std::span<const std::uint8_t>> viewsOf(const BlockStreams& streams) {
    PerStream<std::span<const std::uint8_t>> views;
    for (std::size_t s = 0; s < kBlockStreams; ++s) views[s] = streams[s];
    return views;
}

Bytes& in(BlockStreams& streams, BlockStream which) { return streams[static_cast<std::size_t>(which)]; }

std::uint64_t arrayBytes(std::span<const ColumnTile> tiles) {
    std::uint64_t bytes = 0;
    for (const ColumnTile& tile : tiles) bytes += arrayBytesOf(tile);
    return bytes;
}

/// Tiles of a volume of one block, after coding and decoding.
Result<std::vector<ColumnTileData>> recoded(const ColumnVolume& volume) {
    const Vec3i size = volume.dimension();
    const BlockShape shape{size.x, size.y, size.z};
    return decodeBlock(viewsOf(encodeBlock(volume.tiles(), shape)), shape, kRandomScalars, arrayBytes(volume.tiles()));
}

/// 2 x 2 columns of three samples: scalar 7 at (1, 0, 0), else background. docs/formats/svt.md has the same.
struct Example {
    BlockShape shape{2, 2, 3};
    ColumnTileData tile{{0, 1}, {0, 1, 0, 0}, {0, 1, 3}, {{3, 0}, {1, 7}, {3, 0}}};
    BlockStreams streams{Bytes{0, 0},  // no row is repeated
                         Bytes{5, 5, 30}, Bytes{}, Bytes{0, 0}, Bytes{0, 0, 16}, Bytes{}, Bytes{0, 7}, Bytes{2, 0}};

    Result<std::vector<ColumnTileData>> decode(std::uint64_t most = 1000) {
        return volume::decodeBlock(viewsOf(streams), shape, 8, most);
    }
};

TEST(ColumnCodec, ExampleOfTheFormatIsWrittenAsItSays) {
    const Example example;
    const ColumnTile tile = example.tile.view();
    EXPECT_EQ(encodeBlock({&tile, 1}, example.shape), example.streams);
}

TEST(ColumnCodec, ExampleOfTheFormatIsReadAsItSays) {
    const auto tiles = Example().decode();
    ASSERT_TRUE(tiles) << tiles.error().toString();
    ASSERT_EQ(tiles->size(), 1u);
    EXPECT_EQ((*tiles)[0].rowOf, Example().tile.rowOf);
    EXPECT_EQ((*tiles)[0].rowColumns, Example().tile.rowColumns);
    EXPECT_EQ((*tiles)[0].columnStart, Example().tile.columnStart);
    EXPECT_EQ((*tiles)[0].runs, Example().tile.runs);
}

TEST(ColumnCodec, AnyColumnsComeBackAsTheyWere) {
    std::mt19937 random(7);
    for (std::uint32_t seed = 0; seed < 150; ++seed) {
        const Vec3i size{std::int32_t(1 + random() % 256), std::int32_t(1 + random() % 256),
                         std::int32_t(1 + random() % 60)};
        const ColumnVolume volume = randomColumns(size, seed);
        auto tiles = recoded(volume);
        ASSERT_TRUE(tiles) << "seed " << seed << ": " << tiles.error().toString();
        EXPECT_TRUE(ColumnVolume::fromTiles(size, std::move(*tiles)) == volume) << "seed " << seed;
    }
}

TEST(ColumnCodec, TallNoiseComesBackAsItWas) {
    // Ends and scalars that need several bytes, more runs than one command copies, moves and shifts of any size.
    std::mt19937 random(1);
    ColumnTileBuilder builder(9);
    std::vector<volume::Run> runs;
    for (int j = 0; j < 5; ++j) {
        std::vector<std::uint16_t> row(9);
        for (std::uint16_t& column : row) {
            if (runs.empty() || random() % 3 == 0) {
                runs.clear();
                std::uint32_t end = 0;
                while (end < 65'000) {
                    end += 1 + std::uint32_t(random() % 300) * std::uint32_t(random() % 3);
                    runs.push_back(
                        {std::min(end, 65'000u), Scalar(runs.size() % 2 == 0 ? random() % 60'000'000 : 60'000'001)});
                }
            } else {
                runs[random() % runs.size()].scalar = Scalar(60'000'002 + random() % 1000);
            }
            column = builder.addColumn(runs);
        }
        builder.addRow(row);
    }
    const ColumnVolume volume = ColumnVolume::fromTiles({9, 5, 65'000}, {builder.finish()});
    const BlockShape shape{9, 5, 65'000};
    auto tiles =
        decodeBlock(viewsOf(encodeBlock(volume.tiles(), shape)), shape, kMaxScalarCount, arrayBytes(volume.tiles()));
    ASSERT_TRUE(tiles) << tiles.error().toString();
    EXPECT_TRUE(ColumnVolume::fromTiles({9, 5, 65'000}, std::move(*tiles)) == volume);
}

TEST(ColumnCodec, TilesThatAreNotCanonicalBecomeSo) {
    // Background in two pieces, a column that stands twice, one that is not used, an unused row.
    const ColumnTileData tile{
        {1, 1}, {3, 3, 2, 1, 1, 2}, {0, 2, 4, 6, 7}, {{1, 7}, {3, 0}, {2, 0}, {3, 0}, {1, 7}, {3, 0}, {3, 0}}};
    const ColumnTile view = tile.view();
    const BlockShape shape{3, 2, 3};
    const auto tiles = decodeBlock(viewsOf(encodeBlock({&view, 1}, shape)), shape, 8, arrayBytesOf(view));
    ASSERT_TRUE(tiles) << tiles.error().toString();
    EXPECT_EQ((*tiles)[0].rowOf, (std::vector<std::uint8_t>{0, 0}));
    EXPECT_EQ((*tiles)[0].rowColumns, (std::vector<std::uint16_t>{0, 0, 1}));
    EXPECT_EQ((*tiles)[0].columnStart, (std::vector<std::uint32_t>{0, 1, 3}));
    EXPECT_EQ((*tiles)[0].runs, (std::vector<volume::Run>{{3, 0}, {1, 7}, {3, 0}}));
}

TEST(ColumnCodec, RepeatedRowsCostNothing) {
    const Vec3i size{256, 256, 8};
    std::vector<Scalar> dense(std::size_t(256 * 256 * 8));
    for (std::size_t s = 0; s < dense.size(); ++s) dense[s] = Scalar(s % 256 / 32);
    const ColumnVolume volume = ColumnVolume::fromDense(size, dense);
    BlockStreams streams = encodeBlock(volume.tiles(), {256, 256, 8});
    EXPECT_EQ(in(streams, BlockStream::Operations).size(), 8u);
    EXPECT_EQ(in(streams, BlockStream::Repeats), Bytes{0});
}

TEST(ColumnCodec, ArraysMayTakeWhatIsSaidAndNoByteMore) {
    const std::uint64_t bytes = arrayBytesOf(Example().tile.view());
    EXPECT_EQ(bytes, 2u + 8u + 12u + 24u);
    EXPECT_TRUE(Example().decode(bytes));
    for (const std::uint64_t most : {std::uint64_t{0}, std::uint64_t{23}, bytes - 1}) {
        const auto tiles = Example().decode(most);
        ASSERT_FALSE(tiles);
        EXPECT_NE(tiles.error().message().find("more bytes than"), std::string::npos);
    }
}

TEST(ColumnCodec, FewCommandsCannotFillTheMemory) {
    // One column of 60,000 runs, then 255 that copy all of it but the first run.
    Example bomb;
    bomb.shape = {256, 1, 60'000};
    for (Bytes& stream : bomb.streams) stream.clear();
    in(bomb.streams, BlockStream::Repeats) = {0};
    in(bomb.streams, BlockStream::Operations).assign(256, kInsert);
    in(bomb.streams, BlockStream::Widths).assign(256, 0);
    for (int run = 0; run < 60'000; ++run) {
        in(bomb.streams, BlockStream::Commands).push_back(kNewRun);
        in(bomb.streams, BlockStream::Scalars).push_back(std::uint8_t(run % 2));
        in(bomb.streams, BlockStream::Heights).push_back(0);
    }
    for (int column = 1; column < 256; ++column) {
        for (const std::uint32_t command : {kNewRun, kCopy})
            in(bomb.streams, BlockStream::Commands).push_back(std::uint8_t(command));
        in(bomb.streams, BlockStream::Scalars).push_back(std::uint8_t(2 + column % 5));
        in(bomb.streams, BlockStream::Heights).push_back(0);
    }
    ASSERT_TRUE(bomb.decode(1'000'000'000)) << "the streams are right";
    const auto tiles = bomb.decode(10'000'000);
    ASSERT_FALSE(tiles);
    EXPECT_NE(tiles.error().message().find("more bytes than"), std::string::npos) << tiles.error().message();
}

// A table, one line for each way to be wrong.
// NOLINTNEXTLINE(readability-function-size)
TEST(ColumnCodec, WrongStreamsAreRefused) {
    using enum BlockStream;
    const struct {
        BlockStream stream;
        Bytes bytes;
        const char* reason;
    } cases[] = {
        {Repeats, {}, "too short"},
        {Repeats, {1, 0}, "first row repeats"},
        {Repeats, {0, 1}, "longer than"},
        {Repeats, {0, 0, 0}, "repeated beyond"},
        {Repeats, {0, 0, 0, 0}, "longer than"},
        {Operations, {}, "too short"},
        {Operations, {5, 5}, "too short"},
        {Operations, {5, 5, 30, 30}, "longer than"},
        {Operations, {4, 5, 30}, "missing segment of the row above"},
        {Operations, {24, 5, 30}, "missing segment of the row above"},
        {Operations, {5, 5, 26}, "missing segment of the row above"},
        {Operations, {5, 5, 27}, "missing segment of the row above"},
        {Operations, {5, 5, 36}, "outside its row"},
        {Operations, {5, 5, 18}, "outside its row"},
        {Operations, {5, 5, 24, 24, 24}, "longer than"},
        {Operations, {5, 11, 30}, "unknown operation"},
        {Operations, {5, 5, 48}, "unknown operation"},
        {Operations, {5, 5, 255}, "unknown operation"},
        {Shifts, {0}, "longer than"},
        {Widths, {0}, "too short"},
        {Widths, {0, 1}, "outside its row"},
        {Widths, {0, 255, 255, 255, 255, 15}, "outside its row"},
        {Widths, {0, 255, 255, 255, 255, 31}, "too short, or a number in it too large"},
        {Widths, {0, 128, 128, 128, 128, 128}, "too short, or a number in it too large"},
        {Commands, {0, 0}, "too short"},
        {Commands, {0, 0, 11}, "unknown command"},
        {Commands, {0, 0, 15}, "unknown command"},
        {Commands, {16, 0, 16}, "that do not exist are copied"},
        {Commands, {17, 0, 16}, "that do not exist are copied"},
        {Commands, {0, 0, 17}, "that do not exist are copied"},
        {Commands, {0, 0, 20}, "that do not exist are copied"},
        {Commands, {0, 0, 254}, "that do not exist are copied"},
        {Commands, {0, 0, 2}, "does not exist is moved"},
        {Commands, {1, 0, 16}, "does not exist is moved"},
        {Commands, {0, 0, 5}, "below its begin or beyond the top"},
        {Commands, {0, 0, 3, 16}, "below its begin or beyond the top"},
        {Commands, {0, 0, 16, 0}, "longer than"},
        {Moves, {0}, "longer than"},
        {Scalars, {0, 8}, "no label's range"},
        {Scalars, {0, 255, 255, 255, 255, 15}, "no label's range"},
        {Scalars, {0}, "too short"},
        {Heights, {3, 0}, "beyond the top"},
        {Heights, {255, 255, 255, 255, 15, 0}, "beyond the top"},
        {Heights, {2, 2}, "longer than"},
        {Heights, {2, 3}, "beyond the top"},
    };
    for (const auto& wrong : cases) {
        Example example;
        in(example.streams, wrong.stream) = wrong.bytes;
        const auto tiles = example.decode();
        ASSERT_FALSE(tiles) << wrong.reason;
        EXPECT_EQ(tiles.error().code(), Code::BadVolume);
        EXPECT_NE(tiles.error().message().find(wrong.reason), std::string::npos)
            << "stream " << int(wrong.stream) << ": " << tiles.error().message() << "\nexpected: " << wrong.reason;
    }
}

TEST(ColumnCodec, NeighbouringRunsOfOneScalarAreRefused) {
    Example example;
    in(example.streams, BlockStream::Commands) = {0, 0, 0};
    in(example.streams, BlockStream::Scalars) = {0, 7, 7};
    in(example.streams, BlockStream::Heights) = {2, 0, 1};
    const auto tiles = example.decode();
    ASSERT_FALSE(tiles);
    EXPECT_NE(tiles.error().message().find("one scalar"), std::string::npos);
}

TEST(ColumnCodec, DamagedStreamsAreRefusedOrGiveCanonicalTiles) {
    std::mt19937 random(3);
    int refused = 0;
    for (std::uint32_t round = 0; round < 4000; ++round) {
        const Vec3i size{std::int32_t(1 + random() % 150), std::int32_t(1 + random() % 90), 12};
        static ColumnVolume volume;
        if (round % 40 == 0) volume = randomColumns(size, round);
        const BlockShape shape{volume.dimension().x, volume.dimension().y, volume.dimension().z};
        BlockStreams streams = encodeBlock(volume.tiles(), shape);
        for (std::uint32_t change = 1 + random() % 4; change > 0; --change) {
            Bytes& stream = streams[random() % kBlockStreams];
            const std::size_t at = random() % (stream.size() + 1);
            switch (random() % 3) {
                case 0:
                    if (at < stream.size()) stream[at] = std::uint8_t(random());
                    break;
                case 1: stream.insert(stream.begin() + std::ptrdiff_t(at), std::uint8_t(random() % 48)); break;
                default: stream.resize(at);
            }
        }
        const auto tiles = decodeBlock(viewsOf(streams), shape, kRandomScalars, 1'000'000);
        if (!tiles) {
            ++refused;
            continue;
        }
        for (std::size_t t = 0; t < tiles->size(); ++t) {
            const auto width = std::size_t(shape.tileWidth(std::int32_t(t) % shape.tilesX()));
            const auto height = std::size_t(shape.tileHeight(std::int32_t(t) / shape.tilesX()));
            ASSERT_TRUE(isCanonical((*tiles)[t], width, height, 12, kRandomScalars)) << "round " << round;
        }
    }
    EXPECT_GT(refused, 2000);
}

}  // namespace
}  // namespace svt::volume
