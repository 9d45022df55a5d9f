#include <svt/core/temporary_folder_test.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/volume_readers/read_label_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace svt::volume_readers {
namespace {

using svt::test::readText;
using svt::test::TemporaryFolder;
using svt::test::writeText;
using volume::SemanticVolume;
using volume::test::sampleVolume;

/// The sample volume with scalars of `bits`, on a grid along the world's axes where `isPlain`.
SemanticVolume volumeOf(int bits, bool isPlain, Vec3i dimension = {70, 66, 9}) {
    SemanticVolume volume = sampleVolume(dimension);
    if (bits > 8) {
        volume.labels.labels[3].count = bits == 16 ? 300 : 70'000;
        volume.labels.phaseColors.clear();
        auto scalars = volume::test::sampleScalars(dimension);
        for (std::size_t s = 0; s < scalars.size(); ++s)
            if (scalars[s] == 5) scalars[s] += static_cast<volume::Scalar>(s / 7 % (bits == 16 ? 300 : 70'000));
        volume.columns = volume::ColumnVolume::fromDense(dimension, scalars);
    }
    if (isPlain)
        volume.grid = *volume::Grid::fromParts(dimension, {0.05, 0.1, 1.0 / 3.0}, {458877.03, 5438353.7, -0.1},
                                               {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
    return volume;
}

void expectSame(const SemanticVolume& read, const SemanticVolume& written) {
    EXPECT_TRUE(read.columns == written.columns);
    EXPECT_TRUE(read.grid == written.grid);
    EXPECT_TRUE(read.labels == written.labels);
    EXPECT_EQ(read.crsName, written.crsName);
    EXPECT_EQ(read.modelName, written.modelName);
    EXPECT_EQ(read.source, written.source);
}

TEST(RoundTrip, EveryFormatGivesTheSameVolumeBack) {
    const TemporaryFolder folder;
    for (const int bits : {8, 16, 32})
        for (const bool isPlain : {false, true})
            for (const bool isCompressed : {false, true})
                for (const char* name : {"v.nrrd", "v.vti", "v.nii", "v.nii.gz", "v.tif", "v.ome.tif"}) {
                    SCOPED_TRACE(testing::Message() << name << ", " << bits << " bits, plain " << isPlain);
                    const SemanticVolume volume = volumeOf(bits, isPlain);
                    writers::VolumeWriteOptions options;
                    options.isCompressed = isCompressed;
                    ASSERT_TRUE(writers::writeVolume(volume, folder / name, options));
                    EXPECT_TRUE(looksLikeLabelVolume(folder / name));
                    const auto read = readLabelVolume(folder / name);
                    ASSERT_TRUE(read) << read.error().toString();
                    expectSame(*read, volume);
                }
}

TEST(RoundTrip, ZarrGivesTheSameVolumeBackInBothVersions) {
    const TemporaryFolder folder;
    for (const int bits : {8, 16, 32})
        for (const bool isPlain : {false, true})
            for (const int version : {2, 3}) {
                SCOPED_TRACE(testing::Message() << version << ", " << bits << " bits, plain " << isPlain);
                const SemanticVolume volume = volumeOf(bits, isPlain, {150, 70, 133});
                writers::VolumeWriteOptions options;
                options.zarr.version = version;
                const std::string name =
                    std::to_string(version) + std::to_string(bits) + (isPlain ? "p" : "t") + ".zarr";
                ASSERT_TRUE(writers::writeVolume(volume, folder / name, options));
                EXPECT_TRUE(looksLikeLabelVolume(folder / name));
                const auto read = readLabelVolume(folder / name);
                ASSERT_TRUE(read) << read.error().toString();
                expectSame(*read, volume);
            }
}

TEST(RoundTrip, CityGmlGivesTheSameVolumeBackFromAllThreeTextures) {
    const TemporaryFolder folder;
    for (const int bits : {8, 16})
        for (const int version : {2, 3})
            for (const auto texture :
                 {writers::TextureKind::Pixel, writers::TextureKind::Image, writers::TextureKind::Composed}) {
                SCOPED_TRACE(testing::Message() << int(texture) << ", " << bits << " bits, CityGML " << version);
                const SemanticVolume volume = volumeOf(bits, true);
                writers::VolumeWriteOptions options;
                options.texture = texture;
                options.cityGml.version = version;
                const auto bytes = writers::writeVolume(volume, folder / "v w.ade.gml", options);
                ASSERT_TRUE(bytes) << bytes.error().toString();
                EXPECT_TRUE(looksLikeLabelVolume(folder / "v w.ade.gml"));
                const auto read = readLabelVolume(folder / "v w.ade.gml");
                ASSERT_TRUE(read) << read.error().toString();
                expectSame(*read, volume);
            }
    const auto turned = writers::writeVolume(volumeOf(8, false), folder / "t.ade.gml");
    ASSERT_FALSE(turned) << "the extension has no axes";
    EXPECT_EQ(turned.error().code(), Code::BadArgument);
    writers::VolumeWriteOptions few;
    few.maxVoxels = 1000;
    const auto large = writers::writeVolume(volumeOf(8, true), folder / "t.ade.gml", few);
    ASSERT_FALSE(large);
    EXPECT_NE(large.error().message().find("--texture image"), std::string::npos) << large.error().message();
}

TEST(RoundTrip, SegmentsOfSlicerAreLabelsWithNameAndPlace) {
    const TemporaryFolder folder;
    const SemanticVolume volume = volumeOf(8, true);
    ASSERT_TRUE(writers::writeVolume(volume, folder / "v.seg.nrrd"));
    // As Slicer saves it: without what it does not need.
    std::string text = readText(folder / "v.seg.nrrd");
    for (std::size_t at = 0; (at = text.find("\nsvt_")) != std::string::npos;)
        text.erase(at, text.find('\n', at + 1) - at);
    writeText(folder / "s.nrrd", text);
    const auto read = readLabelVolume(folder / "s.nrrd");
    ASSERT_TRUE(read) << read.error().toString();
    ASSERT_EQ(read->labels.labels.size(), 3u);
    EXPECT_EQ(read->labels.labels[0].id, "room-1");
    EXPECT_EQ(read->labels.labels[0].name, "Küche");
    EXPECT_EQ(read->labels.labels[0].className, "BuildingRoom");
    EXPECT_EQ(read->labels.labels[1].id, "wall");
    EXPECT_EQ(read->labels.labels[1].parent, 0u);
    EXPECT_EQ(read->labels.labels[1].color, volume.labels.labels[2].color);
    EXPECT_LT(length(read->grid.worldFromIndex({60, 50, 8}) - volume.grid.worldFromIndex({60, 50, 8})), 1e-6)
        << "millimetres become metres";
    EXPECT_EQ(read->labels.labels[1].voxels, volume.labels.labels[2].voxels);
}

TEST(RoundTrip, AnotherGridThanTheHeadersIsTheFilesOwn) {
    const TemporaryFolder folder;
    const SemanticVolume volume = volumeOf(8, true);
    ASSERT_TRUE(writers::writeVolume(volume, folder / "v.vti"));
    std::string text = readText(folder / "v.vti");
    const std::size_t at = text.find(" Spacing=\"0.05 ");
    ASSERT_NE(at, std::string::npos);
    text.replace(at, 15, " Spacing=\"0.07 ");
    writeText(folder / "v.vti", text);
    const auto read = readLabelVolume(folder / "v.vti");
    ASSERT_TRUE(read) << read.error().toString();
    EXPECT_DOUBLE_EQ(read->grid.spacing().x, 0.07);
}

// ---------------------------------------------------------------------------------------------- volumes of others

constexpr const char* kHead =
    "NRRD0004\ntype: short\ndimension: 3\nsizes: 3 2 2\nspacings: 0.5 1 2\nendian: big\nencoding: raw\n\n";

/// 3 x 2 x 2 samples: 7 below, 300 above, one of 9.
std::string bigEndianShorts() {
    std::string text = kHead;
    for (const int value : {7, 7, 0, 7, 7, 0, 300, 300, 9, 0, 0, 0}) {
        text += static_cast<char>(value >> 8);
        text += static_cast<char>(value & 255);
    }
    return text;
}

TEST(OtherVolumes, EachValueIsALabelWhereNoTableTells) {
    const TemporaryFolder folder;
    writeText(folder / "v.nrrd", bigEndianShorts());
    const auto read = readLabelVolume(folder / "v.nrrd");
    ASSERT_TRUE(read) << read.error().toString();
    ASSERT_EQ(read->labels.labels.size(), 3u);
    EXPECT_EQ(read->labels.labels[2].id, "label-300");
    EXPECT_EQ(read->labels.labels[0].voxels, 4u);
    EXPECT_EQ(read->columns.scalarAt(0, 0, 0), 1u);
    EXPECT_EQ(read->columns.scalarAt(2, 0, 1), 2u);
    EXPECT_EQ(read->columns.scalarAt(1, 0, 1), 3u);
    EXPECT_EQ(read->grid.spacing(), (Vec3d{0.5, 1, 2}));
    EXPECT_DOUBLE_EQ(read->labels.labels[0].volume, 4.0);
    EXPECT_TRUE(volume::checkLabels(read->labels));
}

/// The same image with samples of another type.
template <class T>
std::string samplesAs(const char* type, bool isBig, double changed = 0) {
    std::string text = kHead;
    text.replace(text.find("short"), 5, type);
    if (!isBig) text.replace(text.find("big"), 3, "little");
    for (const double value : {7.0, 7.0, 0.0, 7.0, 7.0, 0.0, 300.0, 300.0, 9.0, 0.0, 0.0, changed}) {
        const auto number = static_cast<T>(value);
        std::string bytes(sizeof number, '\0');
        std::memcpy(bytes.data(), &number, sizeof number);
        if (isBig) std::reverse(bytes.begin(), bytes.end());
        text += bytes;
    }
    return text;
}

TEST(OtherVolumes, WholeNumbersAreLabelsInAnyType) {
    const TemporaryFolder folder;
    writeText(folder / "v.nrrd", bigEndianShorts());
    const auto expected = readLabelVolume(folder / "v.nrrd");
    ASSERT_TRUE(expected);
    for (const std::string& text :
         {samplesAs<float>("float", false), samplesAs<float>("float", true), samplesAs<double>("double", false),
          samplesAs<double>("double", true), samplesAs<std::int64_t>("int64", false),
          samplesAs<std::int64_t>("long long int", true), samplesAs<std::uint64_t>("uint64_t", false)}) {
        writeText(folder / "w.nrrd", text);
        const auto read = readLabelVolume(folder / "w.nrrd");
        ASSERT_TRUE(read) << read.error().toString();
        ASSERT_EQ(read->labels.labels.size(), 3u);
        for (int n = 0; n < 12; ++n)
            EXPECT_EQ(read->columns.scalarAt(n % 3, n / 3 % 2, n / 6),
                      expected->columns.scalarAt(n % 3, n / 3 % 2, n / 6));
        writeText(folder / "w.nrrd", text.substr(0, text.size() - 1));
        EXPECT_FALSE(readLabelVolume(folder / "w.nrrd"));
    }
    for (const std::string& text :
         {samplesAs<float>("float", false, 0.5), samplesAs<float>("float", true, -1),
          samplesAs<float>("float", false, std::numeric_limits<double>::quiet_NaN()),
          samplesAs<double>("double", true, 1e10),
          samplesAs<double>("double", false, std::numeric_limits<double>::infinity()),
          samplesAs<std::int64_t>("int64", false, -1), samplesAs<std::uint64_t>("uint64", true, 4294967296.0)}) {
        writeText(folder / "w.nrrd", text);
        const auto read = readLabelVolume(folder / "w.nrrd");
        ASSERT_FALSE(read);
        EXPECT_EQ(read.error().code(), Code::BadNrrd);
        EXPECT_NE(read.error().message().find("slice 1 has the value"), std::string::npos) << read.error().message();
    }
}

TEST(OtherVolumes, NiftiAndVtiOfFloatsAreLabels) {
    const TemporaryFolder folder;
    const SemanticVolume volume = volumeOf(32, true, {12, 9, 8});
    writers::VolumeWriteOptions options;
    options.isCompressed = false;
    ASSERT_TRUE(writers::writeVolume(volume, folder / "v.nii", options));
    ASSERT_TRUE(writers::writeVolume(volume, folder / "v.vti", options));
    const std::size_t size = 4 * std::size_t{12 * 9 * 8};
    const auto withFloats = [&](std::string text, std::size_t begin) {
        for (std::size_t at = begin; at < begin + size; at += 4) {
            std::uint32_t value = 0;
            std::memcpy(&value, text.data() + at, 4);
            const auto number = static_cast<float>(value);
            std::memcpy(text.data() + at, &number, 4);
        }
        return text;
    };
    std::string nifti = readText(folder / "v.nii");
    const std::size_t type = nifti.substr(4, 2) == "n+" ? 12 : 70;  // of version 2, or 1
    nifti[type] = 16;
    nifti[type + 1] = 0;
    writeText(folder / "f.nii", withFloats(nifti, nifti.size() - size));
    std::string vti = readText(folder / "v.vti");
    const std::size_t name = vti.find("UInt32\" Name=\"label\"");
    ASSERT_NE(name, std::string::npos);
    vti.replace(name, 6, "Float32");
    writeText(folder / "f.vti", withFloats(vti, vti.find("encoding=\"raw\">") + 15 + 2 + 8));
    for (const char* file : {"f.nii", "f.vti"}) {
        const auto read = readLabelVolume(folder / file);
        ASSERT_TRUE(read) << read.error().toString();
        EXPECT_TRUE(read->columns == volume.columns) << file;
    }
}

TEST(OtherVolumes, ATableNamesValuesAndPutsThemIntoATree) {
    const TemporaryFolder folder;
    writeText(folder / "v.nrrd", bigEndianShorts());
    writeText(
        folder / "t.json",
        R"({"labels":[{"value":[290,310],"id":"bone","parent":"body","name":"Knochen","color":"#ff8000","opacity":0.5},
                  {"id":"body","class":"Building","attributes":{"age":41,"side":"left"}},{"value":7,"parent":"body"}]})");
    const auto read = readLabelVolume(folder / "v.nrrd", {folder / "t.json"});
    ASSERT_TRUE(read) << read.error().toString();
    const auto& labels = read->labels.labels;
    ASSERT_EQ(labels.size(), 4u);
    EXPECT_EQ(labels[0].id, "body");
    EXPECT_EQ(labels[0].count, 0u);
    EXPECT_EQ(labels[0].subtreeEnd, 3u);
    EXPECT_EQ(labels[0].attributes.size(), 2u);
    EXPECT_EQ(labels[1].id, "bone");
    EXPECT_EQ(labels[1].parent, 0u);
    EXPECT_EQ(labels[1].opacity, 0.5f);
    EXPECT_EQ(labels[1].color, (Vec3f{1, 128.0f / 255, 0}));
    EXPECT_EQ(labels[2].id, "label-7");
    EXPECT_EQ(labels[3].id, "label-9") << "not in the table";
    EXPECT_EQ(read->columns.scalarAt(0, 0, 1), labels[1].first);
    EXPECT_TRUE(volume::checkLabels(read->labels));
}

TEST(OtherVolumes, WrongTablesAreRefused) {
    const TemporaryFolder folder;
    writeText(folder / "v.nrrd", bigEndianShorts());
    for (const auto& [text, code] : std::initializer_list<std::pair<const char*, Code>>{
             {"{", Code::BadJson},
             {"[]", Code::BadJson},
             {R"({"labels":[{"value":0}]})", Code::BadJson},
             {R"({"labels":[{"value":[5,4]}]})", Code::BadJson},
             {R"({"labels":[{"name":"x"}]})", Code::BadJson},
             {R"({"labels":[{"value":7,"color":"red"}]})", Code::BadJson},
             {R"({"labels":[{"value":7,"opacity":2}]})", Code::BadJson},
             {R"({"labels":[{"id":"a"},{"id":"a"}]})", Code::BadVolume},
             {R"({"labels":[{"id":"a","parent":"b"},{"id":"b","parent":"a"}]})", Code::BadVolume},
         }) {
        writeText(folder / "t.json", text);
        const auto read = readLabelVolume(folder / "v.nrrd", {folder / "t.json"});
        ASSERT_FALSE(read) << text;
        EXPECT_EQ(read.error().code(), code) << text << ": " << read.error().toString();
    }
    EXPECT_EQ(readLabelVolume(folder / "v.nrrd", {folder / "none.json"}).error().code(), Code::CannotOpen);
}

TEST(OtherVolumes, GridsThatAreNoneAreRefused) {
    const TemporaryFolder folder;
    for (const auto& [field, code] : std::initializer_list<std::pair<const char*, Code>>{
             {"space directions: (1,0,0) (0,1,0) (0,0,-1)", Code::BadImage},
             {"space directions: (1,0,0) (0.5,1,0) (0,0,1)", Code::BadImage},
             {"spacings: 0 1 1", Code::BadDimension},
             {"spacings: nan 1 1", Code::BadDimension},
         }) {
        std::string text = bigEndianShorts();
        text.replace(text.find("spacings: 0.5 1 2"), 17, field);
        writeText(folder / "v.nrrd", text);
        const auto read = readLabelVolume(folder / "v.nrrd");
        ASSERT_FALSE(read) << field;
        EXPECT_EQ(read.error().code(), code) << field << read.error().toString();
    }
}

/// Every file of every format cut at many places, and with single bytes changed: a result or an error, in bounded time.
TEST(OtherVolumes, DamageIsAnErrorOrAVolumeAndNeverACrash) {
    const TemporaryFolder folder;
    const SemanticVolume volume = volumeOf(8, true, {12, 9, 8});
    for (const char* name : {"v.nrrd", "v.seg.nrrd", "v.vti", "v.nii", "v.nii.gz", "v.tif", "v.ade.gml"}) {
        ASSERT_TRUE(writers::writeVolume(volume, folder / name));
        const std::string whole = readText(folder / name);
        for (std::size_t step = 0; step < 24; ++step) {
            const std::size_t at = whole.size() * step / 24;
            writeText(folder / "d", std::string_view(whole).substr(0, at));
            const auto cut = readLabelVolume(folder / "d");
            // What is missing at the very end of a document or of VTK may not matter.
            if (at < whole.size() * 8 / 10) {
                EXPECT_FALSE(cut) << name << " cut at " << at;
            }
        }
        std::uint32_t random = 12345;
        for (int trial = 0; trial < 60; ++trial) {
            std::string damaged = whole;
            for (int n = 0; n < 3; ++n) {
                random = random * 1664525 + 1013904223;
                damaged[random % damaged.size()] = static_cast<char>(random >> 24);
            }
            writeText(folder / "d", damaged);
            (void)readLabelVolume(folder / "d", {{}, std::uint64_t{64} << 20, nullptr});
        }
    }
}

/// Every file of folders of both versions cut, changed or taken away.
TEST(OtherVolumes, DamagedZarrIsAnErrorOrAVolumeAndNeverACrash) {
    namespace fs = std::filesystem;
    const TemporaryFolder folder;
    const SemanticVolume volume = volumeOf(8, true, {40, 34, 36});
    for (const int version : {2, 3}) {
        writers::VolumeWriteOptions options;
        options.zarr.version = version;
        const fs::path whole = folder / ("v" + std::to_string(version) + ".zarr");
        ASSERT_TRUE(writers::writeVolume(volume, whole, options));
        std::vector<fs::path> files;
        for (const auto& entry : fs::recursive_directory_iterator(whole))
            if (entry.is_regular_file()) files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        std::uint32_t random = 4711;
        for (const fs::path& file : files) {
            const std::string text = readText(file);
            const bool isChunk = file.filename() == "0";
            for (int trial = 0; trial < 40; ++trial) {
                std::string damaged = text;
                for (int n = 0; n < 3; ++n) {
                    random = random * 1664525 + 1013904223;
                    damaged[random % damaged.size()] = static_cast<char>(random >> 24);
                }
                if (trial < 10) damaged = text.substr(0, text.size() * static_cast<std::size_t>(trial) / 10);
                writeText(file, damaged);
                const auto read = readLabelVolume(whole, {{}, std::uint64_t{64} << 20, nullptr});
                if (trial < 10 && (isChunk || file.filename() == "zarr.json" || file.filename() == ".zarray")) {
                    EXPECT_FALSE(read) << file << " cut";
                }
            }
            fs::remove(file);
            (void)readLabelVolume(whole, {{}, std::uint64_t{64} << 20, nullptr});
            writeText(file, text);
        }
        EXPECT_TRUE(readLabelVolume(whole)) << "as it was";
    }
}

TEST(OtherVolumes, AbsurdZarrIsRefusedBeforeMemoryIsTaken) {
    const TemporaryFolder folder;
    const auto expectRefused = [&](const char* shape, const char* chunks, const char* more, Code code) {
        writeText(folder / ".zarray",
                  std::string(R"({"zarr_format":2,"dtype":"|u1","order":"C","filters":null,"fill_value":0,"shape":)") +
                      shape + R"(,"chunks":)" + chunks + more + "}");
        const auto read = readLabelVolume(folder.path(), {{}, std::uint64_t{256} << 20, nullptr});
        ASSERT_FALSE(read) << shape << chunks;
        EXPECT_EQ(read.error().code(), code) << read.error().toString();
    };
    const char* plain = R"(,"compressor":null)";
    expectRefused("[65535,65535,65535]", "[64,64,64]", plain, Code::BadImage);
    expectRefused("[65536,9,9]", "[9,9,9]", plain, Code::BadImage);
    expectRefused("[9,9,9]", "[0,9,9]", plain, Code::BadImage);
    expectRefused("[9,9,9]", "[4294967296,4294967296,4294967296]", plain, Code::BadImage);
    expectRefused("[9,9,9]", "[1073741824,2,2]", plain, Code::BadImage);
    expectRefused("[4000,4000,400]", "[1,1,1]", plain, Code::BadImage);
    expectRefused("[4000,2000,2000]", "[100,100,100]", plain, Code::BadImage);
    expectRefused("[99,9000,9000]", "[99,100,100]", plain, Code::InputTooBig);
    expectRefused("[9,9]", "[9,9]", plain, Code::BadImage);
    expectRefused("[2,9,9,9]", "[1,9,9,9]", plain, Code::BadImage);
    expectRefused("[-9,9,9]", "[9,9,9]", plain, Code::BadImage);
    expectRefused("[1,9,9]", "[1,9,9]", plain, Code::BadImage);
    expectRefused("[9,9,9]", "[9,9,9]", R"(,"compressor":{"id":"lzma"})", Code::BadImage);
    writeText(folder / ".zarray", std::string(5000, '['));
    EXPECT_EQ(readLabelVolume(folder.path()).error().code(), Code::BadJson);
}

TEST(OtherVolumes, SizesThatCannotBeAreRefusedBeforeMemoryIsTaken) {
    const TemporaryFolder folder;
    writeText(folder / "v.nrrd",
              "NRRD0004\ntype: uint\ndimension: 3\nsizes: 65535 65535 65535\nendian: little\nencoding: raw\n\nabcd");
    EXPECT_EQ(readLabelVolume(folder / "v.nrrd").error().code(), Code::BadNrrd);
    writeText(folder / "v.nrrd", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 65536 2 2\nencoding: raw\n\nabcd");
    EXPECT_EQ(readLabelVolume(folder / "v.nrrd").error().code(), Code::BadNrrd);
    writeText(folder / "v.nrrd", "NRRD0004\ntype: float\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\nabcd");
    EXPECT_EQ(readLabelVolume(folder / "v.nrrd").error().code(), Code::BadNrrd);
    std::string shorts = bigEndianShorts();
    shorts[shorts.size() - 2] = '\x80';
    writeText(folder / "v.nrrd", shorts);
    EXPECT_EQ(readLabelVolume(folder / "v.nrrd").error().code(), Code::BadNrrd) << "negative";
    const SemanticVolume volume = volumeOf(16, true);
    ASSERT_TRUE(writers::writeVolume(volume, folder / "b.nrrd"));
    EXPECT_EQ(readLabelVolume(folder / "b.nrrd", {{}, 100'000, nullptr}).error().code(), Code::InputTooBig);
}

TEST(OtherVolumes, ADocumentIsNeverFollowedOutOfItsFolder) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "in");
    writers::VolumeWriteOptions options;
    options.texture = writers::TextureKind::Image;
    ASSERT_TRUE(writers::writeVolume(volumeOf(8, true), folder / "in/v.ade.gml", options));
    std::filesystem::copy_file(folder / "in/v.labels.nrrd", folder / "v.labels.nrrd");
    const std::string whole = readText(folder / "in/v.ade.gml");
    const std::string absolute = (folder / "v.labels.nrrd").string();
    for (const std::string& name : {std::string("../v.labels.nrrd"), absolute, std::string("%2e%2e/v.labels.nrrd"),
                                    "file://" + absolute, std::string("in/../../v.labels.nrrd"), std::string("..")}) {
        std::string text = whole;
        text.replace(text.find("v.labels.nrrd"), 13, name);
        writeText(folder / "in/w.ade.gml", text);
        const auto read = readLabelVolume(folder / "in/w.ade.gml");
        ASSERT_FALSE(read) << name;
        EXPECT_EQ(read.error().code(), Code::BadImage) << name;
        EXPECT_NE(read.error().message().find("outside of its folder"), std::string::npos) << read.error().message();
    }
}

}  // namespace
}  // namespace svt::volume_readers
