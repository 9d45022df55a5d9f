#include <svt/core/temporary_folder_test.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/volume/volume_part.hpp>
#include <svt/writers/precomputed/precomputed_writer.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>

namespace svt::writers {
namespace {

using nlohmann::json;
using svt::test::readText;
using svt::test::TemporaryFolder;
using volume::test::sampleVolume;

/// The value at (x, y, z) of a chunk, by the published description of compressed_segmentation: it shares nothing with the
/// writer.
std::uint32_t valueAt(const std::vector<std::uint32_t>& file, Vec3i size, int x, int y, int z) {
    const std::uint32_t* channel = file.data() + file.at(0);
    const int gx = (size.x + 7) / 8, gy = (size.y + 7) / 8;
    const std::uint32_t* header = channel + 2 * (x / 8 + gx * (y / 8 + gy * (z / 8)));
    const std::uint32_t table = header[0] & 0xFFFFFF, bits = header[0] >> 24, values = header[1];
    const auto place = static_cast<std::uint32_t>(x % 8 + 8 * (y % 8 + 8 * (z % 8)));
    const std::uint64_t bit = std::uint64_t{place} * bits;
    std::uint32_t index = 0;
    for (std::uint32_t b = 0; b < bits; ++b) index |= (channel[values + (bit + b) / 32] >> (bit + b) % 32 & 1) << b;
    return channel[table + index];
}

std::vector<std::uint32_t> wordsOf(const std::string& text) {
    std::vector<std::uint32_t> words(text.size() / 4);
    std::memcpy(words.data(), text.data(), words.size() * 4);
    return words;
}

TEST(Precomputed, ABlockOfOneValueIsAHeaderAndATable) {
    const std::vector<std::uint32_t> values(4 * 3 * 2, 7);
    // Channel at word 1; table at word 2 of it, no bits; the packed values would begin at word 2, too.
    EXPECT_EQ(compressSegmentation(values, {4, 3, 2}), (std::vector<std::uint32_t>{1, 2, 2, 7}));
}

TEST(Precomputed, TwoValuesTakeABitEachAndTablesAreShared) {
    // Two blocks along x; in both, the first place is 5 and the rest 9.
    std::vector<std::uint32_t> values(16 * 8 * 8, 9);
    values[0] = values[8] = 5;
    const auto words = compressSegmentation(values, {16, 8, 8});
    ASSERT_EQ(words.size(), 1u + 4 + 16 + 2 + 16);
    EXPECT_EQ(words[1], 20u | 1u << 24);
    EXPECT_EQ(words[2], 4u);
    EXPECT_EQ(words[3], 20u | 1u << 24) << "the same table";
    EXPECT_EQ(words[4], 22u);
    EXPECT_EQ(words[5], 0xFFFFFFFEu);
    EXPECT_EQ(words[21], 5u);
    EXPECT_EQ(words[22], 9u);
}

TEST(Precomputed, ValuesOfAnyNumberComeBack) {
    for (const std::uint32_t distinct : {1u, 2u, 3u, 5u, 17u, 300u, 100'000u}) {
        const Vec3i size{13, 9, 10};
        std::vector<std::uint32_t> values;
        for (std::uint32_t p = 0; p < 13 * 9 * 10; ++p) values.push_back(p * 2654435761u % distinct * 40'000u);
        const auto words = compressSegmentation(values, size);
        std::size_t p = 0;
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) ASSERT_EQ(valueAt(words, size, x, y, z), values[p++]) << distinct;
    }
}

TEST(Precomputed, TheFolderHasEverySampleOfEveryLevel) {
    const TemporaryFolder folder;
    const auto volume = sampleVolume({150, 70, 80});
    const auto bytes = writePrecomputed(volume, folder / "v.precomputed");
    ASSERT_TRUE(bytes) << bytes.error().toString();
    const json info = json::parse(readText(folder / "v.precomputed/info"));
    ASSERT_EQ(info["scales"].size(), 3u);
    for (std::size_t level = 0; level < 3; ++level) {
        const auto expected = volume::coarseVolume(volume, static_cast<int>(level));
        ASSERT_TRUE(expected);
        const json& scale = info["scales"][level];
        const Vec3i d = expected->grid.dimension();
        ASSERT_EQ(scale["size"], json({d.x, d.y, d.z}));
        EXPECT_DOUBLE_EQ(scale["resolution"][1].get<double>(), expected->grid.spacing().y * 1e9);
        for (int k = 0; k < d.z; k += 64)
            for (int j = 0; j < d.y; j += 64)
                for (int i = 0; i < d.x; i += 64) {
                    const Vec3i size{std::min(64, d.x - i), std::min(64, d.y - j), std::min(64, d.z - k)};
                    const auto range = [](int from, int count) {
                        return std::to_string(from) + "-" + std::to_string(from + count);
                    };
                    const auto words =
                        wordsOf(readText(folder.path() / "v.precomputed" / scale["key"].get<std::string>() /
                                         (range(i, size.x) + "_" + range(j, size.y) + "_" + range(k, size.z))));
                    ASSERT_FALSE(words.empty());
                    for (int z = 0; z < size.z; z += 3)
                        for (int y = 0; y < size.y; ++y)
                            for (int x = 0; x < size.x; ++x)
                                ASSERT_EQ(valueAt(words, size, x, y, z),
                                          expected->columns.scalarAt(i + x, j + y, k + z));
                }
    }
    const json properties = json::parse(readText(folder / "v.precomputed/properties/info"))["inline"];
    EXPECT_EQ(properties["ids"], json({"1", "2", "3", "4", "5"}));
    EXPECT_EQ(properties["properties"][0]["values"][0], "Küche");
    for (const json& property : properties["properties"]) EXPECT_EQ(property["values"].size(), 5u);
    const json state = json::parse(readText(folder / "v.precomputed/state.json"));
    EXPECT_EQ(state["layers"][0]["segmentColors"].size(), 5u);
    const auto again = writePrecomputed(volume, folder / "v.precomputed");
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().code(), Code::WouldDestroy);
    EXPECT_EQ(folder.count(), 1);
}

}  // namespace
}  // namespace svt::writers
