#include <svt/core/file.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/volume/file/zip_container.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/volume/svt_file.hpp>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <thread>

namespace svt::volume {
namespace {

using svt::test::readText;
using svt::test::TemporaryFolder;
using svt::test::writeText;
using test::isSame;
using test::sampleVolume;

std::string bytesOfVolume(const SemanticVolume& volume) {
    const TemporaryFolder folder;
    const auto size = writeSvt(volume, folder / "v.svt");
    EXPECT_TRUE(size) << (size ? "" : size.error().toString());
    std::string bytes = readText(folder / "v.svt");
    EXPECT_EQ(bytes.size(), size ? *size : 0);
    // The same in memory.
    const auto inMemory = svtBytes(volume);
    EXPECT_TRUE(inMemory && std::ranges::equal(*inMemory, std::as_bytes(std::span(bytes))));
    return bytes;
}

Result<SemanticVolume> readBytes(std::string_view text) { return readSvt(std::as_bytes(std::span(text)), "test.svt"); }

using EntryTexts = std::map<std::string, std::string>;

/// The file with `change` applied to its entries and correct CRCs: a well-formed container with wrong content.
std::string changed(const std::string& file, const std::function<void(EntryTexts&)>& change) {
    const auto found = readZip(std::as_bytes(std::span(file)));
    EXPECT_TRUE(found);
    EntryTexts texts;
    for (const ZipEntry& entry : *found) {
        std::vector<std::byte> buffer;
        const auto data = unpack(entry, entry.size, buffer);
        EXPECT_TRUE(data);
        texts[std::string(entry.name)] = {reinterpret_cast<const char*>(data->data()), data->size()};
    }
    change(texts);
    std::vector<ZipSource> sources;
    if (texts.count("mimetype") != 0)
        sources.push_back({"mimetype", {std::as_bytes(std::span(texts["mimetype"]))}, false});
    for (const auto& [name, text] : texts)
        if (name != "mimetype") sources.push_back({name, {std::as_bytes(std::span(text))}, true});
    const TemporaryFolder folder;
    EXPECT_TRUE(writeZip(folder / "z", sources));
    return readText(folder / "z");
}

void replaceIn(std::string& text, std::string_view from, std::string_view to) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
}

void expectRefused(const std::string& file, Code code, std::string_view reason) {
    const auto volume = readBytes(file);
    ASSERT_FALSE(volume) << "accepted, expected: " << reason;
    EXPECT_EQ(volume.error().code(), code) << volume.error().toString();
    EXPECT_NE(volume.error().message().find(reason), std::string::npos)
        << volume.error().message() << "\nexpected: " << reason;
    EXPECT_EQ(volume.error().where().file, "test.svt");
}

TEST(SvtFile, KeepsLinesAndMeshesWhereThereAreAny) {
    const SemanticVolume bare = sampleVolume({8, 8, 8});
    SemanticVolume volume = bare;
    volume.vectors.points = {{0, 0, 0}, {10000, 0, 0}, {0, 10000, 7}};
    volume.vectors.segments = {{0, {0, 1}}};
    volume.vectors.triangles = {{0, {0, 1, 2}}};
    const std::string file = bytesOfVolume(volume);
    const auto read = readBytes(file);
    ASSERT_TRUE(read) << read.error().toString();
    EXPECT_EQ(read->vectors, volume.vectors);
    EXPECT_EQ(bytesOfVolume(*read), file);
    // Without them the file has no such entry.
    EXPECT_EQ(changed(bytesOfVolume(bare), [](EntryTexts& texts) { EXPECT_EQ(texts.count("meshes/shapes"), 0u); }),
              changed(file, [](EntryTexts& texts) { EXPECT_EQ(texts.erase("meshes/shapes"), 1u); }));

    expectRefused(changed(file, [](EntryTexts& texts) { texts["meshes/shapes"].pop_back(); }), Code::BadVolume,
                  "vector parts");
    volume.vectors.segments[0].label = 4000;
    const TemporaryFolder folder;
    const auto refused = writeSvt(volume, folder / "v.svt");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code(), Code::BadArgument);
}

/// Of a volume of 8 x 8 x 8 samples: floor, ceiling and a slope.
std::vector<FacePlane> somePlanes() {
    return {{{{0, 0, 1}, -1}, {0, 0, 0}, {8, 8, 1}},
            {{{0, 0, -1}, 7.25}, {0, 1, 7}, {8, 7, 8}},
            {{{0.6, 0, -0.8}, -0.0}, {1, 2, 3}, {4, 5, 6}}};
}

TEST(SvtFile, KeepsPlanesOfFacesWhereThereAreAny) {
    const SemanticVolume bare = sampleVolume({8, 8, 8});
    EXPECT_TRUE(readBytes(bytesOfVolume(bare))->planes.empty());
    SemanticVolume volume = bare;
    volume.planes = somePlanes();
    const std::string file = bytesOfVolume(volume);
    const auto read = readBytes(file);
    ASSERT_TRUE(read) << read.error().toString();
    EXPECT_EQ(read->planes, volume.planes);
    EXPECT_EQ(bytesOfVolume(*read), file);
    // Without them the file has no such entry.
    EXPECT_EQ(changed(bytesOfVolume(bare), [](EntryTexts& texts) { EXPECT_EQ(texts.count("meshes/planes"), 0u); }),
              changed(file, [](EntryTexts& texts) { EXPECT_EQ(texts.erase("meshes/planes"), 1u); }));
    volume.planes[2].max[1] = 9;
    const TemporaryFolder folder;
    const auto refused = writeSvt(volume, folder / "v.svt");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code(), Code::BadArgument);
}

TEST(SvtFile, EntriesStandInTheOrderOfTheFormat) {
    SemanticVolume volume = sampleVolume({8, 8, 8});
    volume.vectors.points = {{0, 0, 0}, {10000, 0, 0}};
    volume.vectors.segments = {{0, {0, 1}}};
    volume.planes = somePlanes();
    const std::string file = bytesOfVolume(volume);
    const auto entries = readZip(std::as_bytes(std::span(file)));
    ASSERT_TRUE(entries);
    const char* expected[] = {"mimetype",       "svt.json",      "labels.json",  "columns/index",
                              "columns/blocks", "meshes/shapes", "meshes/planes"};
    ASSERT_EQ(entries->size(), std::size(expected));
    for (std::size_t e = 0; e < entries->size(); ++e) {
        EXPECT_EQ((*entries)[e].name, expected[e]);
        EXPECT_TRUE(!(*entries)[e].isDeflated || (*entries)[e].name == "labels.json");
    }
    const auto read = readBytes(file);
    ASSERT_TRUE(read) << read.error().toString();
    EXPECT_TRUE(isSame(*read, volume));
}

TEST(SvtFile, DamagedPlanesAreTold) {
    SemanticVolume volume = sampleVolume({8, 8, 8});
    volume.planes = somePlanes();
    const std::string file = bytesOfVolume(volume);
    expectRefused(changed(file, [](EntryTexts& texts) { texts["meshes/planes"].pop_back(); }), Code::BadVolume,
                  "face planes");
    // Planes of a larger volume.
    volume = sampleVolume({8, 8, 9});
    volume.planes = somePlanes();
    volume.planes[0].max[2] = 9;
    std::string larger;
    (void)changed(bytesOfVolume(volume), [&](EntryTexts& texts) { larger = texts["meshes/planes"]; });
    expectRefused(changed(file, [&](EntryTexts& texts) { texts["meshes/planes"] = larger; }), Code::BadVolume,
                  "plane 0 is within voxels [0, 9) along z, there are 8");
    const auto entries = readZip(std::as_bytes(std::span(file)));
    ASSERT_TRUE(entries);
    ASSERT_EQ(entries->back().name, "meshes/planes");
    std::string damaged = file;
    const auto* data = reinterpret_cast<const char*>(entries->back().data.data());
    damaged[static_cast<std::size_t>(data - file.data()) + 5] ^= 1;
    expectRefused(damaged, Code::BadChecksum, "'meshes/planes'");
}

TEST(SvtFile, VolumeComesBackAsWritten) {
    const TemporaryFolder folder;
    for (const Vec3i dimension : {Vec3i{8, 8, 8}, Vec3i{64, 64, 9}, Vec3i{70, 66, 9}, Vec3i{130, 200, 40}}) {
        const SemanticVolume volume = sampleVolume(dimension);
        ASSERT_TRUE(writeSvt(volume, folder / "v.svt"));
        const auto read = readSvt(folder / "v.svt");
        ASSERT_TRUE(read) << read.error().toString();
        EXPECT_EQ(read->grid, volume.grid);
        EXPECT_EQ(read->labels, volume.labels);
        EXPECT_TRUE(read->columns == volume.columns);
        EXPECT_EQ(read->crsName, volume.crsName);
        EXPECT_EQ(read->modelName, volume.modelName);
        EXPECT_EQ(read->source, volume.source);
    }
}

TEST(SvtFile, NotANumberComesBackAsNotANumber) {
    SemanticVolume volume = sampleVolume({8, 8, 8});
    volume.labels.labels[0].attributes = {{"a", std::nan(""), ""}, {"b", -std::numeric_limits<double>::infinity(), ""}};
    const auto read = readBytes(bytesOfVolume(volume));
    ASSERT_TRUE(read);
    const auto& attributes = read->labels.labels[0].attributes;
    EXPECT_TRUE(std::isnan(std::get<double>(attributes[0].value)));
    EXPECT_EQ(std::get<double>(attributes[1].value), -std::numeric_limits<double>::infinity());
}

TEST(SvtFile, KeepsRecordsAreasAndFootprints) {
    SemanticVolume volume = sampleVolume({8, 8, 8});
    volume.labels.labels[0].attributes = {{"flood/rank", std::int64_t{1}, ""}, {"flood/rank", std::int64_t{3}, "", 1}};
    volume.labels.labels[0].area = 12.5;
    volume.footprints.points = {{0, 0, 0}, {1 << 20, 0, 0}, {0, 1 << 20, 0}};
    volume.footprints.triangles = {{1, {0, 2, 1}}};
    const auto read = readBytes(bytesOfVolume(volume));
    ASSERT_TRUE(read) << read.error().toString();
    EXPECT_EQ(read->labels, volume.labels);
    EXPECT_EQ(read->footprints, volume.footprints);
    EXPECT_TRUE(read->vectors.isEmpty());
    volume.footprints.triangles[0].label = 99;
    EXPECT_FALSE(svtBytes(volume));
}

TEST(SvtFile, WrongUtf8BecomesReplacementCharacters) {
    SemanticVolume volume = sampleVolume({8, 8, 8});
    volume.labels.labels[0].name =
        "a\xFF"
        "b\xC3"
        "c\xED\xA0\x80"
        "d\xC0\x80\xF4\x90\x80\x80\xE2\x82";
    const auto read = readBytes(bytesOfVolume(volume));
    ASSERT_TRUE(read) << read.error().toString();
    const std::string r = "\xEF\xBF\xBD";
    EXPECT_EQ(read->labels.labels[0].name, "a" + r + "b" + r + "c" + r + r + r + "d" + r + r + r + r + r + r + r + r);
}

TEST(SvtFile, ColorsComeBackBitByBit) {
    SemanticVolume volume = sampleVolume({8, 8, 8});
    volume.labels.labels[4].first = 6;
    volume.labels.labels[4].count = 50'000;
    std::uint32_t state = 1;
    volume.labels.phaseColors.resize(50'006);
    for (Vec3f& color : volume.labels.phaseColors)
        for (int axis = 0; axis < 3; ++axis) {
            state = state * 1664525u + 1013904223u;
            color[axis] = std::bit_cast<float>(state & 0x3FFFFFFFu);
        }
    const auto read = readBytes(bytesOfVolume(volume));
    ASSERT_TRUE(read) << read.error().toString();
    EXPECT_TRUE(read->labels == volume.labels);
}

TEST(SvtFile, VolumeWithoutLabelsCanBeWritten) {
    SemanticVolume volume;
    volume.columns = ColumnVolume::fromDense({2, 2, 2}, std::vector<Scalar>(8, 0));
    const auto read = readBytes(bytesOfVolume(volume));
    ASSERT_TRUE(read) << read.error().toString();
    EXPECT_TRUE(isSame(*read, volume));
}

TEST(SvtFile, EqualVolumesGiveEqualBytes) {
    EXPECT_TRUE(bytesOfVolume(sampleVolume()) == bytesOfVolume(sampleVolume()));
    const std::string bytes = bytesOfVolume(sampleVolume());
    const auto read = readBytes(bytes);
    ASSERT_TRUE(read);
    EXPECT_TRUE(bytesOfVolume(*read) == bytes);
}

TEST(SvtFile, BytesAtAnyAddressCanBeRead) {
    const SemanticVolume volume = sampleVolume({70, 10, 9});
    const std::string bytes = bytesOfVolume(volume);
    for (const std::size_t shift : {1u, 2u, 3u, 5u}) {
        const std::string moved = std::string(shift, ' ') + bytes;
        const auto read = readBytes(std::string_view(moved).substr(shift));
        ASSERT_TRUE(read) << read.error().toString();
        EXPECT_TRUE(isSame(*read, volume));
    }
}

TEST(SvtFile, TilesAreDecodedOneByOne) {
    const SemanticVolume volume = sampleVolume({600, 300, 9});
    const std::string bytes = bytesOfVolume(volume);
    const auto opened = openSvt(std::as_bytes(std::span(bytes)));
    ASSERT_TRUE(opened) << opened.error().toString();
    EXPECT_EQ(opened->grid, volume.grid);
    EXPECT_EQ(opened->labels, volume.labels);
    EXPECT_EQ(opened->crsName, volume.crsName);
    ASSERT_EQ(opened->blocks.count(), 6u);
    for (std::int32_t tileY = 0; tileY < volume.columns.tilesY(); ++tileY)
        for (std::int32_t tileX = 0; tileX < volume.columns.tilesX(); ++tileX) {
            const std::size_t block = opened->blocks.blockOfTile(tileX, tileY);
            const auto tile = opened->blocks.decodeTile(
                tileX, tileY, opened->frames.subspan(opened->blocks.offset(block), opened->blocks.block(block).size));
            ASSERT_TRUE(tile) << tile.error().toString();
            const ColumnTile& expected = volume.columns.tiles()[std::size_t(tileX + volume.columns.tilesX() * tileY)];
            EXPECT_TRUE(std::equal(tile->rowOf.begin(), tile->rowOf.end(), expected.rowOf.begin()));
            EXPECT_TRUE(std::equal(tile->rowColumns.begin(), tile->rowColumns.end(), expected.rowColumns.begin()));
            EXPECT_TRUE(std::equal(tile->runs.begin(), tile->runs.end(), expected.runs.begin(), expected.runs.end()));
        }
}

TEST(SvtFile, OpeningWithoutDecodingTellsTheFile) {
    const auto opened = openSvt({}, "test.svt");
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().where().file, "test.svt");
    EXPECT_NE(opened.error().message().find("is empty"), std::string::npos);
}

TEST(SvtFile, MappedFileOutlivesItsName) {
    const TemporaryFolder folder;
    const SemanticVolume volume = sampleVolume();
    ASSERT_TRUE(writeSvt(volume, folder / "v.svt"));
    const auto read = readSvt(folder / "v.svt");
    ASSERT_TRUE(read);
    ASSERT_TRUE(writeSvt(sampleVolume({8, 8, 8}), folder / "v.svt")) << "replaced while it is open";
    EXPECT_TRUE(isSame(*read, volume));
}

TEST(SvtFile, AFileThatShrinksWhileItIsOpenedIsAnErrorAndNoSignal) {
    const TemporaryFolder folder;
    const SemanticVolume volume = sampleVolume({96, 80, 24});
    ASSERT_TRUE(writeSvt(volume, folder / "v.svt"));
    const std::string whole = readText(folder / "v.svt");
    std::atomic<bool> isDone{false};
    std::thread writer([&] {
        while (!isDone) {
            for (const std::size_t size : {std::size_t{0}, std::size_t{200}, whole.size() / 2})
                std::filesystem::resize_file(folder / "v.svt", size);
            writeText(folder / "v.svt", whole);
        }
    });
    int errors = 0;
    for (int i = 0; i < 100'000 && (i < 200 || errors < 100); ++i) {
        static_cast<void>(isSvtFile(folder / "v.svt"));
        const auto read = readSvt(folder / "v.svt");
        errors += read ? 0 : 1;
        if (read)
            EXPECT_TRUE(isSame(*read, volume));
        else
            EXPECT_TRUE(read.error().code() == Code::CannotOpen || read.error().code() == Code::BadVolume ||
                        read.error().code() == Code::BadChecksum)
                << read.error().toString();
    }
    isDone = true;
    writer.join();
    EXPECT_GT(errors, 0);
}

TEST(SvtFile, FailureInTheMiddleKeepsTheOldFile) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writeSvt(sampleVolume({8, 8, 8}), folder / "v.svt"));
    const std::string before = readText(folder / "v.svt");
    rlimit old{};
    ::getrlimit(RLIMIT_FSIZE, &old);
    auto* handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, old.rlim_max};
    const bool isLimited = ::setrlimit(RLIMIT_FSIZE, &limit) == 0;
    const auto written = writeSvt(sampleVolume(), folder / "v.svt");
    ::setrlimit(RLIMIT_FSIZE, &old);
    std::signal(SIGXFSZ, handler);
    if (!isLimited) GTEST_SKIP() << "the size of files cannot be limited here";
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code(), Code::CannotWrite);
    EXPECT_TRUE(readText(folder / "v.svt") == before);
    EXPECT_EQ(folder.count(), 1);
}

TEST(SvtFile, FullDiskIsTold) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    const auto written = writeSvt(sampleVolume(), "/dev/full");
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code(), Code::DiskFull);
}

TEST(SvtFile, ExternalToolsOpenIt) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writeSvt(sampleVolume(), folder / "v.svt"));
    const std::string path = (folder / "v.svt").string();
    int tools = 0;
    if (std::system("unzip -v >/dev/null 2>&1") == 0) {
        ++tools;
        EXPECT_EQ(std::system(("unzip -tqq '" + path + "' >/dev/null").c_str()), 0);
    }
    if (std::system("python3 -c 'import zipfile' >/dev/null 2>&1") == 0) {
        ++tools;
        writeText(folder / "check.py",
                  "import json,struct,sys,zipfile\n"
                  "z=zipfile.ZipFile(sys.argv[1])\n"
                  "assert z.testzip() is None\n"
                  "assert z.read('mimetype')==b'application/vnd.svt+zip'\n"
                  "head=json.loads(z.read('svt.json')); labels=json.loads(z.read('labels.json'))\n"
                  "assert head['dimension']==[70,66,9] and head['scalarCount']==6\n"
                  "assert labels['labels'][0]['attributes'][3]['value']==2**63-1\n"
                  "assert labels['labels'][1]['name']=='K\\u00fcche'\n"
                  "blocks=list(struct.iter_unpack('<IIII',z.read('columns/index')))\n"
                  "assert len(blocks)==1 and sum(b[0] for b in blocks)==len(z.read('columns/blocks'))\n"
                  "assert z.read('columns/blocks')[:4]==bytes.fromhex('28b52ffd')\n");
        EXPECT_EQ(std::system(("python3 '" + (folder / "check.py").string() + "' '" + path + "'").c_str()), 0);
    }
    if (tools == 0) GTEST_SKIP() << "neither unzip nor python3 is installed";
}

TEST(SvtFile, FileRepackedByAnotherToolIsStillRead) {
    if (std::system("python3 -c 'import zipfile' >/dev/null 2>&1") != 0) GTEST_SKIP() << "python3 is not installed";
    const TemporaryFolder folder;
    const SemanticVolume volume = sampleVolume();
    ASSERT_TRUE(writeSvt(volume, folder / "v.svt"));
    writeText(folder / "pack.py",
              "import sys,zipfile\n"
              "source=zipfile.ZipFile(sys.argv[1])\n"
              "deflated=sys.argv[3].split(',')\n"
              "with zipfile.ZipFile(sys.argv[2],'w') as out:\n"
              "    for name in source.namelist():\n"
              "        out.writestr(name,source.read(name),zipfile.ZIP_DEFLATED if name in deflated else 0)\n");
    const auto quoted = [&](const char* name) { return " '" + (folder / name).string() + "'"; };
    const auto repacked = [&](const std::string& deflated) {
        EXPECT_EQ(
            std::system(("python3" + quoted("pack.py") + quoted("v.svt") + quoted("w.svt") + " " + deflated).c_str()),
            0);
        return readSvt(folder / "w.svt");
    };
    for (const char* deflated : {"none", "svt.json,labels.json"}) {
        const auto read = repacked(deflated);
        ASSERT_TRUE(read) << read.error().toString();
        EXPECT_TRUE(isSame(*read, volume));
    }
    for (const char* deflated : {"columns/index", "columns/blocks"}) {
        const auto read = repacked(deflated);
        ASSERT_FALSE(read) << deflated;
        EXPECT_NE(read.error().message().find("must be stored"), std::string::npos) << read.error().toString();
    }
}

TEST(SvtFile, OnlyASvtLooksLikeOne) {
    const std::string bytes = bytesOfVolume(sampleVolume({8, 8, 8}));
    const auto looks = [](std::string_view text) { return looksLikeSvt(std::as_bytes(std::span(text))); };
    EXPECT_TRUE(looks(bytes));
    EXPECT_TRUE(looks(std::string_view(bytes).substr(0, 61)));
    EXPECT_FALSE(looks(std::string_view(bytes).substr(0, 60)));
    EXPECT_FALSE(looks(""));
    EXPECT_FALSE(looks(std::string(100, ' ')));
    EXPECT_FALSE(looks("<?xml version=\"1.0\" encoding=\"UTF-8\"?><core:CityModel xmlns:core=\"x\"/>"));
}

TEST(SvtFile, MissingAndForeignFilesAreRefused) {
    const TemporaryFolder folder;
    EXPECT_EQ(readSvt(folder / "absent").error().code(), Code::CannotOpen);
    writeText(folder / "empty", "");
    EXPECT_NE(readSvt(folder / "empty").error().toString().find("is empty"), std::string::npos);
    writeText(folder / "text", std::string(1000, 'x'));
    const auto text = readSvt(folder / "text");
    EXPECT_EQ(text.error().code(), Code::BadVolume);
    EXPECT_NE(text.error().toString().find("svt build"), std::string::npos);
}

TEST(SvtFile, EveryFlippedByteIsFoundOrHarmless) {
    SemanticVolume volume = sampleVolume({8, 8, 8});
    volume.planes = somePlanes();
    const std::string bytes = bytesOfVolume(volume);
    ASSERT_LT(bytes.size(), 6000u);
    std::size_t refused = 0;
    for (const int mask : {0xFF, 0x01, 0x80}) {
        for (std::size_t at = 0; at < bytes.size(); ++at) {
            std::string damaged = bytes;
            damaged[at] = static_cast<char>(damaged[at] ^ mask);
            const auto read = readBytes(damaged);
            if (!read)
                ++refused;
            else
                ASSERT_TRUE(isSame(*read, volume)) << "byte " << at << " flipped by " << mask;
        }
    }
    EXPECT_GT(refused, bytes.size() * 3 / 2);
}

TEST(SvtFile, EveryTruncationIsRefused) {
    SemanticVolume volume = sampleVolume({8, 8, 8});
    volume.planes = somePlanes();
    const std::string bytes = bytesOfVolume(volume);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const auto read = readBytes(std::string_view(bytes).substr(0, size));
        ASSERT_FALSE(read) << size << " bytes";
        ASSERT_EQ(read.error().code(), Code::BadVolume) << size << " bytes";
    }
}

TEST(SvtFile, DamagedEntryFailsItsChecksum) {
    std::string bytes = bytesOfVolume(sampleVolume());
    const std::size_t at = bytes.find("haus.gml");
    bytes[at] = 'm';
    expectRefused(bytes, Code::BadChecksum, "'svt.json'");
}

TEST(SvtFile, UnknownEntriesAndKeysAreIgnored) {
    const SemanticVolume volume = sampleVolume();
    const std::string file = changed(bytesOfVolume(volume), [](EntryTexts& e) {
        e["bricks/index"] = std::string(1000, 'b');
        replaceIn(e["svt.json"], "\"1.0\"", "\"1.7\"");
        replaceIn(e["svt.json"], "\"format\"", "\"future\": [{\"a\": 1}], \"format\"");
        replaceIn(e["labels.json"], "{\"labels\"", "{\"future\":{\"a\":[[1],{\"b\":[2]}]},\"labels\"");
        replaceIn(e["labels.json"], "{\"id\"", "{\"later\":[1,{\"x\":null}],\"id\"");
    });
    const auto read = readBytes(file);
    ASSERT_TRUE(read) << read.error().toString();
    EXPECT_TRUE(isSame(*read, volume));
}

TEST(SvtFile, DamagedUnknownEntryIsTold) {
    std::string file =
        changed(bytesOfVolume(sampleVolume()), [](EntryTexts& e) { e["bricks/index"] = "find this text"; });
    replaceIn(file, "find this text", "find that text");
    expectRefused(file, Code::BadChecksum, "bricks/index");
}

TEST(SvtFile, NewerVersionIsRefusedWithRemedy) {
    const std::string file = changed(bytesOfVolume(sampleVolume()),
                                     [](EntryTexts& e) { e["svt.json"] = R"({"format":"svt","version":"2.0"})"; });
    expectRefused(file, Code::VolumeVersion, "use a newer SVT");
}

struct Wrong {
    const char* entry;
    const char* from;
    const char* to;
    const char* reason;
};

TEST(SvtFile, WrongHeadersAreRefused) {
    const std::string file = bytesOfVolume(sampleVolume());
    const Wrong cases[] = {
        {"svt.json", "\"svt\"", "\"other\"", "'format' other than"},
        {"svt.json", "\"1.0\"", "\"x\"", "'version'"},
        {"svt.json", "\"1.0\"", "\"0.9\"", "'version'"},
        {"svt.json", "\"1.0\"", "\"99999999999999999999\"", "'version'"},
        {"svt.json", "\"1.0\"", "1.0", "'version' that is not a string"},
        {"svt.json", "\"little\"", "\"big\"", "'byteOrder'"},
        {"svt.json", "\"tileSize\": 64", "\"tileSize\": 32", "'tileSize'"},
        {"svt.json", "[70,66,9]", "[70,66]", "not a list of three"},
        {"svt.json", "[70,66,9]", "[70,66,9.5]", "'dimension'"},
        {"svt.json", "[70,66,9]", "[70,66,-9]", "'dimension'"},
        {"svt.json", "[70,66,9]", "[70,66,1]", "'dimension'"},
        {"svt.json", "[70,66,9]", "[70,66,70000]", "'dimension'"},
        {"svt.json", "[70,66,9]", "[65535,65535,9]", "columns"},
        {"svt.json", "[70,66,9]", "[700,66,9]", "3 blocks need"},
        {"svt.json", "[70,66,9]", "[60,66,9]", "outside its row"},
        {"svt.json", "[70,66,9]", "[70,66,8]", "beyond the top"},
        {"svt.json", "[0.05,", "[0.0,", "spacing"},
        {"svt.json", "[0.05,", "[1e999,", "out of range"},
        {"svt.json", "[458877.03,", "[\"458877.03\",", "not a number"},
        {"svt.json", "[0.6,0.8,0.0]", "[0.6,0.9,0.0]", "not a rotation"},
        {"svt.json", "\"axes\"", "\"axis\"", "has no 'axes'"},
        {"svt.json", "\"scalarCount\": 6", "\"scalarCount\": 7", "states 7 scalars"},
        {"svt.json", "\"scalarCount\": 6", "\"scalarCount\": -6", "not a whole number"},
        {"svt.json", "\"scalarCount\": 6", "\"scalarCount\": 4294967296", "not a whole number"},
        {"svt.json", "}", "", "invalid JSON"},
        {"svt.json", "{", "[", "invalid JSON"},
        {"svt.json", "haus.gml", "haus\xFF.gml", "invalid JSON"},
        {"mimetype", "svt", "foo", "is not a .svt"},
        {"mimetype", "zip", "zipx", "is not application/vnd.svt+zip"},
    };
    for (const Wrong& wrong : cases) {
        SCOPED_TRACE(wrong.to);
        expectRefused(changed(file, [&](EntryTexts& e) { replaceIn(e[wrong.entry], wrong.from, wrong.to); }),
                      Code::BadVolume, wrong.reason);
    }
}

TEST(SvtFile, WrongLabelTablesAreRefused) {
    const std::string file = bytesOfVolume(sampleVolume());
    const Wrong cases[] = {
        {"", "\"first\":5,", "\"first\":4,", "which are taken"},
        {"", "\"first\":1,", "\"first\":0,", "which are taken"},
        {"", "\"first\":5,", "\"first\":4294967295,", "are possible"},
        {"", "\"first\":5,\"count\":1", "\"first\":5,\"count\":67108860", "are possible"},
        {"", "\"first\":5,\"count\":1", "\"first\":6,\"count\":1", "phase colors"},
        {"", "\"first\":5,", "\"first\":-5,", "not a whole number"},
        {"", "\"first\":5,", "\"first\":5.0,", "not a whole number"},
        {"", "\"first\":5,", "", "has no 'first'"},
        {"", "\"parent\":1", "\"parent\":2", "parent"},
        {"", "\"parent\":1", "\"parent\":3", "parent"},
        {"", "\"parent\":1", "\"parent\":0", "parent"},
        {"", "\"parent\":1", "\"parent\":null", "parent"},
        {"", "\"parent\":1", "\"parent\":77", "parent"},
        {"", "\"parent\":1", "\"parent\":\"x\"", "not a whole number"},
        {"", "\"parent\":null,\"subtreeEnd\":4", "\"parent\":null,\"subtreeEnd\":0", "subtree"},
        {"", "\"parent\":null,\"subtreeEnd\":4", "\"parent\":null,\"subtreeEnd\":6", "subtree"},
        {"", "\"parent\":null,\"subtreeEnd\":4", "\"parent\":null,\"subtreeEnd\":2", "subtree"},
        {"", "\"groups\":[4]", "\"groups\":[5]", "group 5"},
        {"", "\"groups\":[4]", "\"groups\":4", "'groups' that are not a list"},
        {"", "\"winding\"", "\"magic\"", "unknown filling"},
        {"", "[0.8,0.8,0.8]", "[0.8,0.8]", "not a list of three"},
        {"", "[0.8,0.8,0.8]", "[0.8,0.8,1e39]", "too large"},
        {"", "\"opacity\":1.0", "\"opacity\":true", "not a number"},
        {"", "\"value\":5.0", "\"value\":null", "attribute whose value"},
        {"", "\"value\":5.0", "\"value\":{\"real\":\"huge\"}", "attribute whose value"},
        {"", "9223372036854775807", "9223372036854775808", "beyond 64 bits"},
        {"", "\"name\":\"five\"", "\"nome\":\"five\"", "has no 'name'"},
        {"", "[1,3,12,false]", "[1,5,12,false]", "overlap names labels"},
        {"", "[1,3,12,false]", "[1,3,-12,false]", "not a whole number"},
        {"", "[1,3,12,false]", "[1,3,12]", "overlap 0 is not a list"},
        {"", "[1,3,12,false]", "17", "overlap 0 is not a list"},
        {"", "[0.5,0.25,0.125],", "", "phase colors"},
        {"", "[0.5,0.25,0.125]", "[0.5,0.25,\"a\"]", "not a number"},
        {"", "{\"labels\":[", "{\"labels\":[17,", "label 0 is not a JSON object"},
        {"", "{\"labels\":", "{\"lobels\":", "no list 'labels'"},
        {"", "]}\n", "]", "invalid JSON"},
    };
    for (const Wrong& wrong : cases) {
        SCOPED_TRACE(std::string(wrong.from) + " -> " + wrong.to);
        expectRefused(changed(file, [&](EntryTexts& e) { replaceIn(e["labels.json"], wrong.from, wrong.to); }),
                      Code::BadVolume, wrong.reason);
    }
}

TEST(SvtFile, JsonOverItsLimitsIsRefused) {
    const std::string file = bytesOfVolume(sampleVolume());
    const auto with = [&](const char* entry, const std::string& text) {
        return changed(file, [&](EntryTexts& e) { e[entry] = text; });
    };
    const std::string deep(1'000'000, '[');
    expectRefused(with("svt.json", deep), Code::BadVolume, "nested deeper");
    expectRefused(with("svt.json", std::string(2'000'000, ' ')), Code::InputTooBig, "'svt.json' has 2000000 bytes");
    expectRefused(with("labels.json", deep), Code::BadVolume, "nested deeper");
    expectRefused(with("labels.json", "{\"labels\":[{\"id\":" + deep), Code::BadVolume, "nested deeper");
    std::string many = "{\"labels\":[{\"id\":[0";
    for (int i = 0; i < 1'100'000; ++i) many += ",0";
    expectRefused(with("labels.json", many + "]}]}"), Code::InputTooBig, "values in one element");
    expectRefused(with("labels.json", "{\"labels\":{\"a\":1}}"), Code::BadVolume, "label 0 is not a JSON object");
    expectRefused(with("labels.json", "[]"), Code::BadVolume, "no list 'labels'");
    expectRefused(with("labels.json", ""), Code::BadVolume, "invalid JSON");
}

TEST(SvtFile, WrongColumnsAreRefused) {
    const std::string file = bytesOfVolume(sampleVolume());
    const auto u32 = [](std::string& text, std::size_t index, std::uint32_t value) {
        std::memcpy(text.data() + 4 * index, &value, 4);
    };
    const std::pair<std::function<void(EntryTexts&)>, const char*> cases[] = {
        {[](EntryTexts& e) { e.erase("columns/blocks"); }, "'columns/blocks' is missing"},
        {[](EntryTexts& e) { e.erase("columns/index"); }, "'columns/index' is missing"},
        {[](EntryTexts& e) { e.erase("svt.json"); }, "'svt.json' is missing"},
        {[](EntryTexts& e) { e["columns/index"].pop_back(); }, "has 15 bytes, 1 blocks need 16"},
        {[](EntryTexts& e) { e["columns/index"].resize(32); }, "has 32 bytes"},
        {[](EntryTexts& e) { e["columns/blocks"].pop_back(); }, "the index states"},
        {[](EntryTexts& e) { e["columns/blocks"] += 'x'; }, "the index states"},
        {[&](EntryTexts& e) { u32(e["columns/index"], 0, 0xFFFFFFFF); }, "the index states"},
        {[&](EntryTexts& e) { u32(e["columns/index"], 1, 0xFFFFFFFF); }, "cannot unpack to"},
        {[&](EntryTexts& e) { u32(e["columns/index"], 1, 7); }, "block 0 of the columns: it is not a zstd frame"},
        {[&](EntryTexts& e) { u32(e["columns/index"], 2, 0xFFFFFFFF); }, "cannot take 4294967295 bytes"},
        {[&](EntryTexts& e) { u32(e["columns/index"], 2, 100); }, "more bytes than the index states"},
    };
    for (const auto& [change, reason] : cases) {
        SCOPED_TRACE(reason);
        expectRefused(changed(file, change), Code::BadVolume, reason);
    }
    expectRefused(changed(file, [](EntryTexts& e) { e["columns/blocks"][9] ^= 1; }), Code::BadChecksum,
                  "block 0 of the columns has CRC32");
}

TEST(SvtFile, HugeGridInASmallFileIsRefusedWithoutAllocating) {
    const std::string file = changed(bytesOfVolume(sampleVolume()), [](EntryTexts& e) {
        replaceIn(e["svt.json"], "[70,66,9]", "[65535,32768,65535]");
    });
    expectRefused(file, Code::BadVolume, "32768 blocks need");
}

TEST(SvtFile, InconsistentVolumesAreNotWritten) {
    const TemporaryFolder folder;
    const auto expectNotWritten = [&](const std::function<void(SemanticVolume&)>& change, std::string_view reason) {
        SemanticVolume volume = sampleVolume({8, 8, 8});
        change(volume);
        const auto written = writeSvt(volume, folder / "v.svt");
        ASSERT_FALSE(written) << reason;
        EXPECT_EQ(written.error().code(), Code::BadArgument);
        EXPECT_NE(written.error().message().find(reason), std::string::npos) << written.error().message();
        EXPECT_EQ(folder.count(), 0);
    };
    expectNotWritten([](SemanticVolume& v) { v.columns = sampleVolume({8, 8, 9}).columns; }, "8 x 8 x 9");
    expectNotWritten([](SemanticVolume& v) { v.columns = {}; }, "0 x 0 x 0");
    expectNotWritten(
        [](SemanticVolume& v) {
            v.labels.labels[3].count = 0;
            v.labels.labels[3].first = 0;
            v.labels.phaseColors.clear();
        },
        "scalar 5");
    expectNotWritten([](SemanticVolume& v) { v.labels.labels[2].subtreeEnd = 0; }, "subtree");
    expectNotWritten([](SemanticVolume& v) { v.labels.labels[2].volume = std::nan(""); }, "finite");
    expectNotWritten([](SemanticVolume& v) { v.labels.labels[2].filling = static_cast<Filling>(99); }, "filling");
}

}  // namespace
}  // namespace svt::volume
