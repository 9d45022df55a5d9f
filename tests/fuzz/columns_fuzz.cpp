// For any streams of a block the decoder returns valid tiles, or an error.
// Input: four bytes for width, height, height in samples and scalars, then the eight streams, each with two bytes of
// length.
#include <svt/volume/columns/column_codec.hpp>

#include <cstdint>
#include <cstdlib>

namespace {

using namespace svt::volume;

void require(bool condition) {
    if (!condition) std::abort();
}

void checkTile(const ColumnTileData& tile, std::size_t width, std::size_t height, std::uint32_t nz, Scalar scalars) {
    require(tile.rowOf.size() == height && tile.columnStart.back() == tile.runs.size());
    for (const auto row : tile.rowOf) require((row + 1u) * width <= tile.rowColumns.size());
    for (const auto column : tile.rowColumns) {
        require(column + 1u < tile.columnStart.size());
        std::uint32_t top = 0;
        for (std::uint32_t r = tile.columnStart[column]; r < tile.columnStart[column + 1u]; ++r) {
            require(tile.runs[r].end > top && tile.runs[r].scalar < scalars);
            top = tile.runs[r].end;
        }
        require(top == nz);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::span<const std::uint8_t> rest(data, size);
    if (rest.size() < 4) return 0;
    const BlockShape shape{1 + rest[0], 1 + rest[1], 1 + 7 * rest[2]};
    const Scalar scalars = 1u + rest[3];
    rest = rest.subspan(4);
    PerStream<std::span<const std::uint8_t>> streams;
    for (auto& stream : streams) {
        if (rest.size() < 2) break;
        const std::size_t length = std::min<std::size_t>(rest[0] + 256u * rest[1], rest.size() - 2);
        stream = rest.subspan(2, length);
        rest = rest.subspan(2 + length);
    }
    const auto tiles = decodeBlock(streams, shape, scalars, 10'000'000);
    if (!tiles) return 0;
    for (std::size_t t = 0; t < tiles->size(); ++t)
        checkTile((*tiles)[t], std::size_t(shape.tileWidth(std::int32_t(t) % shape.tilesX())),
                  std::size_t(shape.tileHeight(std::int32_t(t) / shape.tilesX())), std::uint32_t(shape.nz), scalars);
    // Tiles that were read can be written and read again.
    std::vector<ColumnTile> views;
    for (const ColumnTileData& tile : *tiles) views.push_back(tile.view());
    const BlockStreams written = encodeBlock(views, shape);
    for (std::size_t s = 0; s < kBlockStreams; ++s) streams[s] = written[s];
    const auto again = decodeBlock(streams, shape, scalars, 10'000'000);
    require(again.hasValue());
    for (std::size_t t = 0; t < tiles->size(); ++t)
        require((*again)[t].rowOf == (*tiles)[t].rowOf && (*again)[t].rowColumns == (*tiles)[t].rowColumns &&
                (*again)[t].runs == (*tiles)[t].runs);
    return 0;
}
