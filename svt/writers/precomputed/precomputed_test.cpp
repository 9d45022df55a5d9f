#include <svt/core/deflate.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/volume/volume_part.hpp>
#include <svt/writers/precomputed/precomputed_shards.hpp>
#include <svt/writers/precomputed/precomputed_writer.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <iomanip>
#include <span>
#include <sstream>

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

/// A chunk of a sharded level, found as the specification of the format says; written for this test from it.
std::string chunkOf(const std::filesystem::path& level, const json& sharding, std::uint64_t id) {
    const auto number = [](const std::string& bytes, std::size_t at) {
        std::uint64_t value = 0;
        std::memcpy(&value, bytes.data() + at, 8);
        return value;
    };
    const auto unpacked = [](const std::string& bytes) {
        const auto plain = inflateBytes(std::as_bytes(std::span(bytes)), DeflateFormat::Gzip, 1 << 16, 1 << 24);
        EXPECT_EQ(plain.status, InflateStatus::Done);
        return std::string(reinterpret_cast<const char*>(plain.bytes.data()), plain.bytes.size());
    };
    const int minishardBits = sharding["minishard_bits"], shardBits = sharding["shard_bits"];
    const std::uint64_t hashed = id >> sharding["preshift_bits"].get<int>();
    const std::uint64_t minishard = hashed & ((1u << minishardBits) - 1),
                        shard = hashed >> minishardBits & ((1u << shardBits) - 1);
    std::ostringstream name;
    name << std::hex << std::setw((shardBits + 3) / 4) << std::setfill('0') << shard << ".shard";
    const std::string file = readText(level / name.str());
    const std::size_t indexEnd = std::size_t{16} << minishardBits;
    const std::uint64_t begin = number(file, 16 * minishard), end = number(file, 16 * minishard + 8);
    const std::string index = unpacked(file.substr(indexEnd + begin, end - begin));
    const std::size_t count = index.size() / 24;
    std::uint64_t code = 0, at = indexEnd;
    for (std::size_t n = 0; n < count; ++n) {
        code += number(index, 8 * n);
        at += number(index, 8 * (count + n));
        const std::uint64_t size = number(index, 8 * (2 * count + n));
        if (code == id) return unpacked(file.substr(at, size));
        at += size;
    }
    return {};
}

TEST(Precomputed, MortonCodesLeaveOutBitsThatAreNotNeeded) {
    // Bits of x, y, z by turns; y has one, z none.
    const Vec3i chunks{5, 2, 1};
    EXPECT_EQ(mortonCode({0, 0, 0}, chunks), 0u);
    EXPECT_EQ(mortonCode({1, 0, 0}, chunks), 1u);
    EXPECT_EQ(mortonCode({0, 1, 0}, chunks), 2u);
    EXPECT_EQ(mortonCode({2, 0, 0}, chunks), 4u);
    EXPECT_EQ(mortonCode({4, 1, 0}, chunks), 10u);
    EXPECT_EQ(ShardBits::of(chunks).chunk + ShardBits::of(chunks).minishard + ShardBits::of(chunks).shard, 4);
    EXPECT_EQ(mortonCode({1, 1, 1}, {2, 2, 2}), 7u);
    EXPECT_EQ(mortonCode({3, 2, 1}, {4, 4, 4}), 0b011101u);
}

TEST(Precomputed, ShardsHaveTheChunksOfTheFolder) {
    const TemporaryFolder folder;
    for (const Vec3i dimension : {Vec3i{600, 300, 200}, Vec3i{150, 70, 80}, Vec3i{40, 50, 60}}) {
        std::filesystem::remove_all(folder / "v.precomputed");
        std::filesystem::remove_all(folder / "s.precomputed");
        const auto volume = sampleVolume(dimension);
        VolumeWriteOptions options;
        ASSERT_TRUE(writePrecomputed(volume, folder / "v.precomputed", options));
        options.precomputed.isSharded = true;
        ASSERT_TRUE(writePrecomputed(volume, folder / "s.precomputed", options));
        const json info = json::parse(readText(folder / "s.precomputed/info"));
        std::size_t found = 0, files = 0;
        for (const json& scale : info["scales"]) {
            const std::string key = scale["key"];
            const Vec3i d{scale["size"][0], scale["size"][1], scale["size"][2]};
            const Vec3i chunks{(d.x + 63) / 64, (d.y + 63) / 64, (d.z + 63) / 64};
            for (int k = 0; k < chunks.z; ++k)
                for (int j = 0; j < chunks.y; ++j)
                    for (int i = 0; i < chunks.x; ++i) {
                        std::string name;
                        for (const auto& [first, size] : {std::pair{i * 64, d.x}, {j * 64, d.y}, {k * 64, d.z}})
                            name += (name.empty() ? "" : "_") + std::to_string(first) + "-" +
                                    std::to_string(std::min(first + 64, size));
                        const std::string expected = readText(folder / "v.precomputed" / key / name);
                        ASSERT_FALSE(expected.empty());
                        ASSERT_TRUE(chunkOf(folder / "s.precomputed" / key, scale["sharding"],
                                            mortonCode({i, j, k}, chunks)) == expected)
                            << key << " " << name;
                        ++found;
                    }
            for ([[maybe_unused]] const auto& file :
                 std::filesystem::directory_iterator(folder / "s.precomputed" / key))
                ++files;
        }
        EXPECT_GE(found, files);
        if (dimension.x == 600) {
            EXPECT_GT(files, info["scales"].size()) << "several shards";
        }
    }
}

}  // namespace
}  // namespace svt::writers
