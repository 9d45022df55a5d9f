#include <svt/core/deflate.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/volume_readers/samples/label_image.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace svt::volume_readers {
namespace {

constexpr std::size_t kSize = 3'000'000;

std::string numbers() {
    std::string text(kSize, '\0');
    std::uint32_t state = 1;
    for (char& c : text) c = static_cast<char>((state = state * 1664525 + 1013904223) >> 24);
    return text;
}

struct Source {
    const char* name;
    std::string stored;
    std::function<ReadSamples(const SharedFile&)> open;
};

std::vector<Source> sources() {
    const std::string plain = numbers();
    const auto packed = gzipBytes(std::as_bytes(std::span(plain)));
    return {{"plain", plain, [](const SharedFile& file) { return plainSamples(file, file->from(0), Code::BadNrrd); }},
            {"gzip", std::string(reinterpret_cast<const char*>(packed.data()), packed.size()),
             [](const SharedFile& file) { return gzipSamples(file, file->from(0), Code::BadNrrd); }},
            {"blocks", plain, [](const SharedFile& file) {
                 const auto half = file->size() / 2;
                 std::vector<ZlibBlock> blocks{{{0, half}, half}, {file->from(half), file->size() - half}};
                 return zlibSamples(file, std::move(blocks), false, Code::BadImage);
             }}};
}

TEST(LabelFile, SamplesAreTheSameInMemoryAndFromTheDisk) {
    const test::TemporaryFolder folder;
    for (const Source& source : sources()) {
        test::writeText(folder / source.name, source.stored);
        for (const std::uint64_t inMemory : {LabelFile::kMaxInMemory, std::uint64_t{0}}) {
            const auto file = LabelFile::open(folder / source.name, inMemory);
            ASSERT_TRUE(file);
            const ReadSamples read = source.open(*file);
            std::string samples(kSize, '\0');
            for (std::size_t at = 0; at < kSize; at += 1000)
                ASSERT_TRUE(read(std::as_writable_bytes(std::span(samples).subspan(at, 1000)))) << source.name;
            EXPECT_TRUE(samples == numbers()) << source.name;
            EXPECT_TRUE(read({})) << source.name;
        }
    }
}

TEST(LabelFile, AFileThatIsShortenedIsAnError) {
    const test::TemporaryFolder folder;
    for (const Source& source : sources()) {
        test::writeText(folder / source.name, source.stored);
        const auto file = LabelFile::open(folder / source.name, 0);
        ASSERT_TRUE(file);
        const ReadSamples read = source.open(*file);
        std::filesystem::resize_file(folder / source.name, 5000);
        std::string samples(kSize, '\0');
        const auto done = read(std::as_writable_bytes(std::span(samples)));
        ASSERT_FALSE(done) << source.name;
        EXPECT_EQ(done.error().code(), Code::CannotOpen) << source.name;
    }
}

TEST(LabelFile, PartsEndWithTheFile) {
    const test::TemporaryFolder folder;
    test::writeText(folder / "a", "0123456789");
    for (const std::uint64_t inMemory : {LabelFile::kMaxInMemory, std::uint64_t{0}}) {
        const auto opened = LabelFile::open(folder / "a", inMemory);
        ASSERT_TRUE(opened);
        const LabelFile& file = **opened;
        EXPECT_EQ(file.size(), 10u);
        std::string buffer;
        EXPECT_EQ(*file.text({3, 4}, buffer), "3456");
        EXPECT_EQ(*file.text({8, 4}, buffer), "89");
        EXPECT_EQ(*file.text({10, 4}, buffer), "");
        EXPECT_EQ(*file.text({~0ull, ~0ull}, buffer), "");
        EXPECT_EQ(*file.text({1, ~0ull}, buffer), "123456789");
        EXPECT_EQ(file.head(3), "012");
        EXPECT_EQ(file.head(30), "0123456789");
        EXPECT_EQ(file.from(4).size, 6u);
        EXPECT_EQ(file.from(11).size, 0u);
    }
}

TEST(LabelFile, WhatAnotherProgramCutsOffIsAnErrorFromTheDiskAlone) {
    const test::TemporaryFolder folder;
    for (const std::uint64_t inMemory : {LabelFile::kMaxInMemory, std::uint64_t{0}}) {
        test::writeText(folder / "a", "0123456789");
        const auto file = LabelFile::open(folder / "a", inMemory);
        ASSERT_TRUE(file);
        std::filesystem::resize_file(folder / "a", 5);
        std::string buffer;
        EXPECT_EQ(*(*file)->text({1, 4}, buffer), "1234");
        const auto cut = (*file)->text({1, 5}, buffer);
        ASSERT_EQ(static_cast<bool>(cut), inMemory != 0);
        EXPECT_EQ(cut ? Code::CannotOpen : cut.error().code(), Code::CannotOpen);
        EXPECT_EQ((*file)->head(10), inMemory != 0 ? "0123456789" : "");
    }
}

// Pieces of every size, in which a text may lie or end anywhere.
TEST(FileWindow, FindsTextAsASearchInMemoryDoes) {
    const test::TemporaryFolder folder;
    const std::string text = "abacabadabacabaeabacabadabacaba";
    test::writeText(folder / "a", text);
    for (const std::uint64_t inMemory : {LabelFile::kMaxInMemory, std::uint64_t{0}})
        for (std::size_t piece = 1; piece <= text.size() + 1; ++piece) {
            const auto file = LabelFile::open(folder / "a", inMemory);
            ASSERT_TRUE(file);
            FileWindow window(*file, piece);
            for (const std::string_view wanted : {"a", "e", "ca", "abad", "dabacabae", "aba", "zz", "caba"})
                for (std::uint64_t from = 0; from <= text.size() + 1; ++from)
                    for (std::uint64_t end = 0; end <= text.size(); ++end) {
                        const std::size_t found = std::string_view(text).substr(0, end).find(wanted, from);
                        ASSERT_EQ(*window.find(wanted, from, end), found == std::string::npos ? end : found)
                            << wanted << " from " << from << " to " << end << " by " << piece;
                    }
        }
}

TEST(FileWindow, HasWhatIsAskedForWhereverItReadBefore) {
    const test::TemporaryFolder folder;
    const std::string text = numbers().substr(0, 400);
    test::writeText(folder / "a", text);
    const auto file = LabelFile::open(folder / "a", 0);
    ASSERT_TRUE(file);
    FileWindow window(*file, 16);
    std::uint32_t state = 7;
    for (int n = 0; n < 5000; ++n) {
        state = state * 1664525 + 1013904223;
        const std::size_t offset = (state >> 8) % 410, size = (state >> 20) % 40;
        const auto got = window.at(offset, size);
        ASSERT_TRUE(got);
        const std::string_view wanted = std::string_view(text).substr(std::min(offset, text.size()), size);
        ASSERT_EQ(got->substr(0, size), wanted) << offset << " " << size;
    }
}

TEST(FileNumbers, AreThoseOfEitherByteOrderAndZeroOutside) {
    const test::TemporaryFolder folder;
    test::writeText(folder / "a", std::string("\1\2\3\4\5\6\7\x88", 8));
    for (const std::uint64_t inMemory : {LabelFile::kMaxInMemory, std::uint64_t{0}}) {
        const auto file = LabelFile::open(folder / "a", inMemory);
        ASSERT_TRUE(file);
        FileNumbers little(*file, std::endian::little), big(*file, std::endian::big);
        EXPECT_EQ(little.number(4, 4), 0x88070605u);
        EXPECT_EQ(big.number(1, 2), 0x0203u);
        EXPECT_EQ(big.number(0, 8), 0x0102030405060788u);
        EXPECT_EQ(big.text(2, 3), "\3\4\5");
        EXPECT_EQ(big.text(2, 7), "") << "it is not all there";
        EXPECT_FALSE(little.isCut || big.isCut);
        EXPECT_EQ(little.number(5, 4), 0u);
        EXPECT_EQ(big.number(~0ull, 1), 0u);
        EXPECT_TRUE(little.isCut && big.isCut);
        EXPECT_EQ(little.fault(Error(Code::BadImage, "cut")).code(), Code::BadImage) << "nothing failed";
    }
}

TEST(FileNumbers, TellThatTheFileWasShortened) {
    const test::TemporaryFolder folder;
    test::writeText(folder / "a", std::string(10000, '1'));
    const auto file = LabelFile::open(folder / "a", 0);
    ASSERT_TRUE(file);
    FileNumbers numbers(*file, std::endian::little);
    EXPECT_EQ(numbers.number(0, 1), 0x31u);
    std::filesystem::resize_file(folder / "a", 100);
    EXPECT_EQ(numbers.number(9000, 1), 0u);
    EXPECT_TRUE(numbers.isCut);
    EXPECT_EQ(numbers.fault(Error(Code::BadImage, "cut")).code(), Code::CannotOpen);
}

TEST(LabelFile, AMissingFileIsAnError) {
    EXPECT_EQ(LabelFile::open("/nowhere/a.nrrd").error().code(), Code::CannotOpen);
}

}  // namespace
}  // namespace svt::volume_readers
