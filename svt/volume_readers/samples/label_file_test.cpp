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
    return {{"plain", plain, [](const SharedFile& file) { return plainSamples(file, file->bytes(), Code::BadNrrd); }},
            {"gzip", std::string(reinterpret_cast<const char*>(packed.data()), packed.size()),
             [](const SharedFile& file) { return gzipSamples(file, file->bytes(), Code::BadNrrd); }},
            {"blocks", plain, [](const SharedFile& file) {
                 const auto half = file->bytes().size() / 2;
                 std::vector<ZlibBlock> blocks{{file->bytes().first(half), half},
                                               {file->bytes().subspan(half), file->bytes().size() - half}};
                 return zlibSamples(file, std::move(blocks), false, Code::BadImage);
             }}};
}

TEST(LabelFile, SamplesAreTheSameInMemoryAndMapped) {
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

TEST(LabelFile, AMissingFileIsAnError) {
    EXPECT_EQ(LabelFile::open("/nowhere/a.nrrd").error().code(), Code::CannotOpen);
}

}  // namespace
}  // namespace svt::volume_readers
