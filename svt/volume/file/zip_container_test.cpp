#include <svt/core/temporary_folder_test.hpp>
#include <svt/volume/file/zip_container.hpp>

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdlib>
#include <functional>
#include <optional>

namespace svt::volume {
namespace {

using svt::test::readText;
using svt::test::TemporaryFolder;

std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text)); }

std::string textOf(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string number(std::uint64_t value, int bytes) {
    std::string text;
    for (int b = 0; b < bytes; ++b) text += static_cast<char>(value >> (8 * b));
    return text;
}

std::uint32_t plainCrc(std::string_view text) {
    return static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size())));
}

/// The fields of a header of an entry; tests change some of them to wrong values.
struct RawHeader {
    std::string name;
    std::uint32_t flags = 0, method = 0, disk = 0;
    std::uint64_t crc = 0, size = 0, stored = 0, offset = 0;
    std::string extra, comment;
};

struct RawEntry {
    std::string data;
    RawHeader local, central;

    RawEntry(std::string name, std::string content) : data(std::move(content)) {
        local.name = std::move(name);
        local.crc = plainCrc(data);
        local.size = local.stored = data.size();
        central = local;
    }
};

/// A handmade ZIP, which can be wrong in every way.
struct RawZip {
    std::vector<RawEntry> entries;
    std::optional<std::uint64_t> count, directorySize, directoryOffset;
    std::string beforeEnd, afterEnd;

    [[nodiscard]] std::string bytes() {
        std::string out;
        for (RawEntry& e : entries) {
            e.central.offset += out.size();
            out += "PK\3\4" + number(20, 2) + number(e.local.flags, 2) + number(e.local.method, 2) + number(0, 4) +
                   number(e.local.crc, 4) + number(e.local.stored, 4) + number(e.local.size, 4) +
                   number(e.local.name.size(), 2) + number(e.local.extra.size(), 2) + e.local.name + e.local.extra +
                   e.data;
        }
        const std::size_t offset = out.size();
        for (RawEntry& e : entries) {
            const RawHeader& c = e.central;
            out += "PK\1\2" + number(20, 2) + number(20, 2) + number(c.flags, 2) + number(c.method, 2) + number(0, 4) +
                   number(c.crc, 4) + number(c.stored, 4) + number(c.size, 4) + number(c.name.size(), 2) +
                   number(c.extra.size(), 2) + number(c.comment.size(), 2) + number(c.disk, 2) + number(0, 2) +
                   number(0, 4) + number(c.offset, 4) + c.name + c.extra + c.comment;
        }
        const std::size_t size = out.size() - offset;
        out += beforeEnd;
        out += "PK\5\6" + number(0, 4) + number(count.value_or(entries.size()), 2) +
               number(count.value_or(entries.size()), 2) + number(directorySize.value_or(size), 4) +
               number(directoryOffset.value_or(offset), 4) + number(0, 2) + afterEnd;
        return out;
    }
};

/// The data of an entry if they are correct.
std::optional<std::string> unpackedText(const ZipEntry& entry) {
    std::vector<std::byte> buffer;
    const auto data = unpack(entry, entry.size, buffer);
    if (!data) return std::nullopt;
    return textOf(*data);
}

RawZip twoEntries() { return {{RawEntry("one", "first data"), RawEntry("two", "second")}, {}, {}, {}, {}, {}}; }

void expectBad(std::string_view archive, std::string_view reason) {
    const auto entries = readZip(bytesOf(archive));
    ASSERT_FALSE(entries) << "accepted, expected: " << reason;
    EXPECT_EQ(entries.error().code(), Code::BadVolume);
    EXPECT_NE(entries.error().message().find(reason), std::string::npos) << entries.error().message();
}

TEST(ZipContainer, EntriesComeBackAsWritten) {
    const TemporaryFolder folder;
    const std::string big(100'000, 'x');
    const ZipSource sources[] = {{"mimetype", {bytesOf("text")}, false},
                                 {"a/empty", {}, true},
                                 {"a/parts", {bytesOf("one"), bytesOf(""), bytesOf(big)}, true}};
    const auto size = writeZip(folder / "z", sources);
    ASSERT_TRUE(size) << size.error().toString();
    const std::string archive = readText(folder / "z");
    EXPECT_EQ(*size, archive.size());
    const auto entries = readZip(bytesOf(archive));
    ASSERT_TRUE(entries) << entries.error().toString();
    ASSERT_EQ(entries->size(), 3u);
    EXPECT_EQ((*entries)[0].name, "mimetype");
    EXPECT_EQ(textOf((*entries)[0].data), "text");
    EXPECT_EQ((*entries)[1].data.size(), 0u);
    EXPECT_EQ(textOf((*entries)[2].data), "one" + big);
    for (const ZipEntry& entry : *entries) EXPECT_TRUE(unpackedText(entry));
}

TEST(ZipContainer, DeflatedEntriesComeBackAsWritten) {
    const TemporaryFolder folder;
    // Several pieces of one deflate stream, cut across the parts.
    std::string text;
    for (int i = 0; text.size() < 3'000'000; ++i) text += "{\"id\":\"wall-" + std::to_string(i * 7919) + "\"}\n";
    const std::string noise = [] {
        std::string bytes(1000, '\0');
        std::uint32_t state = 1;
        for (char& c : bytes) c = static_cast<char>((state = state * 1664525u + 1013904223u) >> 24);
        return bytes;
    }();
    const ZipSource sources[] = {
        {"text", {bytesOf(text).first(1'500'000), bytesOf(text).subspan(1'500'000)}, true, true},
        {"empty", {}, true, true},
        {"noise", {bytesOf(noise)}, true, true}};
    ASSERT_TRUE(writeZip(folder / "z", sources));
    const std::string archive = readText(folder / "z");
    EXPECT_LT(archive.size(), text.size() / 4);
    const auto entries = readZip(bytesOf(archive));
    ASSERT_TRUE(entries) << entries.error().toString();
    EXPECT_TRUE((*entries)[0].isDeflated);
    EXPECT_EQ((*entries)[0].size, text.size());
    EXPECT_EQ(unpackedText((*entries)[0]), text);
    EXPECT_EQ(unpackedText((*entries)[1]), "");
    EXPECT_FALSE((*entries)[2].isDeflated) << "deflating would make it longer";
    EXPECT_EQ(unpackedText((*entries)[2]), noise);
}

TEST(ZipContainer, DeflatedDataThatLieAreRefused) {
    const TemporaryFolder folder;
    const std::string text(50'000, 'x');
    ASSERT_TRUE(writeZip(folder / "z", std::vector<ZipSource>{{"text", {bytesOf(text)}, true, true}}));
    const std::string archive = readText(folder / "z");
    const auto good = readZip(bytesOf(archive));
    ASSERT_TRUE(good);
    const auto expectRefused = [&](const std::function<void(ZipEntry&)>& change, Code code, std::string_view reason) {
        ZipEntry entry = (*good)[0];
        change(entry);
        std::vector<std::byte> buffer;
        const auto data = unpack(entry, 1'000'000'000'000, buffer);
        ASSERT_FALSE(data) << reason;
        EXPECT_EQ(data.error().code(), code) << reason;
        EXPECT_NE(data.error().message().find(reason), std::string::npos) << data.error().message();
    };
    expectRefused([](ZipEntry& e) { e.size -= 1; }, Code::BadVolume, "cannot be unpacked");
    expectRefused([](ZipEntry& e) { e.size += 1; }, Code::BadVolume, "cannot be unpacked");
    expectRefused([](ZipEntry& e) { e.size = 0; }, Code::BadVolume, "cannot be unpacked");
    expectRefused([](ZipEntry& e) { e.data = e.data.first(e.data.size() - 1); }, Code::BadVolume, "cannot be unpacked");
    expectRefused([](ZipEntry& e) { e.data = e.data.first(0); }, Code::BadVolume, "cannot be unpacked");
    expectRefused([](ZipEntry& e) { e.data = bytesOf("\xFF\xFF\xFF\xFF"); }, Code::BadVolume, "cannot be unpacked");
    expectRefused([](ZipEntry& e) { e.crc ^= 1; }, Code::BadChecksum, "'text' have CRC32");
    expectRefused([](ZipEntry& e) { e.size = 100'000'000'000; }, Code::BadVolume, "cannot unpack from");
    std::vector<std::byte> buffer;
    EXPECT_EQ(unpack((*good)[0], 49'999, buffer).error().code(), Code::InputTooBig);
}

TEST(ZipContainer, DataThatDeflateTooWellAreStored) {
    // 80 MB of zeros would unpack to more than a reader takes from 0.1 MB.
    const TemporaryFolder folder;
    const std::string zeros(80'000'000, '\0');
    ASSERT_TRUE(writeZip(folder / "z", std::vector<ZipSource>{{"zeros", {bytesOf(zeros)}, true, true}}));
    const std::string archive = readText(folder / "z");
    const auto entries = readZip(bytesOf(archive));
    ASSERT_TRUE(entries);
    EXPECT_FALSE((*entries)[0].isDeflated);
    EXPECT_TRUE(unpackedText((*entries)[0]) == zeros);
}

TEST(ZipContainer, DataAreAlignedAndTheMimeTypeStandsAtByte38) {
    const TemporaryFolder folder;
    std::vector<ZipSource> sources = {{"mimetype", {bytesOf("text")}, false}};
    for (std::size_t length = 1; length <= 130; ++length)
        sources.push_back({std::string(length, 'n'), {bytesOf("?")}, true});
    ASSERT_TRUE(writeZip(folder / "z", sources));
    const std::string archive = readText(folder / "z");
    EXPECT_EQ(archive.substr(38, 4), "text");
    const auto entries = readZip(bytesOf(archive));
    ASSERT_TRUE(entries);
    for (std::size_t e = 1; e < entries->size(); ++e) {
        const auto offset = reinterpret_cast<const char*>((*entries)[e].data.data()) - archive.data();
        EXPECT_EQ(offset % 64, 0) << (*entries)[e].name;
    }
}

TEST(ZipContainer, Zip64IsWrittenWhereNeededAndReadBack) {
    const TemporaryFolder folder;
    const ZipSource sources[] = {{"small", {bytesOf("12345")}, true},
                                 {"large", {bytesOf("a text of more than twenty bytes")}, true},
                                 {"after", {bytesOf("1")}, true}};
    ASSERT_TRUE(writeZip(folder / "z", sources, 20));
    const std::string archive = readText(folder / "z");
    EXPECT_NE(archive.find("PK\6\6"), std::string::npos);
    const auto entries = readZip(bytesOf(archive));
    ASSERT_TRUE(entries) << entries.error().toString();
    EXPECT_EQ(textOf((*entries)[1].data), "a text of more than twenty bytes");
    EXPECT_EQ(textOf((*entries)[2].data), "1");
}

TEST(ZipContainer, CrcOfManyPiecesIsThatOfTheWhole) {
    std::string text(9 * (1 << 20) + 12345, '\0');
    for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>(i * 2654435761u >> 13);
    EXPECT_EQ(crc32Of(bytesOf(text)), plainCrc(text));
    EXPECT_EQ(crc32Of(bytesOf(text).subspan(100), crc32Of(bytesOf(text).first(100))), plainCrc(text));
    EXPECT_EQ(crc32Of({}), 0u);
    EXPECT_EQ(crc32Of(bytesOf("123456789")), 0xCBF43926u);
}

TEST(ZipContainer, WrongCrcNamesTheEntry) {
    RawZip zip = twoEntries();
    zip.entries[1].data = "sEcond";
    const std::string archive = zip.bytes();
    const auto entries = readZip(bytesOf(archive));
    ASSERT_TRUE(entries);
    EXPECT_TRUE(unpackedText((*entries)[0]));
    std::vector<std::byte> buffer;
    const auto checked = unpack((*entries)[1], 100, buffer);
    ASSERT_FALSE(checked);
    EXPECT_EQ(checked.error().code(), Code::BadChecksum);
    EXPECT_NE(checked.error().message().find("'two'"), std::string::npos);
}

TEST(ZipContainer, PlainArchiveByHandIsRead) {
    const std::string archive = twoEntries().bytes();
    const auto entries = readZip(bytesOf(archive));
    ASSERT_TRUE(entries) << entries.error().toString();
    EXPECT_EQ(textOf((*entries)[0].data), "first data");
    EXPECT_EQ(textOf((*entries)[1].data), "second");
}

TEST(ZipContainer, EveryTruncationIsRefused) {
    const std::string archive = twoEntries().bytes();
    for (std::size_t size = 0; size < archive.size(); ++size)
        EXPECT_FALSE(readZip(bytesOf(std::string_view(archive).substr(0, size)))) << size;
    expectBad(archive + "x", "bytes were added");
}

TEST(ZipContainer, HostileNamesAreRefused) {
    const std::pair<std::string, const char*> cases[] = {
        {"../evil", "'.' or '..'"},
        {"a/../../evil", "'.' or '..'"},
        {"a/./b", "'.' or '..'"},
        {"a//b", "'.' or '..'"},
        {"folder/", "'.' or '..'"},
        {"..", "'.' or '..'"},
        {"/etc/passwd", "absolute"},
        {"a\\b", "backslash"},
        {"C:evil", "colon"},
        {std::string("a\0b", 3), "ASCII"},
        {"", "is empty"},
        {"\x1b[2J", "ASCII"},
        {std::string(256, 'n'), "255"},
    };
    for (const auto& [name, reason] : cases) {
        RawZip zip = twoEntries();
        zip.entries[1].local.name = zip.entries[1].central.name = name;
        expectBad(zip.bytes(), reason);
    }
}

TEST(ZipContainer, TheSameNameTwiceIsRefused) {
    RawZip zip = twoEntries();
    zip.entries[1].local.name = zip.entries[1].central.name = "one";
    expectBad(zip.bytes(), "occurs twice");
}

TEST(ZipContainer, EncryptedStreamedAndStrangelyCompressedEntriesAreRefused) {
    const struct {
        std::uint32_t flags, method;
        const char* reason;
    } cases[] = {
        {0, 12, "compressed with method 12"}, {0, 93, "compressed with method 93"}, {1, 0, "is encrypted"},
        {8, 0, "size after the data"},        {1u << 13, 0, "flags 0x2000"},        {1u << 6, 0, "flags 0x0040"}};
    for (const auto& c : cases) {
        for (const bool isLocal : {false, true}) {
            RawZip zip = twoEntries();
            RawHeader& header = isLocal ? zip.entries[0].local : zip.entries[0].central;
            header.flags = c.flags;
            header.method = c.method;
            expectBad(zip.bytes(), c.reason);
        }
    }
    RawZip utf8 = twoEntries();
    utf8.entries[0].local.flags = utf8.entries[0].central.flags = 1u << 11;
    EXPECT_TRUE(readZip(bytesOf(utf8.bytes())));
}

TEST(ZipContainer, HeadersThatDifferAreRefused) {
    const std::function<void(RawEntry&)> changes[] = {[](RawEntry& e) { e.local.name = "eno"; },
                                                      [](RawEntry& e) { e.local.crc ^= 1; },
                                                      [](RawEntry& e) { e.local.size -= 1; },
                                                      [](RawEntry& e) { e.local.stored -= 1; },
                                                      [](RawEntry& e) { e.local.method = 8; },
                                                      [](RawEntry& e) { e.central.method = 8; },
                                                      [](RawEntry& e) { e.central.crc ^= 1; },
                                                      [](RawEntry& e) { e.central.size = e.central.stored = 3; },
                                                      [](RawEntry& e) { e.local.size = e.local.stored = 3; }};
    for (const auto& change : changes) {
        RawZip zip = twoEntries();
        change(zip.entries[0]);
        expectBad(zip.bytes(), "differs between its local header");
    }
}

TEST(ZipContainer, SizesAndPlacesOutsideTheFileAreRefused) {
    const std::pair<std::function<void(RawEntry&)>, const char*> cases[] = {
        {[](RawEntry& e) { e.central.size = 9; }, "two sizes"},
        {[](RawEntry& e) { e.central.size = e.central.stored = e.local.size = e.local.stored = 100'000; },
         "outside the file"},
        {[](RawEntry& e) { e.central.offset += 1; }, "no local header"},
        {[](RawEntry& e) { e.central.offset += 100'000; }, "outside the file"},
        {[](RawEntry& e) { e.central.offset = 0xFFFFFFFE; }, "outside the file"},
        {[](RawEntry& e) { e.central.disk = 1; }, "split archive"}};
    for (const auto& [change, reason] : cases) {
        RawZip zip = twoEntries();
        change(zip.entries[0]);
        expectBad(zip.bytes(), reason);
    }
}

TEST(ZipContainer, OverlappingEntriesAreRefused) {
    // The data of the outer entry are the local header and the data of the inner one.
    const std::string inner = [] {
        RawZip zip{{RawEntry("in", "data")}, {}, {}, {}, {}, {}};
        return zip.bytes().substr(0, 30 + 2 + 4);
    }();
    RawZip both{{RawEntry("outer", inner), RawEntry("in", "data")}, {}, {}, {}, {}, {}};
    std::string archive = both.bytes();
    // Point the second central header at the copy inside the first entry.
    const std::size_t central = archive.rfind("PK\1\2");
    archive.replace(central + 42, 4, number(35, 4));
    expectBad(archive, "overlap");
}

TEST(ZipContainer, DirectoryThatDoesNotFitIsRefused) {
    const auto with = [](auto change) {
        RawZip zip = twoEntries();
        change(zip);
        return zip.bytes();
    };
    expectBad(with([](RawZip& z) { z.count = 1; }), "more than its entries");
    expectBad(with([](RawZip& z) { z.count = 3; }), "do not fit in");
    expectBad(with([](RawZip& z) { z.count = 60000; }), "do not fit in");
    expectBad(with([](RawZip& z) { z.directorySize = 1; }), "directory of 1 bytes");
    expectBad(with([](RawZip& z) { z.directoryOffset = 0xFFFFFFF0; }), "does not end at");
    expectBad(with([](RawZip& z) { z.beforeEnd = "gap"; }), "does not end at");
    expectBad(with([](RawZip& z) { z.entries[1].central.extra = "123"; }), "extra field that is damaged");
    expectBad(with([](RawZip& z) { z.entries[1].local.extra = number(7, 2) + number(9, 2) + "1"; }),
              "extra field that is damaged");
    std::string longName = twoEntries().bytes();
    longName.replace(longName.rfind("PK\1\2") + 28, 2, number(4, 2));
    expectBad(longName, "reaches beyond its end");
    std::string commented = twoEntries().bytes();
    commented[commented.size() - 2] = 5;
    expectBad(commented, "comment that is not there");
    std::string split = twoEntries().bytes();
    split[split.size() - 18] = 1;
    expectBad(split, "split into several files");
}

TEST(ZipContainer, EmptyArchiveHasNoEntries) {
    const std::string archive = RawZip{}.bytes();
    const auto entries = readZip(bytesOf(archive));
    ASSERT_TRUE(entries);
    EXPECT_TRUE(entries->empty());
}

TEST(ZipContainer, Zip64FieldsThatLieAreRefused) {
    const auto field = [](std::initializer_list<std::uint64_t> values) {
        std::string data;
        for (const std::uint64_t value : values) data += number(value, 8);
        return number(1, 2) + number(data.size(), 2) + data;
    };
    const auto with = [&](std::string localExtra, std::string centralExtra, std::uint64_t offset) {
        RawZip zip = twoEntries();
        RawEntry& e = zip.entries[1];
        e.local.size = e.local.stored = e.central.size = e.central.stored = 0xFFFFFFFF;
        e.local.extra = std::move(localExtra);
        e.central.extra = std::move(centralExtra);
        std::string archive = zip.bytes();
        if (offset != 0) archive.replace(archive.rfind("PK\1\2") + 42, 4, number(offset, 4));
        return archive;
    };
    const std::string good = with(field({6, 6}), field({6, 6}), 0);
    ASSERT_TRUE(readZip(bytesOf(good))) << readZip(bytesOf(good)).error().toString();
    constexpr std::uint64_t kHuge = 0xFFFFFFFFFFFFFFFFull;
    expectBad(with("", field({6, 6}), 0), "lacks a size");
    expectBad(with(field({6, 6}), "", 0), "lacks a size");
    expectBad(with(field({6}), field({6, 6}), 0), "lacks a size");
    expectBad(with(field({6, 6}), field({6, 6, 0}), 0), "more than is needed");
    expectBad(with(field({6, 6}), field({6, 6}) + field({6, 6}), 0), "extra field that is damaged");
    expectBad(with(field({6, 6}), field({7, 6}), 0), "two sizes");
    expectBad(with(field({6, 6}), field({5, 5}), 0), "differs between");
    expectBad(with(field({kHuge, kHuge}), field({kHuge, kHuge}), 0), "outside the file");
    expectBad(with(field({6, 6}), field({6, 6, kHuge}), 0xFFFFFFFF), "outside the file");
    expectBad(with(field({6, 6}), field({6, 6, kHuge - 20}), 0xFFFFFFFF), "outside the file");
}

TEST(ZipContainer, Zip64EndRecordThatLiesIsRefused) {
    const TemporaryFolder folder;
    const ZipSource sources[] = {{"large", {bytesOf("a text of more than twenty bytes")}, true}};
    ASSERT_TRUE(writeZip(folder / "z", sources, 20));
    const std::string archive = readText(folder / "z");
    const std::size_t end64 = archive.size() - 22 - 20 - 56;
    ASSERT_EQ(archive.substr(end64, 4), "PK\6\6");
    for (std::size_t at = end64; at < archive.size(); ++at) {
        // The versions of the program that wrote the file and of the format are not used.
        if (at >= end64 + 12 && at < end64 + 16) continue;
        std::string changed = archive;
        changed[at] = static_cast<char>(changed[at] ^ 0x41);
        EXPECT_FALSE(readZip(bytesOf(changed))) << "byte " << at - end64 << " of the end records";
    }
}

TEST(ZipContainer, ExternalToolsAcceptTheFile) {
    const TemporaryFolder folder;
    const std::string longText(3'000'000, 'x');
    const ZipSource sources[] = {{"mimetype", {bytesOf("text")}, false},
                                 {"a/b", {bytesOf("a text of more than twenty bytes")}, true},
                                 {"deflated", {bytesOf(longText)}, true, true}};
    for (const std::uint64_t zip64From : {std::uint64_t{0xFFFFFFFF}, std::uint64_t{20}}) {
        ASSERT_TRUE(writeZip(folder / "z.zip", sources, zip64From));
        const std::string path = (folder / "z.zip").string();
        int tools = 0;
        if (std::system("unzip -v >/dev/null 2>&1") == 0) {
            ++tools;
            EXPECT_EQ(std::system(("unzip -tqq '" + path + "' >/dev/null").c_str()), 0) << "ZIP64 from " << zip64From;
        }
        if (std::system("python3 -c 'import zipfile' >/dev/null 2>&1") == 0) {
            ++tools;
            const std::string script =
                "import sys,zipfile; z=zipfile.ZipFile(sys.argv[1]); assert z.testzip() is None; "
                "assert z.read(\"a/b\")==b\"a text of more than twenty bytes\"; "
                "assert z.read(\"deflated\")==b\"x\"*3000000";
            EXPECT_EQ(std::system(("python3 -c '" + script + "' '" + path + "'").c_str()), 0)
                << "ZIP64 from " << zip64From;
        }
        if (tools == 0) GTEST_SKIP() << "neither unzip nor python3 is installed";
    }
}

}  // namespace
}  // namespace svt::volume
