// Label volumes of which parts are read, as of large files, and which another program shortens meanwhile: each is read as from
// memory, or an error, and no signal.
#include <svt/core/temporary_folder_test.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/volume_readers/read_label_volume.hpp>
#include <svt/volume_readers/samples/label_image.hpp>
#include <svt/writers/volume_formats.hpp>

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace svt::volume_readers {
namespace {

namespace fs = std::filesystem;
using svt::test::readText;
using svt::test::TemporaryFolder;
using svt::test::writeText;
using volume::SemanticVolume;

constexpr std::uint64_t kGrant = std::uint64_t{64} << 20;

/// The formats of files, each in its plain and its compressed form.
struct Written {
    const char* name;
    bool isCompressed;
};
constexpr Written kWritten[] = {{"v.nrrd", false},    {"v.nrrd", true},    {"v.vti", false}, {"v.vti", true},
                                {"v.nii", false},     {"v.nii.gz", true},  {"v.tif", false}, {"v.tif", true},
                                {"v.ome.tif", false}, {"v.ade.gml", false}};

SemanticVolume volumeWithNames(std::size_t nameBytes) {
    const Vec3i dimension{40, 33, 9};
    SemanticVolume volume = volume::test::sampleVolume(dimension);
    volume.grid = *volume::Grid::fromParts(dimension, {0.05, 0.1, 0.25}, {458877.5, 5438353.75, -0.125},
                                           {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
    for (volume::Label& label : volume.labels.labels) label.name.append(nameBytes, 'n');
    return volume;
}

const LabelFormat* formatOf(const SharedFile& file, const fs::path& path) {
    for (const LabelFormat& format : labelFormats())
        if (!format.isFolder && format.looksLike(file, path)) return &format;
    return nullptr;
}

/// What the header tells, and the samples.
struct Content {
    Vec3i dimension;
    std::string header, labels, seal;
    volume::ColumnVolume columns;

    friend bool operator==(const Content& a, const Content& b) {
        return a.dimension == b.dimension && a.header == b.header && a.labels == b.labels && a.seal == b.seal &&
               a.columns == b.columns;
    }
};

Result<Content> contentOf(const LabelFormat& format, const SharedFile& file, const fs::path& path) {
    SVT_TRY(image, format.open(file, path, kGrant));
    SVT_TRY(columns, readColumns(*image, kGrant, format.fault, nullptr));
    return Content{image->dimension, image->headerJson, image->labelsJson, image->seal, std::move(*columns)};
}

fs::path writtenTo(const TemporaryFolder& folder, const Written& written, std::size_t nameBytes = 0) {
    writers::VolumeWriteOptions options;
    options.isCompressed = written.isCompressed;
    const fs::path path = folder / written.name;
    const auto bytes = writers::writeVolume(volumeWithNames(nameBytes), path, options);
    EXPECT_TRUE(bytes) << written.name << ": " << (bytes ? "" : bytes.error().toString());
    return path;
}

// Names of 300 kB make headers that no first piece of a file holds.
TEST(Shortened, LabelVolumesAreReadFromTheDiskAsFromMemory) {
    const TemporaryFolder folder;
    for (const Written& written : kWritten)
        for (const std::size_t nameBytes : {0u, 300'000u}) {
            SCOPED_TRACE(testing::Message() << written.name << " " << written.isCompressed << " " << nameBytes);
            const fs::path path = writtenTo(folder, written, nameBytes);
            const auto inMemory = LabelFile::open(path, ~0ull), onDisk = LabelFile::open(path, 0);
            ASSERT_TRUE(inMemory && onDisk);
            const LabelFormat* format = formatOf(*inMemory, path);
            ASSERT_NE(format, nullptr);
            EXPECT_EQ(formatOf(*onDisk, path), format);
            const auto expected = contentOf(*format, *inMemory, path), read = contentOf(*format, *onDisk, path);
            ASSERT_TRUE(expected) << expected.error().toString();
            ASSERT_TRUE(read) << read.error().toString();
            EXPECT_TRUE(*read == *expected);
            EXPECT_GT(expected->labels.size(), nameBytes);
        }
}

// The file is opened whole, and shortened before its header is read.
TEST(Shortened, LabelVolumesAreErrorsWhereverTheyAreCut) {
    const TemporaryFolder folder;
    for (const Written& written : kWritten) {
        SCOPED_TRACE(testing::Message() << written.name << " " << written.isCompressed);
        const fs::path path = writtenTo(folder, written);
        const std::string whole = readText(path);
        const auto kept = LabelFile::open(path, ~0ull);
        ASSERT_TRUE(kept);
        const LabelFormat* format = formatOf(*kept, path);
        ASSERT_NE(format, nullptr);
        const auto expected = contentOf(*format, *kept, path);
        ASSERT_TRUE(expected);
        constexpr std::size_t kSteps = 40;
        int errors = 0;
        for (std::size_t step = 0; step < kSteps; ++step) {
            writeText(path, whole);
            const auto file = LabelFile::open(path, 0);
            ASSERT_TRUE(file);
            const std::size_t cut = step < 8 ? step * 3 : whole.size() * step / kSteps;
            fs::resize_file(path, cut);
            static_cast<void>(formatOf(*file, path));
            const auto read = contentOf(*format, *file, path);
            // What stands behind the last part that is needed may be missing.
            EXPECT_TRUE(!read || *read == *expected) << "cut at " << cut;
            errors += read ? 0 : 1;
        }
        EXPECT_GE(errors, int(kSteps) - 2);
    }
}

TEST(Shortened, LabelVolumesThatChangeWhileTheyAreReadRaiseNoSignal) {
    const TemporaryFolder folder;
    for (const Written& written : {Written{"v.nrrd", false}, Written{"v.tif", false}, Written{"v.nii", false}}) {
        const fs::path path = writtenTo(folder, written, 100'000);
        const auto size = fs::file_size(path);
        const auto kept = LabelFile::open(path, ~0ull);
        ASSERT_TRUE(kept);
        const LabelFormat* format = formatOf(*kept, path);
        ASSERT_NE(format, nullptr);
        std::atomic<bool> isDone{false};
        std::thread writer([&] {
            while (!isDone)
                for (const std::uintmax_t now : {std::uintmax_t{100}, size / 2, size}) fs::resize_file(path, now);
        });
        int errors = 0;
        for (int i = 0; i < 40; ++i) {
            const auto file = LabelFile::open(path, 0);
            if (!file || !contentOf(*format, *file, path)) ++errors;
        }
        isDone = true;
        writer.join();
        EXPECT_GT(errors, 0) << written.name;
    }
}

}  // namespace
}  // namespace svt::volume_readers
