#include <svt/core/temporary_folder_test.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/writers/nrrd/nrrd_file_test.hpp>
#include <svt/writers/nrrd_writer.hpp>

#include <gtest/gtest.h>

namespace svt::writers {
namespace {

using svt::test::readText;
using svt::test::TemporaryFolder;
using svt::test::writeText;

Result<NrrdImage> readNrrdText(std::string_view text, const NrrdReadOptions& options = {}) {
    const TemporaryFolder folder;
    writeText(folder / "t.nrrd", text);
    return readNrrd(folder / "t.nrrd", options);
}

void expectRefused(const std::string& text, std::string_view reason, Code code = Code::BadNrrd) {
    const auto image = readNrrdText(text);
    ASSERT_FALSE(image) << "accepted, expected: " << reason;
    EXPECT_EQ(image.error().code(), code);
    EXPECT_NE(image.error().message().find(reason), std::string::npos) << image.error().message();
}

std::string with(std::string from, std::string to) {
    std::string text =
        "NRRD0004\n# a comment\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\nkey:=value\n\nabcdefgh";
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(NrrdReader, SmallestFileIsRead) {
    const auto image = readNrrdText(with("", ""));
    ASSERT_TRUE(image) << image.error().toString();
    EXPECT_EQ(image->dimension, (Vec3i{2, 2, 2}));
    EXPECT_EQ(image->sample(0), unsigned{'a'});
    EXPECT_EQ(image->sample(7), unsigned{'h'});
    ASSERT_NE(image->find("key"), nullptr);
    EXPECT_EQ(*image->find("key"), "value");
    EXPECT_EQ(image->find("other"), nullptr);
}

TEST(NrrdReader, OtherSpellingsAreUnderstood) {
    EXPECT_TRUE(readNrrdText(with("uint8", "unsigned char")));
    EXPECT_TRUE(readNrrdText(with("NRRD0004", "NRRD0005")));
    EXPECT_TRUE(readNrrdText(with("key:=value", "unknown field: x")));
    std::string crlf = with("", "");
    for (std::size_t at = 0; (at = crlf.find('\n', at)) != std::string::npos; at += 2) crlf.insert(at, "\r");
    const auto image = readNrrdText(crlf);
    ASSERT_TRUE(image) << image.error().toString();
    EXPECT_EQ(image->sample(0), unsigned{'a'});
    const auto spaced = readNrrdText(with("key:=value", "spacings: 0.5 2 1e-3"));
    ASSERT_TRUE(spaced);
    EXPECT_EQ(spaced->directions[2], (Vec3d{0, 0, 1e-3}));
}

TEST(NrrdReader, BigEndianSamplesAreTurned) {
    const std::string head = "NRRD0001\ntype: ushort\ndimension: 3\nsizes: 2 1 1\nencoding: raw\nendian: ";
    const auto big = readNrrdText(head + "big\n\n" + std::string("\1\2\3\4", 4));
    const auto little = readNrrdText(head + "little\n\n" + std::string("\1\2\3\4", 4));
    ASSERT_TRUE(big && little);
    EXPECT_EQ(big->sample(0), 0x0102u);
    EXPECT_EQ(big->sample(1), 0x0304u);
    EXPECT_EQ(little->sample(0), 0x0201u);
}

TEST(NrrdReader, EscapesInKeyValuesAreUndone) {
    const auto image = readNrrdText(with("key:=value", R"(key:=a\nb\\n\\\\c:=d)"));
    ASSERT_TRUE(image);
    EXPECT_EQ(*image->find("key"), "a\nb\\n\\\\c:=d");
}

TEST(NrrdReader, WrongHeadersAreRefused) {
    expectRefused("", "does not begin with NRRD");
    expectRefused("NRRD0009\n\n", "does not begin with NRRD");
    expectRefused("NRRD0004\ntype: uint8\n", "does not end with an empty line");
    expectRefused("NRRD0004\n\n", "is missing");
    expectRefused(with("uint8", "float"), "type 'float'");
    expectRefused(with("uint8", "uint16"), "endian");
    expectRefused(with("dimension: 3", "dimension: 4"), "4 axes");
    expectRefused(with("2 2 2", "2 2"), "sizes");
    expectRefused(with("2 2 2", "2 2 2 2"), "more than three");
    expectRefused(with("2 2 2", "2 2 0"), "sizes");
    expectRefused(with("2 2 2", "2 2 -2"), "sizes");
    expectRefused(with("2 2 2", "2 2 99999999999999999999"), "sizes");
    expectRefused(with("2 2 2", "2 2 3"), "8 bytes of samples found, 12 expected");
    expectRefused(with("2 2 2", "2 2 1"), "8 bytes of samples found, 4 expected");
    expectRefused(with("encoding: raw", "encoding: bzip2"), "encoding 'bzip2'");
    expectRefused(with("encoding: raw", "space origin: (1,2)\nencoding: raw"), "space origin");
    expectRefused(with("encoding: raw", "space origin: (1,2,nan)\nencoding: raw"), "space origin");
    expectRefused(with("encoding: raw", "space directions: (1,0,0) none (0,0,1)\nencoding: raw"), "space directions");
    expectRefused(with("encoding: raw", "data file: /etc/passwd\nencoding: raw"), "another file");
    expectRefused(with("encoding: raw", "byte skip: -1\nencoding: raw"), "byte skip");
    expectRefused(with("key:=value", "nonsense"), "no colon");
}

TEST(NrrdReader, SizesAreCheckedBeforeAllocating) {
    expectRefused(with("2 2 2", "1073741824 1073741824 1073741824"), "over the limit", Code::InputTooBig);
    expectRefused(with("2 2 2", "65535 65535 1"), "samples found");
    std::string gzip = with("encoding: raw", "encoding: gzip");
    gzip.replace(gzip.find("2 2 2"), 5, "65535 65535 1");
    expectRefused(gzip, "cannot hold");
    const NrrdReadOptions options{.maxDataBytes = 7};
    EXPECT_EQ(readNrrdText(with("", ""), options).error().code(), Code::InputTooBig);
}

TEST(NrrdReader, DamagedGzipIsRefusedOrHarmless) {
    const TemporaryFolder folder;
    const auto volume = volume::test::sampleVolume({8, 8, 8});
    ASSERT_TRUE(writeNrrd(volume, folder / "v.nrrd"));
    const std::string text = readText(folder / "v.nrrd");
    const auto original = readNrrdText(text);
    ASSERT_TRUE(original);
    const std::size_t data = text.find("\n\n") + 2;
    for (std::size_t size = data; size < text.size(); ++size)
        EXPECT_FALSE(readNrrdText(text.substr(0, size))) << size - data << " bytes of the member";
    for (std::size_t at = data; at < text.size(); ++at) {
        std::string damaged = text;
        damaged[at] = static_cast<char>(damaged[at] ^ 0xFF);
        const auto image = readNrrdText(damaged);
        if (image) {
            EXPECT_TRUE(image->data == original->data) << "byte " << at - data << " of the member";
        }
    }
    std::string longer = text;
    longer.replace(longer.find("sizes: 8 8 8"), 12, "sizes: 8 8 9");
    EXPECT_FALSE(readNrrdText(longer));
    std::string shorter = text;
    shorter.replace(shorter.find("sizes: 8 8 8"), 12, "sizes: 8 8 7");
    EXPECT_FALSE(readNrrdText(shorter));
    EXPECT_FALSE(readNrrdText(text + "x"));
}

TEST(NrrdReader, SeveralGzipMembersAreOneStream) {
    const TemporaryFolder folder;
    const auto volume = volume::test::sampleVolume({8, 8, 8});
    ASSERT_TRUE(writeNrrd(volume, folder / "v.nrrd"));
    std::string text = readText(folder / "v.nrrd");
    text += text.substr(text.find("\n\n") + 2);
    text.replace(text.find("sizes: 8 8 8"), 12, "sizes: 8 8 16");
    const auto image = readNrrdText(text);
    ASSERT_TRUE(image) << image.error().toString();
    EXPECT_EQ(image->sample(300), image->sample(300 + 512));
}

}  // namespace
}  // namespace svt::writers
