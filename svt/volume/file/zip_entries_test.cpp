#include <svt/volume/zip_entries.hpp>

#include <svt/core/temporary_folder_test.hpp>
#include <svt/volume/file/zip_container.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/volume/svt_file.hpp>

#include <gtest/gtest.h>

namespace svt::volume {
namespace {

using svt::test::readText;
using svt::test::TemporaryFolder;

std::span<const std::byte> bytesOfString(const std::string& text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

std::string stringOf(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

struct Written {
    TemporaryFolder folder;
    std::filesystem::path before = folder / "before.svt", after = folder / "after.svt";
    std::string text = std::string(5000, 'x') + "end", small = "abc";

    Written() {
        EXPECT_TRUE(writeSvt(test::sampleVolume(), before));
        const NewEntry entries[] = {{"x-data/long", {bytesOfString(text)}, true},
                                    {"x-data/small", {bytesOfString(small)}, false}};
        const std::string input = readText(before);
        const auto written = writeWithEntries(
            bytesOfString(input), after, [](std::string_view) { return true; }, entries);
        EXPECT_TRUE(written && *written == std::filesystem::file_size(after));
    }
};

TEST(ZipEntries, NewEntriesFollowTheOthersWhichKeepTheirBytes) {
    const Written files;
    EXPECT_TRUE(test::isSame(*readSvt(files.after), test::sampleVolume()));
    const std::string before = readText(files.before), after = readText(files.after);
    const std::size_t directory = before.find("PK\1\2");
    EXPECT_EQ(before.substr(0, directory), after.substr(0, directory));
    const auto ranges = ZipRanges::open(files.after);
    ASSERT_TRUE(ranges) << ranges.error().message();
    EXPECT_EQ(ranges->entries().back().name, "x-data/small");
    EXPECT_EQ(stringOf(*ranges->unpacked(*ranges->find("x-data/long"), 10000)), files.text);
    EXPECT_EQ(stringOf(*ranges->unpacked(*ranges->find("x-data/small"), 10000)), files.small);
    EXPECT_TRUE(ranges->find("x-data/long")->isDeflated);
    EXPECT_EQ(ranges->unpacked(*ranges->find("x-data/long"), 100).error().code(), Code::InputTooBig);
    EXPECT_EQ(ranges->find("x-data"), nullptr);
}

TEST(ZipEntries, EntriesAreRemovedAndNamesAreUnique) {
    const Written files;
    const std::string after = readText(files.after);
    const auto isOld = [](std::string_view name) { return !name.starts_with("x-data/"); };
    ASSERT_TRUE(writeWithEntries(bytesOfString(after), files.after, isOld, {}));
    EXPECT_EQ(readText(files.after), readText(files.before));
    const NewEntry twice[] = {{"x", {}, false}, {"x", {}, false}};
    EXPECT_EQ(writeWithEntries(bytesOfString(after), files.after, isOld, twice).error().code(), Code::BadArgument);
}

TEST(ZipEntries, RangesOfAnEntryAreReadWithoutTheRest) {
    const Written files;
    const std::string bytes = readText(files.after);
    std::uint64_t count = 0;
    const auto read = [&](std::uint64_t offset, std::size_t size) -> Result<std::string> {
        count += size;
        return bytes.substr(offset, size);
    };
    const auto ranges = ZipRanges::open(read, bytes.size());
    ASSERT_TRUE(ranges);
    EXPECT_LT(count, 800u);
    count = 0;
    EXPECT_EQ(stringOf(*ranges->unpacked(*ranges->find("x-data/small"), 10)), "abc");
    EXPECT_LT(count, 100u);
}

TEST(ZipEntries, LargeFormsAreRead) {
    const TemporaryFolder folder;
    const std::string text = "some text";
    const ZipSource sources[] = {{"mimetype", {bytesOfString(text)}, false, false, {}},
                                 {"b", {bytesOfString(text)}, true, false, {}}};
    ASSERT_TRUE(writeZip(folder / "large.zip", sources, 0));
    const auto ranges = ZipRanges::open(folder / "large.zip");
    ASSERT_TRUE(ranges) << ranges.error().message();
    EXPECT_EQ(stringOf(*ranges->unpacked(*ranges->find("b"), 100)), text);
}

TEST(ZipEntries, EveryDamagedByteOfTheDirectoryIsAnErrorOrHarmless) {
    const Written files;
    const std::string bytes = readText(files.after);
    for (std::size_t b = bytes.find("x-data/long") - 30; b < bytes.size(); ++b) {
        std::string damaged = bytes;
        damaged[b] = static_cast<char>(damaged[b] ^ 0xFF);
        const auto read = [&](std::uint64_t offset, std::size_t size) -> Result<std::string> {
            EXPECT_LE(offset + size, damaged.size());
            return damaged.substr(offset, size);
        };
        const auto ranges = ZipRanges::open(read, damaged.size());
        if (!ranges) continue;
        for (const EntryPlace& entry : ranges->entries()) (void)ranges->unpacked(entry, 1u << 20);
    }
    for (std::size_t size = 0; size < 200; ++size) {
        const std::string cut = bytes.substr(bytes.size() - size);
        const auto read = [&](std::uint64_t offset, std::size_t count) -> Result<std::string> {
            return cut.substr(offset, count);
        };
        EXPECT_FALSE(ZipRanges::open(read, cut.size()));
    }
}

TEST(ZipEntries, FramesAreBounded) {
    const std::vector<std::uint8_t> bytes(10000, 7);
    const auto frame = packFrame(bytes, "test");
    EXPECT_EQ(*unpackFrame(*frame, 10000, "test"), bytes);
    EXPECT_EQ(unpackFrame(*frame, 9999, "test").error().code(), Code::BadVolume);
}

}  // namespace
}  // namespace svt::volume
