#include <svt/core/temporary_folder_test.hpp>
#include <svt/volume/dense.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/writers/nrrd/nrrd_file_test.hpp>
#include <svt/writers/nrrd_writer.hpp>

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

namespace svt::writers {
namespace {

using svt::test::readText;
using svt::test::TemporaryFolder;
using svt::test::writeText;
using volume::SemanticVolume;
using volume::test::sampleVolume;

template <class T>
void expectSameSamples(const NrrdImage& image, const SemanticVolume& volume) {
    const auto dense = volume::toDense<T>(volume.columns);
    ASSERT_TRUE(dense);
    ASSERT_EQ(image.data.size(), dense->size() * sizeof(T));
    EXPECT_EQ(std::memcmp(image.data.data(), dense->data(), image.data.size()), 0);
}

/// The sample volume with a range so large that scalars need more bits.
SemanticVolume withScalars(volume::Scalar count) {
    SemanticVolume volume = sampleVolume({70, 66, 9});
    volume.labels.phaseColors.clear();
    volume.labels.labels[4].first = 6;
    volume.labels.labels[4].count = count;
    return volume;
}

TEST(NrrdWriter, SamplesComeBack) {
    const TemporaryFolder folder;
    for (const NrrdEncoding encoding : {NrrdEncoding::Raw, NrrdEncoding::Gzip}) {
        const NrrdOptions options{encoding};
        for (const Vec3i dimension : {Vec3i{8, 8, 8}, Vec3i{70, 66, 9}, Vec3i{300, 260, 120}}) {
            const SemanticVolume volume = sampleVolume(dimension);
            const auto size = writeNrrd(volume, folder / "v.nrrd", options);
            ASSERT_TRUE(size) << size.error().toString();
            EXPECT_EQ(*size, std::filesystem::file_size(folder / "v.nrrd"));
            const auto image = readNrrd(folder / "v.nrrd");
            ASSERT_TRUE(image) << image.error().toString();
            EXPECT_EQ(image->dimension, dimension);
            EXPECT_EQ(image->bits, 8);
            expectSameSamples<std::uint8_t>(*image, volume);
        }
    }
}

TEST(NrrdWriter, TypeIsTheSmallestThatHoldsAllScalars) {
    const TemporaryFolder folder;
    const SemanticVolume medium = withScalars(250);  // largest scalar 255
    const SemanticVolume large = withScalars(251);
    const SemanticVolume huge = withScalars(70'000);
    ASSERT_TRUE(writeNrrd(medium, folder / "8.nrrd") && writeNrrd(large, folder / "16.nrrd") &&
                writeNrrd(huge, folder / "32.nrrd"));
    const auto image8 = readNrrd(folder / "8.nrrd");
    const auto image16 = readNrrd(folder / "16.nrrd");
    const auto image32 = readNrrd(folder / "32.nrrd");
    ASSERT_TRUE(image8 && image16 && image32);
    EXPECT_EQ(image8->bits, 8);
    EXPECT_EQ(image16->bits, 16);
    EXPECT_EQ(image32->bits, 32);
    expectSameSamples<std::uint8_t>(*image8, medium);
    expectSameSamples<std::uint16_t>(*image16, large);
    expectSameSamples<std::uint32_t>(*image32, huge);
    const std::size_t index = 35 + 70 * (2 + 66 * 3);
    EXPECT_EQ(image32->sample(index), huge.columns.scalarAt(35, 2, 3));
    EXPECT_EQ(image16->sample(index), image32->sample(index));
}

TEST(NrrdWriter, PlaceIsThatOfTheTurnedGridInMetres) {
    const TemporaryFolder folder;
    const SemanticVolume volume = sampleVolume();
    ASSERT_TRUE(writeNrrd(volume, folder / "v.nrrd"));
    const auto image = readNrrd(folder / "v.nrrd");
    ASSERT_TRUE(image);
    EXPECT_EQ(image->origin, volume.grid.origin());
    EXPECT_EQ(image->directions[0], (Vec3d{0.6 * 0.05, 0.8 * 0.05, 0}));
    EXPECT_EQ(image->directions[1], (Vec3d{-0.8 * 0.1, 0.6 * 0.1, 0}));
    EXPECT_EQ(image->directions[2], (Vec3d{0, 0, 1.0 / 3.0}));
    const Vec3d world = image->origin + image->directions[0] * 7 + image->directions[1] * 5 + image->directions[2] * 3;
    EXPECT_LT(length(world - volume.grid.worldFromIndex({7, 5, 3})), 1e-9);
}

TEST(NrrdWriter, HeaderSaysWhatTheFormatWants) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writeNrrd(withScalars(300), folder / "v.nrrd", {NrrdEncoding::Raw}));
    const std::string text = readText(folder / "v.nrrd");
    const std::string header = text.substr(0, text.find("\n\n") + 2);
    EXPECT_EQ(header.find("NRRD0004\n"), 0u);
    for (const char* line : {"\ntype: uint16\n", "\ndimension: 3\n", "\nspace dimension: 3\n", "\nsizes: 70 66 9\n",
                             "\nkinds: domain domain domain\n", "\nendian: little\n", "\nencoding: raw\n",
                             "\nspace units: \"m\" \"m\" \"m\"\n", "\nspace origin: (458877.03,5438353.7,-0.1)\n"})
        EXPECT_NE(header.find(line), std::string::npos) << line;
    EXPECT_EQ(header.find("\nspace:"), std::string::npos) << "no anatomical space";
    for (const char c : header) ASSERT_TRUE(c == '\n' || (c >= 0x20 && c <= 0x7E)) << "the header is plain ASCII";
    EXPECT_EQ(text.size() - header.size(), 70u * 66u * 9u * 2u);
}

TEST(NrrdWriter, LabelsGoAlongAsKeyValues) {
    const TemporaryFolder folder;
    const SemanticVolume volume = sampleVolume();
    ASSERT_TRUE(writeNrrd(volume, folder / "v.nrrd"));
    const auto image = readNrrd(folder / "v.nrrd");
    ASSERT_TRUE(image);
    ASSERT_NE(image->find("svt_label_count"), nullptr);
    EXPECT_EQ(*image->find("svt_label_count"), "5");
    EXPECT_EQ(*image->find("svt_source"), "\"haus.gml\"");
    EXPECT_EQ(*image->find("svt_model"), R"("Haus \"\u00c4ngstr\u00f6m\" \\ 1\n2. Zeile\u0009\u0001")");
    const std::string* room = image->find("svt_label_1");
    ASSERT_NE(room, nullptr);
    EXPECT_EQ(room->find(R"({"id":"room-1","class":"BuildingRoom","name":"K\u00fcche","parent":0,)"), 0u) << *room;
    EXPECT_NE(room->find(R"("first":1,"count":1)"), std::string::npos);
    EXPECT_EQ(image->find("svt_label_5"), nullptr);
}

TEST(NrrdWriter, BytesDependOnTheVolumeAlone) {
    const TemporaryFolder folder;
    const SemanticVolume volume = sampleVolume({300, 300, 60});
    ASSERT_TRUE(writeNrrd(volume, folder / "1.nrrd", {NrrdEncoding::Gzip, 1}));
    ASSERT_TRUE(writeNrrd(volume, folder / "3.nrrd", {NrrdEncoding::Gzip, 3}));
    EXPECT_TRUE(readText(folder / "1.nrrd") == readText(folder / "3.nrrd"));
}

TEST(NrrdWriter, ExternalToolsReadIt) {
    if (std::system("python3 -c 'import gzip, json' >/dev/null 2>&1") != 0) GTEST_SKIP() << "python3 is not installed";
    const TemporaryFolder folder;
    const SemanticVolume volume = sampleVolume({130, 70, 200});
    ASSERT_TRUE(writeNrrd(volume, folder / "v.nrrd"));
    writeText(folder / "check.py",
              "import gzip, json, re, sys\n"
              "raw = open(sys.argv[1], 'rb').read()\n"
              "head, data = raw.split(b'\\n\\n', 1)\n"
              "open(sys.argv[1] + '.gz', 'wb').write(data)\n"
              "data = gzip.decompress(data)\n"
              "lines = head.decode('ascii').split('\\n')\n"
              "keys = dict(l.split(':=', 1) for l in lines if ':=' in l)\n"
              "fields = dict(l.split(': ', 1) for l in lines[2:] if ':=' not in l)\n"
              "sizes = [int(s) for s in fields['sizes'].split()]\n"
              "assert sizes == [130, 70, 200] and len(data) == 130 * 70 * 200\n"
              "unescape = lambda t: re.sub(r'\\\\(.)', lambda m: '\\n' if m[1] == 'n' else m[1], t)\n"
              "labels = [json.loads(unescape(keys['svt_label_%d' % i])) for i in range(int(keys['svt_label_count']))]\n"
              "assert labels[1]['name'] == 'K\\u00fcche'\n"
              "assert labels[0]['attributes'][0]['value'].startswith('Gr\\u00fc\\u00dfe \\U0001f3e0')\n"
              "for label in labels:\n"
              "    owned = range(label['first'], label['first'] + label['count'])\n"
              "    assert label['voxels'] == sum(data.count(s) for s in owned)\n");
    const std::string file = "'" + (folder / "v.nrrd").string();
    EXPECT_EQ(std::system(("python3 '" + (folder / "check.py").string() + "' " + file + "'").c_str()), 0);
    if (std::system("gzip --version >/dev/null 2>&1") == 0) {
        EXPECT_EQ(std::system(("gzip -t " + file + ".gz'").c_str()), 0);
    }
}

TEST(NrrdWriter, CancelLeavesNoFile) {
    const TemporaryFolder folder;
    Progress progress;
    progress.cancel = true;
    const auto written = writeNrrd(sampleVolume(), folder / "v.nrrd", {NrrdEncoding::Gzip, 0, &progress});
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code(), Code::Cancelled);
    EXPECT_EQ(folder.count(), 0);
}

TEST(NrrdWriter, ProgressEndsAtOne) {
    const TemporaryFolder folder;
    Progress progress;
    double last = 0;
    progress.report = [&](std::string_view stage, double fraction) {
        EXPECT_EQ(stage, "nrrd");
        EXPECT_GE(fraction, last);
        last = fraction;
    };
    ASSERT_TRUE(writeNrrd(sampleVolume({200, 200, 1000}), folder / "v.nrrd", {NrrdEncoding::Gzip, 0, &progress}));
    EXPECT_EQ(last, 1.0);
}

TEST(NrrdWriter, WhatCannotBeWrittenIsTold) {
    const TemporaryFolder folder;
    SemanticVolume volume = sampleVolume({8, 8, 8});
    EXPECT_EQ(writeNrrd(volume, folder / "absent" / "v.nrrd").error().code(), Code::CannotWrite);
    if (std::filesystem::exists("/dev/full")) {
        EXPECT_EQ(writeNrrd(volume, "/dev/full").error().code(), Code::DiskFull);
    }
    SemanticVolume other = volume;
    other.columns = sampleVolume({9, 8, 8}).columns;
    EXPECT_EQ(writeNrrd(other, folder / "v.nrrd").error().code(), Code::BadArgument);
    other = volume;
    other.labels.labels.clear();
    EXPECT_EQ(writeNrrd(other, folder / "v.nrrd").error().code(), Code::BadArgument);
    EXPECT_EQ(folder.count(), 0);
}

TEST(NrrdWriter, SliceLargerThanASlabIsWrittenInBands) {
    const TemporaryFolder folder;
    SemanticVolume volume;
    volume.grid = *volume::Grid::fromParts({30'000, 700, 2}, {1, 1, 1}, {}, {Vec3d{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    volume.labels.labels = {{.id = "a", .className = "", .name = "", .attributes = {}, .subtreeEnd = 1, .groups = {}}};
    volume.labels.labels[0].first = 1;
    volume.labels.labels[0].count = 200;
    std::vector<volume::ColumnTileData> tiles;
    for (int tile = 0; tile < 469 * 11; ++tile) {
        const auto width = static_cast<std::size_t>(tile % 469 == 468 ? 30'000 - 468 * 64 : 64);
        const std::size_t height = tile / 469 == 10 ? 700 - 10 * 64 : 64;
        const auto scalar = static_cast<volume::Scalar>(1 + tile % 200);
        tiles.push_back({std::vector<std::uint8_t>(height, 0),
                         std::vector<std::uint16_t>(width, 0),
                         {0, 2},
                         {{1, scalar}, {2, 0}}});
    }
    volume.columns = volume::ColumnVolume::fromTiles({30'000, 700, 2}, std::move(tiles));
    ASSERT_TRUE(writeNrrd(volume, folder / "v.nrrd", {NrrdEncoding::Raw}));
    const auto image = readNrrd(folder / "v.nrrd");
    ASSERT_TRUE(image) << image.error().toString();
    expectSameSamples<std::uint8_t>(*image, volume);
}

}  // namespace
}  // namespace svt::writers
